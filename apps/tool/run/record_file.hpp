// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "returns/quantise.hpp"
#include "store/cube.hpp"

/// Recordings of real sonars, which verbs read as they read runs.
namespace insonify::tool {

/// The endings of recordings: .xtf, .aris, .oculus, .raw, and those of swaths, .gsf and .kmall.
std::string record_extensions();

/// True for a path with the ending of a recording.
bool is_record(const std::string& path);

/// A recording as pings: levels are those of the record, re a reference of its own, and not those of pressures.
struct Record {
  Cube cube;
  std::string kind;  ///< "XTF by SEASCAN", "ARIS 1200", "Oculus of 8 bits"
  std::string unit;  ///< unit of levels: "dB re full scale", ...
  GreyWindow scale;  ///< levels of the lowest and the highest value; nothing of floats
  bool has_scale = true;
  bool side_scan = false;               ///< the beams are channels: those to port at +90 degrees, to starboard at -90
  std::vector<std::string> channels{};  ///< their names
  std::vector<double> altitude{};       ///< altitude of a side-scan [m], by ping; 0: unknown
};

/// Reads `count` pings (frames) of a recording from the `first` on; fewer if there are not so many. Pings of a
/// side-scan whose ranges differ are brought to the finest bins among them, each sample the nearest of its own. Throws
/// Error(argument) if there is no ping `first` or for another ending, Error(content) if ranges differ too much, and as
/// the readers.
Record read_record(const std::string& path, std::size_t first = 0,
                   std::size_t count = std::numeric_limits<std::size_t>::max());

/// The pressure whose level is this [dB re the reference of a recording]; 0 of silence.
std::complex<float> recorded_pressure(double level_db);

/// A gate of so many bins from a range on, which may be 0; that of a fan cannot, and begins a millionth of a bin later.
RangeGate shown_gate(double begin, std::size_t bins, double bin_size);

/// The ping with one of its beams.
Ping channel_alone(const Ping& ping, std::size_t beam);

/// The levels of a beam in all pings, pings x bins: a side-scan's image.
Grid<float> levels_of_beam(const Cube& cube, std::size_t beam);

}  // namespace insonify::tool

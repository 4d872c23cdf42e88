// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.hpp"
#include "returns/ping.hpp"
#include "returns/ping_note.hpp"
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The text with which cubes, manifests and pictures mark pings at their expected level.
inline constexpr const char* expected_level_text = "expected level, no speckle";

/// The contents of cube.h5: one or more pings of one sonar.
struct Cube {
  static constexpr int all_bits = 24;  ///< significant bits of a float

  std::vector<Ping> pings;         ///< all with the same fan and gate
  double sound_speed = 0;          ///< sound speed of water at the head [m/s]; a ping in other water has its own
  double absorption_db_per_m = 0;  ///< absorption of water at the head, at the centre frequency; as sound_speed
  double centre_frequency = 0;     ///< [Hz]
  double bandwidth = 0;            ///< [Hz]
  double source_level_db = 0;      ///< dB re 1 uPa at 1 m
  std::uint64_t seed = 0;
  double tolerance = 0;
  int keep_bits = all_bits;  ///< significant bits of pressures that write_cube keeps, 1 to all_bits
  std::string sonar;         ///< name of the head's sonar
  std::string insonify_version;
  std::string head{}, start_utc{};  ///< survey: name of the head; date of time 0 if it is known
  std::optional<Anchor> anchor{};   ///< survey: place of its world on the globe, if it is known
  std::vector<PingNote> notes{};    ///< limits of the accuracy of all pings of the file, by kind
};

/// Returns a cube without pings for `head` in `medium` (SimulatedPing::medium, or medium_of at the centre frequency)
/// and `options`. All other members are set, including the version of this library. Throws Error if head or medium are
/// invalid.
Cube make_cube(const SonarHead& head, const Medium& medium, const SimulationOptions& options = {});

/// Writes cube.h5 (docs/formats.md):
///
///   /pressure               pings x beams x bins, compound {r, i} float32 [Pa]
///   /range                  bin centres [m]
///   /azimuth, /elevation    directions of the beams [rad]
///   /pose                   pings x 4 x 4, world_from_head, row-major
///   /time, /ping            time [s] and number of each ping
///   root attributes         schema, the members of Cube, beam_width, elevation_width, row_width of a planar array
///                           [rad], min_range, max_range, bin_size [m]
///
/// Optional parts, present if the pings have them:
///
///   /layers/NAME                      each layer, with the extent of /pressure
///   /intensity [Pa^2], /unknown (uint8), /split_phase [rad] (float32)
///   /label_material (uint16), /label_id (uint32), /label_share (float32)
///                                     labels, with the attribute label_names, one name a line
///   expected_level                    attribute of cubes of expected levels
///   head, start_utc, anchor_latitude_deg, anchor_longitude_deg, anchor_heading_deg
///                                     attributes of a survey, as the members of Cube
///   notes                             attribute: a line for each kind (as_lines)
///   /sound_speed [m/s], /absorption_db_per_m [dB/m]
///                                     of each ping, if the water differs between pings; a ping that does not know
///                                     its water has the values of the cube
///   /velocity [m/s], /turn_rate [rad/s]
///                                     pings x 3, world axes, for a moving head: Ping::motion
///   /scan_angle [rad], /sweep (pings), /beam_time [s] (pings x beams), /beam_pose (pings x beams x 4 x 4)
///                                     of a scanning head
///
/// Datasets have units, long_name and named dimensions, whose scales are /ping, /azimuth and /range. The attribute
/// `convention` of pressures states how a level follows from them. /unknown and labels are deflated. With fewer
/// keep_bits than all, /pressure and /layers are rounded to that many significant bits, at most 2^-keep_bits of each
/// real and imaginary part, and also deflated; the attribute keep_bits says so. The same input gives the same bytes (no
/// timestamps). The file is written to a temporary name, then renamed. Throws Error(argument) if there are no pings or
/// they differ in fan, gate, extent, layers, maps or expected_level; Error(file) if it cannot write.
void write_cube(const std::string& path, const Cube& cube);

/// Returns the contents of a cube that write_cube wrote, bit for bit, with at most `count` pings from index `first` on.
/// Each ping has the sound speed and absorption of its own water, or else those of the cube. Throws Error(file) if the
/// file is missing, Error(content) if it is not a cube, has another schema or lacks a dataset or attribute, naming it.
Cube read_cube(const std::string& path, std::size_t first = 0,
               std::size_t count = std::numeric_limits<std::size_t>::max());

/// Returns the pressure of one beam, pings x bins [Pa], in `count` pings from index `first` on, in the order of the
/// cube, without reading the other beams. Throws as read_cube, and Error(argument) for pings or a beam that the cube
/// lacks.
ComplexGridF read_beam(const std::string& path, std::size_t first, std::size_t count, std::size_t beam);

/// Calls `use` for each ping in turn, with the cube without pings and the ping. Memory holds one ping at a time. Throws
/// as read_cube; errors of an image when its ping is read.
void read_cube_pings(const std::string& path, const std::function<void(const Cube&, const Ping&)>& use);

/// Returns the pings of a cube without their images. Throws as read_cube.
std::vector<TrackPoint> read_track(const std::string& path);

}  // namespace insonify

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
#include "simulate/simulation_options.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// The contents of cube.h5: one or more pings of one sonar.
struct Cube {
  static constexpr int all_bits = 24;  ///< of a float

  std::vector<Ping> pings;         ///< all with the same fan and gate
  double sound_speed = 0;          ///< of the water at the head [m/s]; pings that differ have their own
  double absorption_db_per_m = 0;  ///< the same, at the centre frequency
  double centre_frequency = 0;     ///< [Hz]
  double bandwidth = 0;            ///< [Hz]
  double source_level_db = 0;      ///< dB re 1 uPa at 1 m
  std::uint64_t seed = 0;
  double tolerance = 0;
  int keep_bits = all_bits;  ///< significant bits of pressures that write_cube keeps, 1 to all_bits
  std::string sonar;         ///< name of the head's sonar
  std::string insonify_version;
  std::string head{}, start_utc{};  ///< of a survey: name of the head, and time 0 if it is known
  std::optional<Anchor> anchor{};   ///< of a survey that says where its world is
};

/// A cube for pings of `head` in `medium` (SimulatedPing::medium, or medium_of at the centre frequency) by `options`:
/// every member but the pings, with the version of this library. Throws Error if head or medium are invalid.
Cube make_cube(const SonarHead& head, const Medium& medium, const SimulationOptions& options = {});

/// Writes /pressure (pings x beams x bins, compound {r, i} float32 [Pa]), /range [m, bin centres], /azimuth and
/// /elevation [rad], /pose (pings x 4 x 4, world_from_head, row-major), /time [s], /ping (numbers) and the root
/// attributes schema, the members above, beam_width, elevation_width (of a planar array also row_width) [rad],
/// min_range, max_range, bin_size [m]. Layers are written as /layers/NAME with the extent of /pressure; so are, if the
/// pings have them, /intensity [Pa^2], /unknown (uint8) and /split_phase [rad] (float32), and of pings with
/// labels /label_material (uint16), /label_id (uint32), /label_share (float32) and the attribute label_names, one name
/// a line. The attribute expected_level marks expected levels; head, start_utc and anchor_latitude_deg,
/// anchor_longitude_deg and anchor_heading_deg say of a survey what the members do. Datasets have units, long_name and
/// named dimensions, whose scales are /ping, /azimuth and /range; pressures say in `convention` how a level follows
/// from them. Where the water differs from ping to ping, /sound_speed [m/s] and /absorption_db_per_m [dB/m] (pings) are
/// the pings' own; a ping that does not know its water has that of the cube. Where a head moves, /velocity [m/s] and
/// /turn_rate [rad/s] (pings x 3, world axes) are Ping::motion. Pings of a scanning head add /scan_angle [rad] and
/// /sweep (pings), /beam_time [s] (pings x beams) and /beam_pose (pings x beams x 4 x 4). /unknown and labels are
/// deflated. With fewer keep_bits than all, /pressure and /layers are rounded to so many significant bits, at most
/// 2^-keep_bits of each real and imaginary part, and deflated, too; the attribute keep_bits says so. Byte-identical for
/// identical input (no timestamps). Written to a temporary name, then renamed. Throws Error(argument) if there are no
/// pings or they differ in fan, gate, extent, layers, maps or expected_level; Error(file) if it cannot write.
void write_cube(const std::string& path, const Cube& cube);

/// Reads what write_cube wrote, bit for bit; of its pings at most `count`, from the `first` on. Each ping has the sound
/// speed and absorption of its own water, or those of the cube. Throws Error(file) if missing, Error(content) if it is
/// not a cube, has another schema or lacks a dataset or attribute, naming it.
Cube read_cube(const std::string& path, std::size_t first = 0,
               std::size_t count = std::numeric_limits<std::size_t>::max());

/// The pressure of one beam in `count` pings from the `first` on (by their order in the cube), pings x bins [Pa],
/// without reading the other beams. Errors as read_cube; Error(argument) for pings or a beam that the cube lacks.
ComplexGridF read_beam(const std::string& path, std::size_t first, std::size_t count, std::size_t beam);

/// Calls `use` with the cube without pings and each of its pings, one after the other: memory is that of one ping.
/// Errors as read_cube, of images when their ping is due.
void read_cube_pings(const std::string& path, const std::function<void(const Cube&, const Ping&)>& use);

/// The pings of a cube without their images; errors as read_cube.
std::vector<TrackPoint> read_track(const std::string& path);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>

#include "core/error.hpp"
#include "core/text.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube.hpp"
#include "store/cube_arrays_internal.hpp"
#include "store/cube_axes_internal.hpp"
#include "store/cube_layout_internal.hpp"
#include "store/cube_parts_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {

// Throws Error(argument) if the layers of a ping differ from the first ping's in name, order or extent.
void require_same_layers(const Ping& ping, const Ping& first, const std::string& path) {
  const auto fits = [&](const Layer& layer, const Layer& like) {
    return layer.name == like.name && layer.pressure.rows() == first.pressure.rows() &&
           layer.pressure.cols() == first.pressure.cols();
  };
  if (!std::equal(ping.layers.begin(), ping.layers.end(), first.layers.begin(), first.layers.end(), fits))
    fail(ErrorKind::argument, "write_cube: ", path, ": ping ", ping.number, " has other layers than ping ",
         first.number, "; keep the same ones in every ping");
}

// Throws Error(argument) if the maps of a ping differ from the first ping's in presence or extent.
void require_same_maps(const Ping& ping, const Ping& first, const std::string& path) {
  const auto require = [&](const auto& map, const auto& like, const char* name) {
    const bool fits =
        like.size() == 0 ? map.size() == 0 : map.rows() == first.pressure.rows() && map.cols() == first.pressure.cols();
    if (!fits)
      fail(ErrorKind::argument, "write_cube: ", path, ": ", name, " of ping ", ping.number, " has ", map.rows(), " x ",
           map.cols(), " cells, must be like that of ping ", first.number,
           like.size() == 0 ? ": absent" : ", one cell for each of its pressure");
  };
  require(ping.intensity, first.intensity, "intensity");
  require(ping.unknown, first.unknown, "unknown");
  require(ping.split_phase, first.split_phase, "split_phase");
  require(ping.labels.material, first.labels.material, "labels");
  require(ping.labels.id, first.labels.material, "label ids");
  require(ping.labels.share, first.labels.material, "label shares");
  require(ping.labels.part, first.labels.part, "label parts");
  require(ping.labels.elevation, first.labels.second, "label elevations");
  require(ping.labels.second, first.labels.second, "second labels");
  require(ping.labels.second_share, first.labels.second, "shares of second labels");
  require_same_parts(ping, first, path);
  const auto require_both = [&](bool alike, const char* what) {
    if (!alike)
      fail(ErrorKind::argument, "write_cube: ", path, ": only one of pings ", first.number, " and ", ping.number, what,
           "; write it to a cube of its own");
  };
  require_both(ping.scan.has_value() == first.scan.has_value(), " is of a scanning head");
  require_both(ping.display_cells == first.display_cells, " has display cells");
  require_both(ping.expected_level == first.expected_level, " is an expected level");
}

// Throws Error(argument) for pings that cannot share one set of axes.
void require_writable(const Cube& cube, const std::string& path) {
  if (cube.pings.empty()) fail(ErrorKind::argument, "write_cube: ", path, ": no pings, must be at least one");
  if (cube.keep_bits < 1 || cube.keep_bits > Cube::all_bits)
    fail(ErrorKind::argument, "write_cube: ", path, ": keep_bits = ", cube.keep_bits, ", must be within 1 and ",
         Cube::all_bits);
  const Ping& first = cube.pings.front();
  if (first.fan.azimuth.size() != first.fan.elevation.size())
    fail(ErrorKind::argument, "write_cube: ", path, ": fan has ", first.fan.azimuth.size(), " azimuths and ",
         first.fan.elevation.size(), " elevations, must be as many");
  require_valid(first.fan, "write_cube");
  require_valid(first.gate, "write_cube");
  for (const Ping& ping : cube.pings) {
    const auto rows = static_cast<std::size_t>(ping.pressure.rows());
    const auto columns = static_cast<std::size_t>(ping.pressure.cols());
    if (rows != first.fan.beams() || columns != first.gate.bins())
      fail(ErrorKind::argument, "write_cube: ", path, ": ping ", ping.number, " has ", rows, " beams x ", columns,
           " bins, must have ", first.fan.beams(), " x ", first.gate.bins());
    if (ping.fan.azimuth != first.fan.azimuth || ping.fan.elevation != first.fan.elevation ||
        ping.gate.min_range != first.gate.min_range || ping.gate.bin_size != first.gate.bin_size)
      fail(ErrorKind::argument, "write_cube: ", path, ": ping ", ping.number, " has another fan or gate than ping ",
           first.number, "; write it to a cube of its own");
    require_same_layers(ping, first, path);
    require_same_maps(ping, first, path);
  }
}

void write_axes(const FileContext& context, hid_t file, const BeamFan& fan, const RangeGate& gate) {
  std::vector<double> range(gate.bins());
  for (std::size_t n = 0; n < range.size(); ++n) range[n] = gate.centre(n);
  write_numbers(context, file, range_name, {range.size()}, range.data());
  write_numbers(context, file, azimuth_name, {fan.beams()}, fan.azimuth.data());
  write_numbers(context, file, elevation_name, {fan.beams()}, fan.elevation.data());
}

void append_pose(std::vector<double>& numbers, const Pose& pose) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(pose.matrix()(row, column));
}

void write_track(const FileContext& context, hid_t file, const std::vector<Ping>& pings) {
  std::vector<double> pose, time;
  std::vector<std::int64_t> number;
  for (const Ping& ping : pings) {
    append_pose(pose, ping.world_from_head);
    time.push_back(ping.time);
    number.push_back(ping.number);
  }
  write_numbers(context, file, pose_name, {pings.size(), 4, 4}, pose.data());
  write_numbers(context, file, time_name, {pings.size()}, time.data());
  write_numbers(context, file, ping_name, {pings.size()}, number.data());
}

// Writes the water at the head of every ping, if any ping has other water than the cube.
void write_water(const FileContext& context, hid_t file, const Cube& cube) {
  std::vector<double> speed, absorption;
  bool differ = false;
  for (const Ping& ping : cube.pings) {
    const bool known = ping.sound_speed > 0;
    speed.push_back(known ? ping.sound_speed : cube.sound_speed);
    absorption.push_back(known ? ping.absorption_db_per_m : cube.absorption_db_per_m);
    differ |= speed.back() != cube.sound_speed || absorption.back() != cube.absorption_db_per_m;
  }
  if (!differ) return;
  write_numbers(context, file, sound_speed_name, {speed.size()}, speed.data());
  write_numbers(context, file, absorption_name, {absorption.size()}, absorption.data());
}

// Writes the motion of the head in every ping, if it moves in any.
void write_motion(const FileContext& context, hid_t file, const std::vector<Ping>& pings) {
  if (std::all_of(pings.begin(), pings.end(), [](const Ping& ping) { return ping.motion.none(); })) return;
  std::vector<Eigen::Vector3d> velocity, turn_rate;
  for (const Ping& ping : pings) {
    velocity.push_back(ping.motion.velocity);
    turn_rate.push_back(ping.motion.turn_rate);
  }
  write_numbers(context, file, velocity_name, {pings.size(), 3}, velocity.front().data());
  write_numbers(context, file, turn_rate_name, {pings.size(), 3}, turn_rate.front().data());
}

// Writes the turn of a scanning head, and time and pose of every beam.
void write_scan(const FileContext& context, hid_t file, const std::vector<Ping>& pings) {
  if (!pings.front().scan) return;
  const std::size_t beams = pings.front().fan.beams();
  std::vector<double> time, pose, angle;
  std::vector<std::int64_t> sweep;
  for (const Ping& ping : pings) {
    angle.push_back(ping.scan->angle), sweep.push_back(ping.scan->sweep);
    for (std::size_t beam = 0; beam < beams; ++beam) {
      time.push_back(ping.time);
      append_pose(pose, ping.world_from_head);
    }
  }
  write_numbers(context, file, scan_angle_name, {pings.size()}, angle.data());
  write_numbers(context, file, sweep_name, {pings.size()}, sweep.data());
  write_numbers(context, file, beam_time_name, {pings.size(), beams}, time.data());
  write_numbers(context, file, beam_pose_name, {pings.size(), beams, 4, 4}, pose.data());
}

void write_root_attributes(const FileContext& context, hid_t file, const Cube& cube) {
  write_attribute(context, file, "schema", cube_schema);
  write_attribute(context, file, "insonify_version", cube.insonify_version);
  write_attribute(context, file, "sonar", cube.sonar);
  write_attribute(context, file, "sound_speed", cube.sound_speed);
  write_attribute(context, file, "absorption_db_per_m", cube.absorption_db_per_m);
  write_attribute(context, file, "centre_frequency", cube.centre_frequency);
  write_attribute(context, file, "bandwidth", cube.bandwidth);
  write_attribute(context, file, "source_level_db", cube.source_level_db);
  write_attribute(context, file, "seed", cube.seed);
  write_attribute(context, file, "tolerance", cube.tolerance);
  if (cube.keep_bits < Cube::all_bits)
    write_attribute(context, file, keep_bits_attribute, std::int64_t{cube.keep_bits});
  const Ping& ping = cube.pings.front();
  write_attribute(context, file, "beam_width", ping.fan.beam_width);
  write_attribute(context, file, "elevation_width", ping.fan.elevation_width);
  if (ping.display_cells) write_attribute(context, file, display_cells_attribute, std::string(display_cells_text));
  if (ping.expected_level) write_attribute(context, file, expected_level_attribute, std::string(expected_level_text));
  if (ping.fan.row_width > 0) write_attribute(context, file, "row_width", ping.fan.row_width);
  write_attribute(context, file, "min_range", ping.gate.min_range);
  write_attribute(context, file, "max_range", ping.gate.max_range);
  write_attribute(context, file, "bin_size", ping.gate.bin_size);
  if (!cube.head.empty()) write_attribute(context, file, head_attribute, cube.head);
  if (!cube.notes.empty()) write_attribute(context, file, notes_attribute, as_lines(cube.notes));
  if (!cube.start_utc.empty()) write_attribute(context, file, start_utc_attribute, cube.start_utc);
  if (!cube.anchor) return;
  write_attribute(context, file, anchor_latitude_attribute, cube.anchor->latitude_deg);
  write_attribute(context, file, anchor_longitude_attribute, cube.anchor->longitude_deg);
  write_attribute(context, file, anchor_heading_attribute, cube.anchor->heading_deg);
}

}  // namespace

void write_cube(const std::string& path, const Cube& cube) {
  require_writable(cube, path);
  write_hdf5(path, [&](const FileContext& context, hid_t file) {
    write_root_attributes(context, file, cube);
    write_axes(context, file, cube.pings.front().fan, cube.pings.front().gate);
    write_track(context, file, cube.pings);
    write_water(context, file, cube);
    write_motion(context, file, cube.pings);
    write_scan(context, file, cube.pings);
    write_all_images(context, file, cube);
    name_dimensions(context, file);
  });
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube_arrays_internal.hpp"
#include "store/cube_layout_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {

void require_schema(const FileContext& context, hid_t file) {
  if (H5Aexists(file, "schema") <= 0)
    fail(context.kind, context.path, ": is not a cube of insonify: attribute 'schema' is missing");
  const std::int64_t schema = read_attribute<std::int64_t>(context, file, "schema");
  if (schema != cube_schema)
    fail(context.kind, context.path, ": has cube schema ", schema, ", this version reads schema ", cube_schema);
}

// Reads fan and gate, common to all pings; invalid values are errors of the file.
void read_axes(const FileContext& context, hid_t file, CubeTable& table) {
  const Extent& extent = table.extent;
  table.fan.azimuth = read_all<double>(context, file, azimuth_name, {extent[1]});
  table.fan.elevation = read_all<double>(context, file, elevation_name, {extent[1]});
  table.fan.beam_width = read_attribute(context, file, "beam_width");
  table.fan.elevation_width = read_attribute(context, file, "elevation_width");
  if (H5Aexists(file, "row_width") > 0) table.fan.row_width = read_attribute(context, file, "row_width");
  table.gate = {read_attribute(context, file, "min_range"), read_attribute(context, file, "max_range"),
                read_attribute(context, file, "bin_size")};
  try {
    require_valid(table.fan, "cube");
    require_valid(table.gate, "cube");
  } catch (const Error& error) {
    fail(context.kind, context.path, ": ", error.what());
  }
  if (table.gate.bins() != extent[2])
    fail(context.kind, context.path, ": /pressure has ", extent[2],
         " bins, but min_range, max_range and bin_size give ", table.gate.bins());
  read_all<double>(context, file, range_name, {extent[2]});
}

// Returns a property of the water for each ping: the ping's own, or else the cube's.
std::vector<double> water_of(const FileContext& context, hid_t file, const DatasetName& name, hsize_t pings) {
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0)
    return std::vector<double>(pings, read_attribute(context, file, name.path + 1));
  const auto values = read_all<double>(context, file, name, {pings});
  for (const double value : values)
    if (!(value >= 0 && std::isfinite(value)))
      fail(context.kind, context.path, ": ", name.path, " = ", value, " ", name.unit, ", must be finite and >= 0");
  return values;
}

// Returns a world vector for each ping; zero in a cube without them.
std::vector<Eigen::Vector3d> vectors_of(const FileContext& context, hid_t file, const DatasetName& name,
                                        hsize_t pings) {
  std::vector<Eigen::Vector3d> vectors(pings, Eigen::Vector3d::Zero());
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0) return vectors;
  const auto values = read_all<double>(context, file, name, {pings, 3});
  for (std::size_t p = 0; p < pings; ++p) {
    vectors[p] = Eigen::Map<const Eigen::Vector3d>(values.data() + 3 * p);
    if (!vectors[p].allFinite())
      fail(context.kind, context.path, ": ", name.path, " of ping ", p, " = ", vectors[p].transpose(), " ", name.unit,
           ", must be finite");
  }
  return vectors;
}

std::vector<TrackPoint> track_of(const FileContext& context, hid_t file, hsize_t pings) {
  const auto pose = read_all<double>(context, file, pose_name, {pings, 4, 4});
  const auto time = read_all<double>(context, file, time_name, {pings});
  const auto number = read_all<std::int64_t>(context, file, ping_name, {pings});
  const auto speed = water_of(context, file, sound_speed_name, pings);
  const auto absorption = water_of(context, file, absorption_name, pings);
  const auto velocity = vectors_of(context, file, velocity_name, pings);
  const auto turn_rate = vectors_of(context, file, turn_rate_name, pings);
  const bool scans = H5Lexists(file, scan_angle_name.path, H5P_DEFAULT) > 0;
  std::vector<double> angle;
  std::vector<std::int64_t> sweep;
  if (scans) {
    angle = read_all<double>(context, file, scan_angle_name, {pings});
    sweep = read_all<std::int64_t>(context, file, sweep_name, {pings});
  }
  std::vector<TrackPoint> track(pings);
  for (std::size_t p = 0; p < track.size(); ++p) {
    track[p].number = number[p];
    track[p].time = time[p];
    track[p].sound_speed = speed[p];
    track[p].absorption_db_per_m = absorption[p];
    track[p].motion = {velocity[p], turn_rate[p]};
    if (scans) track[p].scan = ScanDirection{sweep[p], angle[p]};
    track[p].world_from_head.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&pose[16 * p]);
  }
  return track;
}

CubeTable read_table(const FileContext& context, hid_t file) {
  const DatasetName image = image_name_of(file);
  const Handle dataset = open_dataset(context, file, image);
  CubeTable table;
  table.extent = extent_of(context, dataset, image.path, 3);
  table.display_cells = has_levels(file);
  if (!table.display_cells) require_complex(context, dataset, image.path);
  table.track = track_of(context, file, table.extent[0]);
  read_axes(context, file, table);
  table.expected_level = H5Aexists(file, expected_level_attribute) > 0;
  return table;
}

/// Returns the pings without their images.
std::vector<Ping> pings_of(const CubeTable& table, PingRange range) {
  std::vector<Ping> pings;
  for (std::size_t p = range.begin; p < range.end; ++p) {
    Ping& ping = pings.emplace_back(Ping{table.track[p], table.fan, table.gate, {}});
    ping.expected_level = table.expected_level, ping.display_cells = table.display_cells;
  }
  return pings;
}

Cube read_attributes(const FileContext& context, hid_t file) {
  require_schema(context, file);
  Cube cube;
  cube.insonify_version = read_text(context, file, "insonify_version");
  cube.sonar = read_text(context, file, "sonar");
  cube.sound_speed = read_attribute(context, file, "sound_speed");
  cube.absorption_db_per_m = read_attribute(context, file, "absorption_db_per_m");
  cube.centre_frequency = read_attribute(context, file, "centre_frequency");
  cube.bandwidth = read_attribute(context, file, "bandwidth");
  cube.source_level_db = read_attribute(context, file, "source_level_db");
  cube.seed = read_attribute<std::uint64_t>(context, file, "seed");
  cube.tolerance = read_attribute(context, file, "tolerance");
  if (H5Aexists(file, keep_bits_attribute) > 0)
    cube.keep_bits = static_cast<int>(read_attribute<std::int64_t>(context, file, keep_bits_attribute));
  if (H5Aexists(file, head_attribute) > 0) cube.head = read_text(context, file, head_attribute);
  if (H5Aexists(file, notes_attribute) > 0) cube.notes = notes_in(read_text(context, file, notes_attribute));
  if (H5Aexists(file, start_utc_attribute) > 0) cube.start_utc = read_text(context, file, start_utc_attribute);
  if (H5Aexists(file, anchor_latitude_attribute) > 0)
    cube.anchor = {read_attribute(context, file, anchor_latitude_attribute),
                   read_attribute(context, file, anchor_longitude_attribute),
                   read_attribute(context, file, anchor_heading_attribute)};
  return cube;
}

/// Sends attributes and table of a cube unless its extent is known, then as many pings from `first` on as keep memory
/// small, or one. What is not copied from the file takes the most time.
void send_some_pings(const FileContext& context, hid_t file, ArraySender& to, Extent extent, std::size_t first,
                     bool one) {
  if (extent.empty()) {
    to(read_attributes(context, file));
    const CubeTable table = read_table(context, file);
    to(table);
    extent = table.extent;
  }
  constexpr std::size_t bytes_at_once = 4 << 20;
  std::size_t p = first;
  const auto sends_more = [&] { return p < extent[0] && (p == first || (!one && to.used() < bytes_at_once)); };
  for (; sends_more(); ++p) {
    to(true);
    send_all_images(context, file, extent, {p, p + 1}, to);
  }
  to(false);
}

}  // namespace

Cube read_cube(const std::string& path, std::size_t first, std::size_t count) {
  const auto read = [](const FileContext& context, hid_t file, ArraySender& to, std::size_t from, std::size_t most) {
    to(read_attributes(context, file));
    const CubeTable table = read_table(context, file);
    const std::size_t begin = std::min(from, table.track.size());
    const PingRange range{begin, begin + std::min(most, table.track.size() - begin)};
    to(table, range);
    send_all_images(context, file, table.extent, range, to);
  };
  ArrayReceiver sent = read_hdf5(path, read, first, count);
  Cube cube;
  CubeTable table;
  PingRange range;
  sent(cube, table, range);
  cube.pings = pings_of(table, range);
  receive_all_images(sent, path, cube.pings);
  return cube;
}

ComplexGridF read_beam(const std::string& path, std::size_t first, std::size_t count, std::size_t beam) {
  const auto read = [](const FileContext& context, hid_t file, ArraySender& to, std::size_t from, std::size_t pings,
                       std::size_t one) {
    require_schema(context, file);
    if (has_levels(file))
      fail(context.kind, context.path, ": holds display cells, which have no phase; make it without --display");
    const Handle dataset = open_dataset(context, file, pressure_name);
    const Extent extent = extent_of(context, dataset, pressure_name.path, 3);
    require_complex(context, dataset, pressure_name.path);
    if (one >= extent[1] || from + pings > extent[0])
      fail(ErrorKind::argument, "read_beam: pings ", from, " to ", from + pings, ", beam ", one, ", must be within ",
           extent[0], " and ", extent[1]);
    const Handle type = complex_type(context, H5T_NATIVE_FLOAT);
    char* const rows =
        to.take_grid(static_cast<Eigen::Index>(pings), static_cast<Eigen::Index>(extent[2]), H5Tget_size(type));
    if (pings == 0) return;
    const Extent size{pings, 1, extent[2]};
    const Handle memory = space_of(context, size), space = block_of(context, extent, {from, one, 0}, size);
    read_values(context, dataset, {type, memory, space}, rows, "/pressure");
  };
  ComplexGridF rows;
  read_hdf5(path, read, first, count, beam)(rows);
  return rows;
}

void read_cube_pings(const std::string& path, const std::function<void(const Cube&, const Ping&)>& use) {
  const auto read_some = [](const FileContext& context, hid_t file, ArraySender& to, const auto&... how) {
    send_some_pings(context, file, to, how...);
  };
  Cube cube;
  CubeTable table;
  ComplexGridF samples;  // the same memory for all pings
  bool one_by_one = false;
  for (std::size_t p = 0; table.extent.empty() || p < table.track.size();) {
    std::optional<ArrayReceiver> sent;
    try {
      sent = read_hdf5(path, read_some, table.extent, p, one_by_one);
    } catch (const Error&) {
      if (one_by_one) throw;
      one_by_one = true;  // find the damaged ping
      continue;
    }
    if (table.extent.empty()) (*sent)(cube, table);
    bool another = false;
    for ((*sent)(another); another; (*sent)(another)) {
      std::vector<Ping> ping = pings_of(table, {p, p + 1});
      samples.swap(ping.front().pressure);
      receive_all_images(*sent, path, ping);
      use(cube, ping.front());
      samples.swap(ping.front().pressure);
      ++p;
    }
  }
}

std::vector<TrackPoint> read_track(const std::string& path) {
  std::vector<TrackPoint> track;
  read_hdf5(path, [](const FileContext& context, hid_t file, ArraySender& to) {
    require_schema(context, file);
    const DatasetName image = image_name_of(file);
    const Handle dataset = open_dataset(context, file, image);
    to(track_of(context, file, extent_of(context, dataset, image.path, 3)[0]));
  })(track);
  return track;
}

}  // namespace insonify

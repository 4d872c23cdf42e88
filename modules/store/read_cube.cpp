#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <sstream>

#include "core/error.hpp"
#include "store/cube.hpp"
#include "store/cube_layout_internal.hpp"
#include "store/hdf5_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {

void require_schema(const Place& place, hid_t file) {
  if (H5Aexists(file, "schema") <= 0)
    fail(place.kind, place.path, ": is not a cube of insonify: attribute 'schema' is missing");
  const std::int64_t schema = read_integer(place, file, "schema");
  if (schema != cube_schema)
    fail(place.kind, place.path, ": has cube schema ", schema, ", this version reads schema ", cube_schema);
}

// Reads a whole dataset, which must have the expected extent.
template <typename T>
std::vector<T> read_all(const Place& place, hid_t file, const DatasetName& name, const Extent& expected, hid_t type) {
  const Handle dataset = open_dataset(place, file, name);
  const Extent extent = extent_of(place, dataset, name.path, expected.size());
  std::size_t values = 1;
  for (std::size_t d = 0; d < extent.size(); ++d) {
    if (extent[d] != expected[d])
      fail(place.kind, place.path, ": ", name.path, " has ", extent[d], " entries, ", expected[d],
           " expected from /pressure");
    values *= extent[d];
  }
  std::vector<T> result(values);
  read_values(place, dataset, {type}, result.data(), name.path);
  return result;
}

// Reads fan and gate, common to all pings; invalid values are errors of the file.
Ping read_axes(const Place& place, hid_t file, const Extent& extent) {
  Ping ping;
  ping.fan.azimuth = read_all<double>(place, file, azimuth_name, {extent[1]}, H5T_NATIVE_DOUBLE);
  ping.fan.elevation = read_all<double>(place, file, elevation_name, {extent[1]}, H5T_NATIVE_DOUBLE);
  ping.fan.beam_width = read_number(place, file, "beam_width");
  ping.fan.elevation_width = read_number(place, file, "elevation_width");
  if (H5Aexists(file, "row_width") > 0) ping.fan.row_width = read_number(place, file, "row_width");
  ping.gate = {read_number(place, file, "min_range"), read_number(place, file, "max_range"),
               read_number(place, file, "bin_size")};
  try {
    require_valid(ping.fan, "cube");
    require_valid(ping.gate, "cube");
  } catch (const Error& error) {
    fail(place.kind, place.path, ": ", error.what());
  }
  if (ping.gate.bins() != extent[2])
    fail(place.kind, place.path, ": /pressure has ", extent[2], " bins, but min_range, max_range and bin_size give ",
         ping.gate.bins());
  read_all<double>(place, file, range_name, {extent[2]}, H5T_NATIVE_DOUBLE);
  return ping;
}

// Reads one image per ping, from ping `first` of the cube on, with values of `type`, into the member selected by `part`.
template <typename Part>
void read_images(const Place& place, hid_t dataset, const std::string& name, hid_t type, std::span<Ping> pings,
                 std::size_t first, Part part) {
  const Extent extent = extent_of(place, dataset, name, 3);
  const Extent one_ping = {1, extent[1], extent[2]};
  const Handle memory(place.checked(H5Screate_simple(3, one_ping.data(), nullptr), name), H5Sclose);
  for (std::size_t p = 0; p < pings.size(); ++p) {
    auto& image = part(pings[p]);
    image.resize(static_cast<Eigen::Index>(extent[1]), static_cast<Eigen::Index>(extent[2]));
    const Handle row = select_row(place, dataset, extent, first + p);
    read_values(place, dataset, {type, memory, row}, image.data(), name);
  }
}

void require_complex(const Place& place, hid_t dataset, const std::string& name) {
  const Handle type(place.checked(H5Dget_type(dataset), name), H5Tclose);
  if (H5Tget_class(type) != H5T_COMPOUND || H5Tget_member_index(type, "r") < 0 || H5Tget_member_index(type, "i") < 0)
    fail(place.kind, place.path, ": ", name, " must be compound {r, i}");
}

void require_extent(const Place& place, hid_t dataset, const std::string& name, const Extent& extent) {
  if (extent_of(place, dataset, name, 3) != extent)
    fail(place.kind, place.path, ": ", name, " differs in extent from /pressure");
}

void read_layers(const Place& place, hid_t file, const Extent& extent, std::span<Ping> pings, std::size_t first) {
  const Handle type = complex_type(place, H5T_NATIVE_FLOAT);
  for (const std::string& layer : names_in(place, file, layers_group)) {
    const std::string path = std::string(layers_group) + "/" + layer;
    const Handle dataset = open_dataset(place, file, {path.c_str(), pressure_name.unit});
    require_extent(place, dataset, path, extent);
    require_complex(place, dataset, path);
    for (Ping& ping : pings) ping.layers.push_back({layer, {}});
    read_images(place, dataset, path, type, pings, first,
                [](Ping& ping) -> ComplexGridF& { return ping.layers.back().pressure; });
  }
}

// Reads an optional map into what `map` gives of each ping.
template <typename Map>
void read_map(const Place& place, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
              std::span<Ping> pings, std::size_t first, const Map& map) {
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0) return;
  const Handle dataset = open_dataset(place, file, name);
  require_extent(place, dataset, name.path, extent);
  const Handle stored(place.checked(H5Dget_type(dataset), name.path), H5Tclose);
  if (H5Tget_class(stored) != H5Tget_class(type) || H5Tget_size(stored) != H5Tget_size(type))
    fail(place.kind, place.path, ": ", name.path, " must be of ", H5Tget_class(type) == H5T_FLOAT ? "float" : "uint",
         8 * H5Tget_size(type));
  read_images(
      place, dataset, name.path, type, pings, first, [&map](Ping & ping) -> auto& { return std::invoke(map, ping); });
}

void read_labels(const Place& place, hid_t file, const Extent& extent, std::span<Ping> pings, std::size_t first) {
  if (H5Lexists(file, label_material_name.path, H5P_DEFAULT) <= 0) return;
  const auto read_part = [&](const DatasetName& name, hid_t type, auto label) {
    open_dataset(place, file, name);  // all three, or none
    read_map(
        place, file, name, type, extent, pings, first, [label](Ping & ping) -> auto& { return ping.labels.*label; });
  };
  read_part(label_material_name, H5T_NATIVE_UINT16, &PixelLabels::material);
  read_part(label_id_name, H5T_NATIVE_UINT32, &PixelLabels::id);
  read_part(label_share_name, H5T_NATIVE_FLOAT, &PixelLabels::share);
  std::istringstream lines(read_text(place, file, label_names_attribute));
  std::vector<std::string> names;
  for (std::string name; std::getline(lines, name);) names.push_back(name);
  for (Ping& ping : pings) ping.labels.names = names;
}

// A number of the water at every ping: the pings' own, or that of all.
std::vector<double> water_of(const Place& place, hid_t file, const DatasetName& name, hsize_t pings) {
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0)
    return std::vector<double>(pings, read_number(place, file, name.path + 1));
  const auto values = read_all<double>(place, file, name, {pings}, H5T_NATIVE_DOUBLE);
  for (const double value : values)
    if (!(value >= 0 && std::isfinite(value)))
      fail(place.kind, place.path, ": ", name.path, " = ", value, " ", name.unit, ", must be finite and >= 0");
  return values;
}

std::vector<TrackPoint> track_of(const Place& place, hid_t file, hsize_t pings) {
  const auto pose = read_all<double>(place, file, pose_name, {pings, 4, 4}, H5T_NATIVE_DOUBLE);
  const auto time = read_all<double>(place, file, time_name, {pings}, H5T_NATIVE_DOUBLE);
  const auto number = read_all<std::int64_t>(place, file, ping_name, {pings}, H5T_NATIVE_INT64);
  const auto speed = water_of(place, file, sound_speed_name, pings);
  const auto absorption = water_of(place, file, absorption_name, pings);
  const bool scans = H5Lexists(file, scan_angle_name.path, H5P_DEFAULT) > 0;
  std::vector<double> angle;
  std::vector<std::int64_t> sweep;
  if (scans) {
    angle = read_all<double>(place, file, scan_angle_name, {pings}, H5T_NATIVE_DOUBLE);
    sweep = read_all<std::int64_t>(place, file, sweep_name, {pings}, H5T_NATIVE_INT64);
  }
  std::vector<TrackPoint> track(pings);
  for (std::size_t p = 0; p < track.size(); ++p) {
    track[p].number = number[p];
    track[p].time = time[p];
    track[p].sound_speed = speed[p];
    track[p].absorption_db_per_m = absorption[p];
    if (scans) track[p].scan = ScanPlace{sweep[p], angle[p]};
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        track[p].world_from_head.matrix()(row, column) = pose[16 * p + static_cast<std::size_t>(4 * row + column)];
  }
  return track;
}

// What is known of the pings of a cube without their images.
struct CubeTable {
  Extent extent;  // of /pressure
  Ping common;
  std::vector<TrackPoint> track;
};

CubeTable read_table(const Place& place, hid_t file) {
  const Handle dataset = open_dataset(place, file, pressure_name);
  CubeTable table;
  table.extent = extent_of(place, dataset, pressure_name.path, 3);
  require_complex(place, dataset, pressure_name.path);
  table.track = track_of(place, file, table.extent[0]);
  table.common = read_axes(place, file, table.extent);
  table.common.expected_level = H5Aexists(file, expected_level_attribute) > 0;
  return table;
}

Ping ping_of(const CubeTable& table, std::size_t p) {
  Ping ping = table.common;
  ping.time = table.track[p].time;
  ping.number = table.track[p].number;
  ping.world_from_head = table.track[p].world_from_head;
  ping.scan = table.track[p].scan;
  ping.sound_speed = table.track[p].sound_speed;
  ping.absorption_db_per_m = table.track[p].absorption_db_per_m;
  return ping;
}

// Fills the images of pings, of which the first is number `first` in the cube.
void fill_images(const Place& place, hid_t file, const Extent& extent, std::span<Ping> pings, std::size_t first) {
  const Handle dataset = open_dataset(place, file, pressure_name);
  read_images(place, dataset, pressure_name.path, complex_type(place, H5T_NATIVE_FLOAT), pings, first,
              [](Ping& ping) -> ComplexGridF& { return ping.pressure; });
  read_layers(place, file, extent, pings, first);
  read_map(place, file, intensity_name, H5T_NATIVE_FLOAT, extent, pings, first, &Ping::intensity);
  read_map(place, file, level_error_name, H5T_NATIVE_FLOAT, extent, pings, first, &Ping::level_error_db);
  read_map(place, file, unknown_name, H5T_NATIVE_UINT8, extent, pings, first, &Ping::unknown);
  read_map(place, file, split_phase_name, H5T_NATIVE_FLOAT, extent, pings, first, &Ping::split_phase);
  read_labels(place, file, extent, pings, first);
}

Cube read_attributes(const Place& place, hid_t file) {
  require_schema(place, file);
  Cube cube;
  cube.insonify_version = read_text(place, file, "insonify_version");
  cube.sonar = read_text(place, file, "sonar");
  cube.sound_speed = read_number(place, file, "sound_speed");
  cube.absorption_db_per_m = read_number(place, file, "absorption_db_per_m");
  cube.centre_frequency = read_number(place, file, "centre_frequency");
  cube.bandwidth = read_number(place, file, "bandwidth");
  cube.source_level_db = read_number(place, file, "source_level_db");
  cube.seed = read_unsigned(place, file, "seed");
  cube.tolerance = read_number(place, file, "tolerance");
  if (H5Aexists(file, keep_bits_attribute) > 0)
    cube.keep_bits = static_cast<int>(read_integer(place, file, keep_bits_attribute));
  return cube;
}

}  // namespace

Cube read_cube(const std::string& path, std::size_t first, std::size_t count) {
  const QuietErrors quiet;
  Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  Cube cube = read_attributes(place, file);
  const CubeTable table = read_table(place, file);
  const std::size_t begin = std::min(first, table.track.size()),
                    end = begin + std::min(count, table.track.size() - begin);
  for (std::size_t p = begin; p < end; ++p) cube.pings.push_back(ping_of(table, p));
  fill_images(place, file, table.extent, cube.pings, begin);
  return cube;
}

ComplexGridF read_beam(const std::string& path, std::size_t first, std::size_t count, std::size_t beam) {
  const QuietErrors quiet;
  Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  require_schema(place, file);
  const Handle dataset = open_dataset(place, file, pressure_name);
  const Extent extent = extent_of(place, dataset, pressure_name.path, 3);
  require_complex(place, dataset, pressure_name.path);
  if (beam >= extent[1] || first + count > extent[0])
    fail(ErrorKind::argument, "read_beam: pings ", first, " to ", first + count, ", beam ", beam, ", must be within ",
         extent[0], " and ", extent[1]);
  ComplexGridF rows(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(extent[2]));
  if (count == 0) return rows;
  const Extent start{first, beam, 0}, size{count, 1, extent[2]};
  const Handle space(place.checked(H5Dget_space(dataset), pressure_name.path), H5Sclose);
  place.checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), "selection");
  const Handle memory(place.checked(H5Screate_simple(3, size.data(), nullptr), pressure_name.path), H5Sclose);
  read_values(place, dataset, {complex_type(place, H5T_NATIVE_FLOAT), memory, space}, rows.data(), "/pressure");
  return rows;
}

void read_cube_pings(const std::string& path, const std::function<void(const Cube&, const Ping&)>& use) {
  const QuietErrors quiet;
  Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  const Cube cube = read_attributes(place, file);
  const CubeTable table = read_table(place, file);
  for (std::size_t p = 0; p < table.track.size(); ++p) {
    Ping ping = ping_of(table, p);
    fill_images(place, file, table.extent, {&ping, 1}, p);
    use(cube, ping);
  }
}

std::vector<TrackPoint> read_track(const std::string& path) {
  const QuietErrors quiet;
  Place place{path, ErrorKind::content};
  const Handle file = open_file(place);
  require_schema(place, file);
  return track_of(place, file, extent_of(place, open_dataset(place, file, pressure_name), pressure_name.path, 3)[0]);
}

}  // namespace insonify

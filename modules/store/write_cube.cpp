// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <complex>
#include <cstdint>
#include <type_traits>

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

// Refuses pings whose layers differ from the first ping's in name, order or extent.
void require_same_layers(const Ping& ping, const Ping& first, const std::string& path) {
  const auto fits = [&](const Layer& layer, const Layer& like) {
    return layer.name == like.name && layer.pressure.rows() == first.pressure.rows() &&
           layer.pressure.cols() == first.pressure.cols();
  };
  if (!std::equal(ping.layers.begin(), ping.layers.end(), first.layers.begin(), first.layers.end(), fits))
    fail(ErrorKind::argument, "write_cube: ", path, ": ping ", ping.number, " has other layers than ping ",
         first.number, "; keep the same ones in every ping");
}

// Refuses pings whose maps differ from the first ping's in presence or extent.
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
  require_same_parts(ping, first, path);
  if (ping.scan.has_value() != first.scan.has_value())
    fail(ErrorKind::argument, "write_cube: ", path, ": only one of pings ", first.number, " and ", ping.number,
         " is of a scanning head; write it to a cube of its own");
  if (ping.display_cells != first.display_cells)
    fail(ErrorKind::argument, "write_cube: ", path, ": only one of pings ", first.number, " and ", ping.number,
         " has display cells; write it to a cube of its own");
  if (ping.expected_level != first.expected_level)
    fail(ErrorKind::argument, "write_cube: ", path, ": only one of pings ", first.number, " and ", ping.number,
         " is an expected level; write it to a cube of its own");
}

// Refuses pings that cannot share one set of axes.
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

// Chunks hold one ping, all bins and up to 64 beams, fewer if that exceeds 64 MiB.
hsize_t beams_per_chunk(hsize_t beams, hsize_t bins) {
  const hsize_t bytes_per_beam = bins * sizeof(std::complex<float>);
  return std::clamp<hsize_t>((hsize_t{64} << 20) / bytes_per_beam, 1, std::min<hsize_t>(beams, 64));
}

// HDF5 type of an image's values in the file or in memory.
template <typename Number>
Handle image_type(const FileContext& place, bool in_file) {
  if constexpr (std::is_same_v<Number, std::complex<float>>)
    return complex_type(place, in_file ? H5T_IEEE_F32LE : H5T_NATIVE_FLOAT);
  return {place.checked(H5Tcopy(type_of<Number>(in_file)), "type"), H5Tclose};
}

// Writes one image per ping: the pressure, layer or map selected by `part`.
template <typename Part>
void write_images(const FileContext& place, hid_t file, const DatasetName& name, const std::vector<Ping>& pings,
                  Part part, Packing packing) {
  const hsize_t beams = pings[0].fan.beams(), bins = pings[0].gate.bins();
  const Extent extent = {pings.size(), beams, bins};
  using Number = typename std::decay_t<decltype(part(pings[0]))>::Scalar;
  const Handle stored = image_type<Number>(place, true), here = image_type<Number>(place, false);
  const Handle dataset =
      create_dataset(place, file, name, stored, extent, {1, beams_per_chunk(beams, bins), bins}, packing);
  if constexpr (std::is_same_v<Number, std::complex<float>>)
    write_attribute(place, dataset, convention_attribute, std::string(pressure_convention));
  const Extent one_ping = {1, beams, bins};
  const Handle memory(place.checked(H5Screate_simple(3, one_ping.data(), nullptr), name.path), H5Sclose);
  for (std::size_t p = 0; p < pings.size(); ++p) {
    const Handle row = select_row(place, dataset, extent, p);
    place.checked(H5Dwrite(dataset, here, memory, row, H5P_DEFAULT, part(pings[p]).data()), name.path);
  }
}

// Rounds to `bits` significant bits, halves to even; infinities and NaN stay.
float rounded(float value, int bits) {
  auto pattern = std::bit_cast<std::uint32_t>(value);
  if ((pattern & 0x7f800000u) == 0x7f800000u) return value;
  const int dropped = Cube::all_bits - bits;
  const std::uint32_t last_kept = (pattern >> dropped) & 1u, half = (1u << dropped) >> 1;
  pattern += half + last_kept - 1u;
  return std::bit_cast<float>(pattern & ~((1u << dropped) - 1u));
}

// Writes pressures with as many significant bits as the cube keeps.
template <typename Part>
void write_pressures(const FileContext& place, hid_t file, const DatasetName& name, const Cube& cube, Part part) {
  const int bits = cube.keep_bits;
  if (bits == Cube::all_bits) return write_images(place, file, name, cube.pings, part, Packing::none);
  const auto round = [bits](const std::complex<float>& p) {
    return std::complex<float>(rounded(p.real(), bits), rounded(p.imag(), bits));
  };
  write_images(
      place, file, name, cube.pings, [&](const Ping& ping) -> ComplexGridF { return part(ping).unaryExpr(round); },
      Packing::deflate);
}

// Writes the levels of display cells, in place of pressures.
template <typename Part>
void write_levels(const FileContext& place, hid_t file, const DatasetName& name, const Cube& cube, Part part) {
  write_images(
      place, file, name, cube.pings,
      [&](const Ping& ping) -> Grid<std::int16_t> { return stored_levels(part(ping)); }, Packing::none);
  const Handle dataset = open_dataset(place, file, name);
  write_attribute(place, dataset, scale_factor_attribute, level_step);
}

// Writes pressures, or the levels of display cells.
template <typename Part>
void write_signal(const FileContext& place, hid_t file, DatasetName name, const Cube& cube, Part part) {
  if (!cube.pings.front().display_cells) return write_pressures(place, file, name, cube, part);
  name.unit = level_name.unit, name.about = level_name.about;
  write_levels(place, file, name, cube, part);
}

void write_layers(const FileContext& place, hid_t file, const Cube& cube) {
  const std::vector<Layer>& layers = cube.pings.front().layers;
  if (layers.empty()) return;
  const Handle group = create_ordered_group(place, file, layers_group);
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const std::string path = std::string(layers_group) + "/" + layers[l].name;
    write_signal(place, file, {path.c_str(), pressure_name.unit, pressure_name.about}, cube,
                    [l](const Ping& ping) -> const ComplexGridF& { return ping.layers[l].pressure; });
  }
}

void write_maps(const FileContext& place, hid_t file, const std::vector<Ping>& pings) {
  // Noise-like numbers do not become smaller; masks and labels do.
  const auto write = [&](const DatasetName& name, auto map, Packing packing) {
    if ((pings.front().*map).size() > 0)
      write_images(
          place, file, name, pings, [map](const Ping& ping) -> const auto& { return ping.*map; }, packing);
  };
  write(intensity_name, &Ping::intensity, Packing::none);
  write(unknown_name, &Ping::unknown, Packing::deflate);
  write(split_phase_name, &Ping::split_phase, Packing::none);
  const PixelLabels& first = pings.front().labels;
  if (first.empty()) return;
  const auto write_label = [&](const DatasetName& name, auto label) {
    write_images(
        place, file, name, pings, [label](const Ping& ping) -> const auto& { return ping.labels.*label; },
        Packing::deflate);
  };
  write_label(label_material_name, &PixelLabels::material);
  write_label(label_id_name, &PixelLabels::id);
  write_label(label_share_name, &PixelLabels::share);
  if (first.part.size() > 0) write_label(label_part_name, &PixelLabels::part);
  write_parts(place, file, pings);
  // An empty last name is a line of its own.
  const bool ends_empty = !first.names.empty() && first.names.back().empty();
  write_attribute(place, file, label_names_attribute, joined(first.names, "\n") + (ends_empty ? "\n" : ""));
}

void write_axes(const FileContext& place, hid_t file, const BeamFan& fan, const RangeGate& gate) {
  std::vector<double> range(gate.bins());
  for (std::size_t n = 0; n < range.size(); ++n) range[n] = gate.centre(n);
  write_numbers(place, file, range_name, {range.size()}, range.data());
  write_numbers(place, file, azimuth_name, {fan.beams()}, fan.azimuth.data());
  write_numbers(place, file, elevation_name, {fan.beams()}, fan.elevation.data());
}

void append_pose(std::vector<double>& numbers, const Pose& pose) {
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(pose.matrix()(row, column));
}

void write_track(const FileContext& place, hid_t file, const std::vector<Ping>& pings) {
  std::vector<double> pose, time;
  std::vector<std::int64_t> number;
  for (const Ping& ping : pings) {
    append_pose(pose, ping.world_from_head);
    time.push_back(ping.time);
    number.push_back(ping.number);
  }
  write_numbers(place, file, pose_name, {pings.size(), 4, 4}, pose.data());
  write_numbers(place, file, time_name, {pings.size()}, time.data());
  write_numbers(place, file, ping_name, {pings.size()}, number.data());
}

// The water at the head of every ping, if any has another than the cube says.
void write_water(const FileContext& place, hid_t file, const Cube& cube) {
  std::vector<double> speed, absorption;
  bool differ = false;
  for (const Ping& ping : cube.pings) {
    const bool known = ping.sound_speed > 0;
    speed.push_back(known ? ping.sound_speed : cube.sound_speed);
    absorption.push_back(known ? ping.absorption_db_per_m : cube.absorption_db_per_m);
    differ |= speed.back() != cube.sound_speed || absorption.back() != cube.absorption_db_per_m;
  }
  if (!differ) return;
  write_numbers(place, file, sound_speed_name, {speed.size()}, speed.data());
  write_numbers(place, file, absorption_name, {absorption.size()}, absorption.data());
}

// How the head moves in every ping, if it does in any.
void write_motion(const FileContext& place, hid_t file, const std::vector<Ping>& pings) {
  if (std::all_of(pings.begin(), pings.end(), [](const Ping& ping) { return ping.motion.none(); })) return;
  std::vector<Eigen::Vector3d> velocity, turn_rate;
  for (const Ping& ping : pings) {
    velocity.push_back(ping.motion.velocity);
    turn_rate.push_back(ping.motion.turn_rate);
  }
  write_numbers(place, file, velocity_name, {pings.size(), 3}, velocity.front().data());
  write_numbers(place, file, turn_rate_name, {pings.size(), 3}, turn_rate.front().data());
}

// Of a scanning head: its own turn, and time and pose of every beam.
void write_scan(const FileContext& place, hid_t file, const std::vector<Ping>& pings) {
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
  write_numbers(place, file, scan_angle_name, {pings.size()}, angle.data());
  write_numbers(place, file, sweep_name, {pings.size()}, sweep.data());
  write_numbers(place, file, beam_time_name, {pings.size(), beams}, time.data());
  write_numbers(place, file, beam_pose_name, {pings.size(), beams, 4, 4}, pose.data());
}

void write_root_attributes(const FileContext& place, hid_t file, const Cube& cube) {
  write_attribute(place, file, "schema", cube_schema);
  write_attribute(place, file, "insonify_version", cube.insonify_version);
  write_attribute(place, file, "sonar", cube.sonar);
  write_attribute(place, file, "sound_speed", cube.sound_speed);
  write_attribute(place, file, "absorption_db_per_m", cube.absorption_db_per_m);
  write_attribute(place, file, "centre_frequency", cube.centre_frequency);
  write_attribute(place, file, "bandwidth", cube.bandwidth);
  write_attribute(place, file, "source_level_db", cube.source_level_db);
  write_attribute(place, file, "seed", cube.seed);
  write_attribute(place, file, "tolerance", cube.tolerance);
  if (cube.keep_bits < Cube::all_bits) write_attribute(place, file, keep_bits_attribute, std::int64_t{cube.keep_bits});
  const Ping& ping = cube.pings.front();
  write_attribute(place, file, "beam_width", ping.fan.beam_width);
  write_attribute(place, file, "elevation_width", ping.fan.elevation_width);
  if (ping.display_cells)
    write_attribute(place, file, display_cells_attribute, std::string(display_cells_text));
  if (ping.expected_level) write_attribute(place, file, expected_level_attribute, std::string(expected_level_text));
  if (ping.fan.row_width > 0) write_attribute(place, file, "row_width", ping.fan.row_width);
  write_attribute(place, file, "min_range", ping.gate.min_range);
  write_attribute(place, file, "max_range", ping.gate.max_range);
  write_attribute(place, file, "bin_size", ping.gate.bin_size);
  if (!cube.head.empty()) write_attribute(place, file, head_attribute, cube.head);
  if (!cube.notes.empty()) write_attribute(place, file, notes_attribute, as_lines(cube.notes));
  if (!cube.start_utc.empty()) write_attribute(place, file, start_utc_attribute, cube.start_utc);
  if (!cube.anchor) return;
  write_attribute(place, file, anchor_latitude_attribute, cube.anchor->latitude_deg);
  write_attribute(place, file, anchor_longitude_attribute, cube.anchor->longitude_deg);
  write_attribute(place, file, anchor_heading_attribute, cube.anchor->heading_deg);
}

}  // namespace

void write_cube(const std::string& path, const Cube& cube) {
  require_writable(cube, path);
  write_hdf5(path, [&](const FileContext& place, hid_t file) {
    write_root_attributes(place, file, cube);
    write_axes(place, file, cube.pings.front().fan, cube.pings.front().gate);
    write_track(place, file, cube.pings);
    write_water(place, file, cube);
    write_motion(place, file, cube.pings);
    write_scan(place, file, cube.pings);
    write_signal(place, file, cube.pings.front().display_cells ? level_name : pressure_name, cube,
                 [](const Ping& ping) -> const ComplexGridF& { return ping.pressure; });
    write_layers(place, file, cube);
    write_maps(place, file, cube.pings);
    name_dimensions(place, file);
  });
}

}  // namespace insonify

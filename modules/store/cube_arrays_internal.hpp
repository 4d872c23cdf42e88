// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "files/child_arrays.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube.hpp"
#include "store/cube_layout_internal.hpp"

// Private to store: the data that the reader of a cube sends.
namespace insonify {

template <typename Stream>
void pass(Stream& stream, BeamFan& fan) {
  stream(fan.azimuth, fan.elevation, fan.beam_width, fan.elevation_width, fan.row_width);
}

template <typename Stream>
void pass(Stream& stream, TrackPoint& point) {
  stream(point.number, point.time, point.world_from_head, point.scan, point.sound_speed, point.absorption_db_per_m,
         point.motion.velocity, point.motion.turn_rate);
}

template <typename Stream>
void pass(Stream& stream, PingNote& note) {
  stream(note.kind, note.text, note.count, note.first);
}

/// Sends or receives every member but the pings.
template <typename Stream>
void pass(Stream& stream, Cube& cube) {
  stream(cube.sound_speed, cube.absorption_db_per_m, cube.centre_frequency, cube.bandwidth, cube.source_level_db,
         cube.seed, cube.tolerance, cube.keep_bits, cube.sonar, cube.insonify_version, cube.head, cube.start_utc,
         cube.anchor, cube.notes);
}

/// Returns the texts that stand one a line.
std::vector<std::string> texts_in(const std::string& lines);

/// Facts about the pings of a cube without their images.
struct CubeTable {
  hdf5::Extent extent{};  ///< extent of /pressure
  BeamFan fan{};
  RangeGate gate{};
  bool expected_level = false, display_cells = false;
  std::vector<TrackPoint> track{};
};

template <typename Stream>
void pass(Stream& stream, CubeTable& table) {
  stream(table.extent, table.fan, table.gate, table.expected_level, table.display_cells, table.track);
}

/// Consecutive pings of a cube, by their order in it.
struct PingRange {
  std::size_t begin = 0, end = 0;
};

/// Throws Error(content) unless a dataset holds complex numbers.
void require_complex(const hdf5::FileContext& context, hid_t dataset, const std::string& name);

/// Returns the name of the image of a cube: /level if it has display cells, else /pressure.
DatasetName image_name_of(hid_t file);
/// Returns true if a cube has display cells.
inline bool has_levels(hid_t file) { return image_name_of(file).path == std::string(level_name.path); }

/// Returns levels of display cells as they are stored, in steps of level_step.
Grid<std::int16_t> stored_levels(const ComplexGridF& pressure);
/// Returns the pressures, without phase, of stored levels [Pa].
ComplexGridF pressures_of(const Grid<std::int16_t>& levels);

/// Calls use(name, image) for the maps of the labels of pixels: the dataset, and the member of PixelLabels. Cubes with
/// labels have the first three.
template <typename Use>
void for_each_label_map(const Use& use) {
  use(label_material_name, &PixelLabels::material);
  use(label_id_name, &PixelLabels::id);
  use(label_share_name, &PixelLabels::share);
  use(label_part_name, &PixelLabels::part);
  use(label_elevation_name, &PixelLabels::elevation);
  use(label_second_name, &PixelLabels::second);
  use(label_second_share_name, &PixelLabels::second_share);
}

/// Writes the images of all pings: pressures or levels, layers, maps and labels.
void write_all_images(const hdf5::FileContext& context, hid_t file, const Cube& cube);

/// Sends the images of pings of a cube of `extent`: pressure, layers, maps and labels.
void send_all_images(const hdf5::FileContext& context, hid_t file, const hdf5::Extent& extent, PingRange pings,
                     ArraySender& to);

/// Fills the images of pings with the data that send_all_images sent. `path` is the path of the file.
void receive_all_images(ArrayReceiver& sent, const std::string& path, std::vector<Ping>& pings);

}  // namespace insonify

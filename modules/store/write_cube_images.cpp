// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <complex>
#include <cstdint>
#include <type_traits>

#include "core/text.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube_arrays_internal.hpp"
#include "store/cube_layout_internal.hpp"
#include "store/cube_parts_internal.hpp"

// Writes the images of a cube.
namespace insonify {

using namespace hdf5;

namespace {

// Returns the number of beams in a chunk of one ping and all bins: up to 64, fewer if the chunk exceeds 64 MiB.
hsize_t beams_per_chunk(hsize_t beams, hsize_t bins) {
  const hsize_t bytes_per_beam = bins * sizeof(std::complex<float>);
  return std::clamp<hsize_t>((hsize_t{64} << 20) / bytes_per_beam, 1, std::min<hsize_t>(beams, 64));
}

// Returns the HDF5 type of an image's values in the file or in memory.
template <typename Number>
Handle image_type(const FileContext& context, bool in_file) {
  if constexpr (std::is_same_v<Number, std::complex<float>>)
    return complex_type(context, in_file ? H5T_IEEE_F32LE : H5T_NATIVE_FLOAT);
  return {context.checked(H5Tcopy(type_of<Number>(in_file)), "type"), H5Tclose};
}

// Writes one image per ping: the pressure, layer or map selected by `part`.
template <typename Part>
void write_images(const FileContext& context, hid_t file, const DatasetName& name, const std::vector<Ping>& pings,
                  Part part, Packing packing) {
  const hsize_t beams = pings[0].fan.beams(), bins = pings[0].gate.bins();
  const Extent extent = {pings.size(), beams, bins};
  using Number = typename std::decay_t<decltype(part(pings[0]))>::Scalar;
  const Handle stored = image_type<Number>(context, true), here = image_type<Number>(context, false);
  const Handle dataset =
      create_dataset(context, file, name, stored, extent, {1, beams_per_chunk(beams, bins), bins}, packing);
  if constexpr (std::is_same_v<Number, std::complex<float>>)
    write_attribute(context, dataset, convention_attribute, std::string(pressure_convention));
  const Extent one_ping = {1, beams, bins};
  const Handle memory = space_of(context, one_ping);
  for (std::size_t p = 0; p < pings.size(); ++p) {
    const Handle row = block_of(context, extent, {p, 0, 0}, one_ping);
    context.checked(H5Dwrite(dataset, here, memory, row, H5P_DEFAULT, part(pings[p]).data()), name.path);
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
void write_pressures(const FileContext& context, hid_t file, const DatasetName& name, const Cube& cube, Part part) {
  const int bits = cube.keep_bits;
  if (bits == Cube::all_bits) return write_images(context, file, name, cube.pings, part, Packing::none);
  const auto round = [bits](const std::complex<float>& p) {
    return std::complex<float>(rounded(p.real(), bits), rounded(p.imag(), bits));
  };
  write_images(
      context, file, name, cube.pings, [&](const Ping& ping) -> ComplexGridF { return part(ping).unaryExpr(round); },
      Packing::deflate);
}

// Writes the levels of display cells, in place of pressures.
template <typename Part>
void write_levels(const FileContext& context, hid_t file, const DatasetName& name, const Cube& cube, Part part) {
  // Levels with labels, which are packed and read with them, are packed as well: to three quarters.
  const Packing packing = cube.pings.front().labels.empty() ? Packing::none : Packing::deflate;
  write_images(
      context, file, name, cube.pings,
      [&](const Ping& ping) -> Grid<std::int16_t> { return stored_levels(part(ping)); }, packing);
  const Handle dataset = open_dataset(context, file, name);
  write_attribute(context, dataset, scale_factor_attribute, level_step);
}

template <typename Part>
void write_signal(const FileContext& context, hid_t file, DatasetName name, const Cube& cube, Part part) {
  if (!cube.pings.front().display_cells) return write_pressures(context, file, name, cube, part);
  name.unit = level_name.unit, name.about = level_name.about;
  write_levels(context, file, name, cube, part);
}

void write_layers(const FileContext& context, hid_t file, const Cube& cube) {
  const std::vector<Layer>& layers = cube.pings.front().layers;
  if (layers.empty()) return;
  const Handle group = create_ordered_group(context, file, layers_group);
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const std::string path = std::string(layers_group) + "/" + layers[l].name;
    write_signal(context, file, {path.c_str(), pressure_name.unit, pressure_name.about}, cube,
                 [l](const Ping& ping) -> const ComplexGridF& { return ping.layers[l].pressure; });
  }
}

void write_maps(const FileContext& context, hid_t file, const std::vector<Ping>& pings) {
  // Compression makes masks and labels smaller, but not numbers that look like noise.
  const auto write = [&](const DatasetName& name, auto map, Packing packing) {
    if ((pings.front().*map).size() > 0)
      write_images(
          context, file, name, pings, [map](const Ping& ping) -> const auto& { return ping.*map; }, packing);
  };
  write(intensity_name, &Ping::intensity, Packing::none);
  write(unknown_name, &Ping::unknown, Packing::deflate);
  write(split_phase_name, &Ping::split_phase, Packing::none);
  const PixelLabels& first = pings.front().labels;
  if (first.empty()) return;
  for_each_label_map([&](const DatasetName& name, auto label) {
    if ((first.*label).size() > 0)
      write_images(
          context, file, name, pings, [label](const Ping& ping) -> const auto& { return ping.labels.*label; },
          Packing::deflate);
  });
  write_parts(context, file, pings);
  // If the last name is empty, it is a line of its own.
  const bool ends_empty = !first.names.empty() && first.names.back().empty();
  write_attribute(context, file, label_names_attribute, joined(first.names, "\n") + (ends_empty ? "\n" : ""));
}

}  // namespace

void write_all_images(const FileContext& context, hid_t file, const Cube& cube) {
  write_signal(context, file, cube.pings.front().display_cells ? level_name : pressure_name, cube,
               [](const Ping& ping) -> const ComplexGridF& { return ping.pressure; });
  write_layers(context, file, cube);
  write_maps(context, file, cube.pings);
}

}  // namespace insonify

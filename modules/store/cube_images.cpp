// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <numbers>
#include <ranges>
#include <type_traits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "hdf/hdf5_internal.hpp"
#include "store/cube_arrays_internal.hpp"
#include "store/cube_layout_internal.hpp"
#include "store/cube_parts_internal.hpp"

// Sends the images of a cube from the process that reads them.
namespace insonify {

using namespace hdf5;

void require_complex(const FileContext& context, hid_t dataset, const std::string& name) {
  const Handle type(context.checked(H5Dget_type(dataset), name), H5Tclose);
  for (const char* member : {"r", "i"}) {
    const int at = H5Tget_class(type) == H5T_COMPOUND ? H5Tget_member_index(type, member) : -1;
    if (at < 0) fail(context.kind, context.path, ": ", name, " must be compound {r, i}");
    const Handle number(context.checked(H5Tget_member_type(type, static_cast<unsigned>(at)), name), H5Tclose);
    const std::size_t size = H5Tget_size(type), begin = H5Tget_member_offset(type, static_cast<unsigned>(at));
    // HDF5 would read beyond the number.
    if (begin > size || H5Tget_size(number) > size - begin)
      fail(context.kind, context.path, ": ", name, " has a member ", member, " at byte ", begin, " of ", size,
           "; the file is damaged: copy or export it again");
  }
}

namespace {

/// A part of an image that the file holds in consecutive bytes.
struct Piece {
  std::uint64_t begin, bytes;
};

/// Returns the parts of a large image in the file, in the order of memory, if they have the same form there. Returns
/// nothing for an image that is small, packed, of another type, or not in this file.
std::vector<Piece> pieces_of(hid_t dataset, hid_t type, const Extent& extent, hsize_t ping) {
  constexpr hsize_t large = 1 << 20;
  const hsize_t row = extent[2] * H5Tget_size(type);
  const Handle stored(H5Dget_type(dataset), H5Tclose), properties(H5Dget_create_plist(dataset), H5Pclose);
  if (extent[1] * row < large || H5Tequal(stored, type) <= 0 || H5Pget_nfilters(properties) != 0) return {};
  const Handle file(H5Iget_file_id(dataset), H5Fclose), made(H5Fget_create_plist(file), H5Pclose);
  hsize_t before_file = 0;
  if (H5Pget_userblock(made, &before_file) < 0 || before_file != 0) return {};
  if (H5Pget_layout(properties) == H5D_CONTIGUOUS) {
    const haddr_t begin = H5Dget_offset(dataset);
    return begin == HADDR_UNDEF ? std::vector<Piece>{}
                                : std::vector{Piece{begin + ping * extent[1] * row, extent[1] * row}};
  }
  std::array<hsize_t, 3> chunk{};
  if (H5Pget_layout(properties) != H5D_CHUNKED || H5Pget_chunk(properties, 3, chunk.data()) != 3 || chunk[0] != 1 ||
      chunk[1] == 0 || chunk[2] != extent[2])
    return {};
  std::vector<Piece> pieces;
  for (hsize_t beam = 0; beam < extent[1]; beam += chunk[1]) {
    const std::array<hsize_t, 3> first = {ping, beam, 0};
    unsigned skipped_filters = 0;
    haddr_t begin = HADDR_UNDEF;
    hsize_t bytes = 0;
    if (H5Dget_chunk_info_by_coord(dataset, first.data(), &skipped_filters, &begin, &bytes) < 0 || begin == HADDR_UNDEF)
      return {};
    pieces.push_back({begin, std::min(chunk[1], extent[1] - beam) * row});
  }
  return pieces;
}

// Sends one image of `type` per ping: for a large one its position in the file, from which the receiver copies it,
// else its numbers.
void send_images(const FileContext& context, hid_t dataset, const std::string& name, hid_t type, PingRange pings,
                 ArraySender& to) {
  const Extent extent = extent_of(context, dataset, name, 3);
  const Extent one_ping = {1, extent[1], extent[2]};
  const Handle memory = space_of(context, one_ping);
  for (std::size_t p = pings.begin; p < pings.end; ++p) {
    const std::vector<Piece> pieces = pieces_of(dataset, type, extent, p);
    to(pieces);
    if (!pieces.empty()) {
      to(extent[1], extent[2]);
      continue;
    }
    const Handle row = block_of(context, extent, {p, 0, 0}, one_ping);
    const auto rows = static_cast<Eigen::Index>(extent[1]), columns = static_cast<Eigen::Index>(extent[2]);
    read_values(context, dataset, {type, memory, row}, to.take_grid(rows, columns, H5Tget_size(type)), name);
  }
}

/// Sets an image to the data that send_images sent.
template <typename Number>
void receive_image(ArrayReceiver& sent, const std::string& path, Grid<Number>& image) {
  std::vector<Piece> pieces;
  sent(pieces);
  if (pieces.empty()) return sent(image);
  hsize_t beams = 0, bins = 0;
  sent(beams, bins);
  image.resize(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(bins));
  std::uint64_t bytes = 0;
  for (const Piece& piece : pieces) bytes += piece.bytes;
  std::ifstream file(path, std::ios::binary);
  if (bytes != sizeof(Number) * beams * bins) file.setstate(std::ios::failbit);
  char* to = reinterpret_cast<char*>(image.data());
  for (const Piece& piece : pieces) {
    file.seekg(static_cast<std::streamoff>(piece.begin)).read(to, static_cast<std::streamsize>(piece.bytes));
    to += piece.bytes;
  }
  if (!file) fail(ErrorKind::content, path, ": an image ends beyond the file; it is cut off: copy or export it again");
}

void require_extent(const FileContext& context, hid_t dataset, const std::string& name, const Extent& extent) {
  if (extent_of(context, dataset, name, 3) != extent)
    fail(context.kind, context.path, ": ", name, " differs in extent from /pressure");
}

// Sends an image of pressures, or of levels of display cells.
void send_signal(const FileContext& context, hid_t dataset, const std::string& name, bool levels, PingRange pings,
                 ArraySender& to) {
  if (levels) return send_images(context, dataset, name, H5T_NATIVE_INT16, pings, to);
  require_complex(context, dataset, name);
  send_images(context, dataset, name, complex_type(context, H5T_NATIVE_FLOAT), pings, to);
}

void receive_signal(ArrayReceiver& sent, const std::string& path, bool levels, ComplexGridF& pressure) {
  if (!levels) return receive_image(sent, path, pressure);
  Grid<std::int16_t> stored;
  receive_image(sent, path, stored);
  pressure = pressures_of(stored);
}

void send_layers(const FileContext& context, hid_t file, const Extent& extent, bool levels, PingRange pings,
                 ArraySender& to) {
  const std::vector<std::string> layers = names_in(context, file, layers_group);
  to(layers);
  for (const std::string& layer : layers) {
    const std::string path = std::string(layers_group) + "/" + layer;
    const Handle dataset = open_dataset(context, file, {path.c_str(), levels ? level_name.unit : pressure_name.unit});
    require_extent(context, dataset, path, extent);
    send_signal(context, dataset, path, levels, pings, to);
  }
}

// Sends true if there is an optional map of numbers, and then that of each ping; else false.
template <typename Number>
void send_map(const FileContext& context, hid_t file, const DatasetName& name, const Extent& extent, PingRange pings,
              ArraySender& to) {
  const bool there = H5Lexists(file, name.path, H5P_DEFAULT) > 0;
  to(there);
  if (!there) return;
  const Handle dataset = open_dataset(context, file, name);
  require_extent(context, dataset, name.path, extent);
  const hid_t type = type_of<Number>(false);
  const Handle stored(context.checked(H5Dget_type(dataset), name.path), H5Tclose);
  if (H5Tget_class(stored) != H5Tget_class(type) || H5Tget_size(stored) != sizeof(Number))
    fail(context.kind, context.path, ": ", name.path, " must be of ",
         std::is_floating_point_v<Number> ? "float" : "uint", 8 * sizeof(Number));
  send_images(context, dataset, name.path, type, pings, to);
}

template <typename Map>
void receive_map(ArrayReceiver& sent, const std::string& path, std::vector<Ping>& pings, const Map& map) {
  bool there = false;
  sent(there);
  if (!there) return;
  for (Ping& ping : pings) receive_image(sent, path, std::invoke(map, ping));
}

void send_labels(const FileContext& context, hid_t file, const Extent& extent, PingRange pings, ArraySender& to) {
  const bool there = H5Lexists(file, label_material_name.path, H5P_DEFAULT) > 0, parts = there && has_parts(file);
  to(there, parts);
  if (!there) return;
  for (const DatasetName& name : {label_id_name, label_share_name}) open_dataset(context, file, name);  // must be there
  for_each_label_map([&]<typename Number>(const DatasetName& name, Grid<Number> PixelLabels::*) {
    send_map<Number>(context, file, name, extent, pings, to);
  });
  to(texts_in(read_text(context, file, label_names_attribute)));
  if (parts) send_parts(context, file, extent, pings, to);
}

/// Throws Error(content) for a pixel whose label has no name; labels from `reserved` on need none.
void require_names(const std::string& path, const char* map, const Grid<std::uint16_t>& labels, std::uint16_t reserved,
                   const char* attribute, std::size_t names) {
  const auto nameless = std::find_if(labels.data(), labels.data() + labels.size(),
                                     [&](std::uint16_t label) { return label >= names && label < reserved; });
  if (nameless != labels.data() + labels.size())
    fail(ErrorKind::content, path, ": ", map, " holds ", *nameless, ", but ", attribute, " has ", names,
         " names, counted from 0; the file is damaged: copy or export it again");
}

void receive_labels(ArrayReceiver& sent, const std::string& path, std::vector<Ping>& pings) {
  bool there = false, parts = false;
  sent(there, parts);
  if (!there) return;
  for_each_label_map([&](const DatasetName&, auto map) {
    receive_map(
        sent, path, pings, [map](Ping & ping) -> auto& { return ping.labels.*map; });
  });
  std::vector<std::string> names;
  sent(names);
  for (Ping& ping : pings) ping.labels.names = names;
  if (parts) receive_parts(sent, pings);
  for (const PixelLabels& labels : pings | std::views::transform(&Ping::labels)) {
    require_names(path, label_material_name.path, labels.material, PixelLabels::shadow, label_names_attribute,
                  labels.names.size());
    require_names(path, label_second_name.path, labels.second, PixelLabels::nothing, label_names_attribute,
                  labels.names.size());
    require_names(path, label_part_name.path, labels.part, PixelLabels::no_part, part_names_attribute,
                  labels.part_names.size());
  }
}

}  // namespace

DatasetName image_name_of(hid_t file) {
  return H5Lexists(file, level_name.path, H5P_DEFAULT) > 0 ? level_name : pressure_name;
}

Grid<std::int16_t> stored_levels(const ComplexGridF& pressure) {
  return pressure.unaryExpr([](const std::complex<float>& p) {
    const double steps = std::round(pressure_level_db(std::abs(std::complex<double>(p))) / level_step);
    return steps >= silence_db / level_step ? static_cast<std::int16_t>(std::min(steps, 32767.0)) : no_level;
  });
}

ComplexGridF pressures_of(const Grid<std::int16_t>& levels) {
  return levels.unaryExpr([](std::int16_t level) {
    const double rms = micropascal * amplitude_from_db(level * level_step);
    return std::complex<float>(level == no_level ? 0.f : static_cast<float>(std::numbers::sqrt2 * rms), 0.f);
  });
}

void send_all_images(const FileContext& context, hid_t file, const Extent& extent, PingRange pings, ArraySender& to) {
  const DatasetName image = image_name_of(file);
  const bool levels = has_levels(file);
  send_signal(context, open_dataset(context, file, image), image.path, levels, pings, to);
  send_layers(context, file, extent, levels, pings, to);
  send_map<float>(context, file, intensity_name, extent, pings, to);
  send_map<std::uint8_t>(context, file, unknown_name, extent, pings, to);
  send_map<float>(context, file, split_phase_name, extent, pings, to);
  send_labels(context, file, extent, pings, to);
}

void receive_all_images(ArrayReceiver& sent, const std::string& path, std::vector<Ping>& pings) {
  for (Ping& ping : pings) receive_signal(sent, path, ping.display_cells, ping.pressure);
  std::vector<std::string> layers;
  sent(layers);
  for (const std::string& layer : layers)
    for (Ping& ping : pings)
      receive_signal(sent, path, ping.display_cells, ping.layers.emplace_back(Layer{layer, {}}).pressure);
  receive_map(sent, path, pings, &Ping::intensity);
  receive_map(sent, path, pings, &Ping::unknown);
  receive_map(sent, path, pings, &Ping::split_phase);
  receive_labels(sent, path, pings);
}

}  // namespace insonify

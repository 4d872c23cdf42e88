// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "store/cube_axes_internal.hpp"
#include "store/cube_layout_internal.hpp"
#include "store/cube_parts_internal.hpp"

namespace insonify {

using namespace hdf5;

namespace {

// Three rows of a pose, the share, six extents, the scale and three sizes. Earlier cubes end after three extents.
constexpr std::size_t numbers_before = 19, numbers_per_view = 29;

void put_view(const PartView& view, std::vector<double>& numbers) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(view.world_from_part.matrix()(row, column));
  numbers.push_back(view.visible_share);
  for (const PartView::Extent& extent :
       {view.azimuth, view.elevation, view.range, view.beam_azimuth, view.ahead, view.port})
    numbers.push_back(extent.least), numbers.push_back(extent.most);
  numbers.push_back(view.scale);
  numbers.insert(numbers.end(), view.size.begin(), view.size.end());
}

PartView view_of(const double* numbers) {
  PartView view;
  view.world_from_part.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers);
  numbers += 12;
  view.visible_share = *numbers++;
  for (PartView::Extent* extent :
       {&view.azimuth, &view.elevation, &view.range, &view.beam_azimuth, &view.ahead, &view.port})
    extent->least = *numbers++, extent->most = *numbers++;
  view.scale = *numbers++;
  for (double& size : view.size) size = *numbers++;
  return view;
}

/// Returns the numbers of the views of `parts` parts in each ping; NaN for those that cubes of earlier versions lack.
std::vector<double> read_views(const FileContext& context, hid_t file, std::size_t pings, std::size_t parts) {
  const Extent there = extent_of(context, open_dataset(context, file, part_views_name), part_views_name.path, 3);
  const bool before = there[2] == numbers_before;
  const std::size_t stored = before ? numbers_before : numbers_per_view;
  std::vector<double> numbers = read_all<double>(context, file, part_views_name, {pings, parts, stored});
  if (!before) return numbers;
  std::vector<double> all(pings * parts * numbers_per_view, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t view = 0; view < pings * parts; ++view)
    std::copy_n(&numbers[view * stored], stored, &all[view * numbers_per_view]);
  return all;
}

/// Returns the texts as lines. Each has an end of line, because the last text may be empty.
std::string lines_of(const std::vector<std::string>& texts) {
  std::string lines;
  for (const std::string& text : texts) lines += text + "\n";
  return lines;
}

}  // namespace

std::vector<std::string> texts_in(const std::string& lines) {
  std::istringstream in(lines);
  std::vector<std::string> texts;
  for (std::string text; std::getline(in, text);) texts.push_back(text);
  return texts;
}

void require_same_parts(const Ping& ping, const Ping& first, const std::string& path) {
  if (ping.labels.part_names != first.labels.part_names || ping.labels.part_labels != first.labels.part_labels)
    fail(ErrorKind::argument, "write_cube: ", path, ": ping ", ping.number, " is of a scene of other parts than ping ",
         first.number, "; write it to a cube of its own");
}

void write_parts(const FileContext& context, hid_t file, const std::vector<Ping>& pings) {
  const PixelLabels& first = pings.front().labels;
  if (first.part_names.empty()) return;
  std::vector<double> numbers;
  for (const Ping& ping : pings) {
    if (ping.labels.views.size() != first.part_names.size())
      fail(ErrorKind::argument, "write_cube: ", context.path, ": ping ", ping.number, " has views of ",
           ping.labels.views.size(), " parts, must have ", first.part_names.size());
    for (const PartView& view : ping.labels.views) put_view(view, numbers);
  }
  write_numbers(context, file, part_views_name, {pings.size(), first.part_names.size(), numbers_per_view},
                numbers.data());
  write_attribute(context, file, part_names_attribute, lines_of(first.part_names));
  write_attribute(context, file, part_labels_attribute, lines_of(first.part_labels));
}

bool has_parts(hid_t file) { return H5Lexists(file, part_views_name.path, H5P_DEFAULT) > 0; }

void send_parts(const FileContext& context, hid_t file, const Extent& extent, PingRange pings, ArraySender& to) {
  const std::vector<std::string> names = texts_in(read_text(context, file, part_names_attribute));
  const std::vector<std::string> labels = texts_in(read_text(context, file, part_labels_attribute));
  if (labels.size() != names.size())
    fail(context.kind, context.path, ": ", part_labels_attribute, " has ", labels.size(), " lines, but ",
         part_names_attribute, " has ", names.size());
  const std::vector<double> numbers = read_views(context, file, extent[0], names.size());
  const std::size_t per_ping = names.size() * numbers_per_view;
  to(names, labels,
     std::vector<double>(numbers.begin() + static_cast<std::ptrdiff_t>(pings.begin * per_ping),
                         numbers.begin() + static_cast<std::ptrdiff_t>(pings.end * per_ping)));
}

void receive_parts(ArrayReceiver& sent, std::vector<Ping>& pings) {
  std::vector<std::string> names, labels;
  std::vector<double> numbers;
  sent(names, labels, numbers);
  const double* at = numbers.data();
  for (Ping& ping : pings) {
    ping.labels.part_names = names, ping.labels.part_labels = labels;
    for (std::size_t p = 0; p < names.size(); ++p, at += numbers_per_view) ping.labels.views.push_back(view_of(at));
  }
}

}  // namespace insonify

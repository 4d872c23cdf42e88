// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "scene_io/column_names_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t block_rows = 1 << 16;
const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Calls body(first, rows, bytes) for blocks of rows, in parallel.
template <typename Body>
void for_each_block(const RowTable& table, int threads, const Body& body) {
  parallel_blocks(table.rows, block_rows, threads, [&](std::size_t begin, std::size_t end) {
    table.with_rows(begin, end - begin, [&](const char* bytes) { body(begin, end - begin, bytes); });
  });
}

Eigen::Vector3d read_triple(const std::array<const RowTable::Column*, 3>& columns, const char* row) {
  const auto number = [&](int axis) { return columns[axis]->value(row); };
  return {number(0), number(1), number(2)};
}

bool too_far(const Eigen::Vector3d& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() > farthest_coordinate;
}

bool usable(const Eigen::Vector3d& position) { return position.allFinite() && !too_far(position); }

struct Positions {
  const RowTable& table;
  const Columns& found;
  const FileMeaning& meaning;
  FileAxes axes = meaning.axes();

  /// Returns the position of a row [m]; NaN if it is withheld, a hole or otherwise unusable.
  Eigen::Vector3d of(const char* row) const {
    if (table.marks.withheld(row) || table.marks.left_out(row, meaning.classes.value)) return nowhere;
    const Eigen::Vector3d in_file = read_triple(found.position, row), p = axes.position(in_file);
    return usable(p) && !meaning.is_hole(in_file[axes.from[2]]) ? p : nowhere;
  }
};

void add_to(Bounds& box, const Eigen::Vector3d& p) { box = {box.min.cwiseMin(p), box.max.cwiseMax(p)}; }

/// Finds the extent and counts the points that are not used.
void find_extent(RawCloud& raw, const RowTable& table, const Columns& found, const ReadOptions& options) {
  std::vector<RawCloud> blocks((table.rows + block_rows - 1) / block_rows);  // extents and counts
  const FileAxes axes = raw.meaning.axes();
  const std::size_t step = std::max<std::size_t>(1, raw.points_in_file / 8192);
  for_each_block(table, options.threads, [&](std::size_t first, std::size_t rows, const char* bytes) {
    RawCloud& block = blocks[first / block_rows];
    for (std::size_t i = 0; i < rows; ++i) {
      const char* row = bytes + i * table.stride;
      const Eigen::Vector3d p = read_triple(found.position, row);
      const double height = p[axes.from[2]];
      const auto mark = std::find(usual_marks.begin(), usual_marks.end(), height) - usual_marks.begin();
      if (table.marks.withheld(row))
        ++block.withheld;
      else if (table.marks.left_out(row, raw.meaning.classes.value))
        ++block.other_classes;
      else if (raw.meaning.is_hole(height))
        ++block.holes;
      else if (!usable(axes.position(p)))
        ++block.not_finite, block.too_far += too_far(axes.position(p));
      else if (mark < std::ssize(usual_marks))
        ++block.extent.marked[mark], add_to(block.extent.marked_box[mark], p);
      else {
        add_to(block.extent.box, p);
        if ((first + i) % step == 0) block.extent.heights.push_back(height);
      }
    }
  });
  for (const RawCloud& block : blocks) add_counts(raw, block);
}

/// Sets the meaning of the numbers by the file, its headings, the caller and the numbers themselves, then the origin.
void decide_meaning(RawCloud& raw, const RowTable& table, const Columns& found, const ReadOptions& options) {
  take_headings(table, found, raw);
  raw.meaning.override_by(options.meaning);
  if (!raw.meaning.no_lengths.empty() && raw.meaning.unit.origin != MeaningOrigin::option)
    fail(ErrorKind::content, raw.path, ": ", raw.meaning.no_lengths);
  find_extent(raw, table, found, options);
  if (!options.origin) resolve_meaning(raw), require_usable_points(raw, table.rows);
  raw.origin = options.origin ? *options.origin : origin_of(raw);
}

std::uint16_t label_from(double number) {
  return number >= 0 && number < no_label && number == std::floor(number) ? static_cast<std::uint16_t>(number)
                                                                          : no_label;
}

/// Returns the material of the interval that contains `number`; no_label if none does. Intervals do not overlap.
std::uint16_t label_from(double number, const std::vector<MaterialInterval>& intervals) {
  if (intervals.empty()) return label_from(number);
  for (const MaterialInterval& interval : intervals) {
    if (number >= interval.from && number < interval.to) return interval.material;
  }
  return no_label;
}

/// Returns true if every number of the column is an integer that fits 32 bits.
bool holds_ids(const RowTable& table, const RowTable::Column& column, int threads) {
  std::atomic<bool> good{true};
  for_each_block(table, threads, [&](std::size_t, std::size_t rows, const char* bytes) {
    for (std::size_t i = 0; i < rows; ++i) {
      const double id = column.value(bytes + i * table.stride);
      if (!(id >= 0 && id <= std::numeric_limits<std::uint32_t>::max() && id == std::floor(id))) good = false;
    }
  });
  return good;
}

/// Returns the columns that a scene does not use.
std::vector<const RowTable::Column*> others_of(const RowTable& table, const Columns& found) {
  std::vector<const RowTable::Column*> used = {found.area, found.label, found.id, found.noise};
  used.insert(used.end(), found.position.begin(), found.position.end());
  if (found.normal[0]) used.insert(used.end(), found.normal.begin(), found.normal.end());
  std::vector<const RowTable::Column*> others;
  for (const RowTable::Column& column : table.columns)
    if (std::find(used.begin(), used.end(), &column) == used.end()) others.push_back(&column);
  return others;
}

}  // namespace

void add_counts(RawCloud& whole, const RawCloud& part) {
  whole.extent.add(part.extent);
  whole.withheld += part.withheld, whole.not_finite += part.not_finite, whole.too_far += part.too_far;
  whole.holes += part.holes, whole.other_classes += part.other_classes;
}

void require_usable_points(const RawCloud& raw, std::size_t points) {
  if (raw.unused() < points) return;
  if (raw.other_classes > 0)
    fail(ErrorKind::content, raw.path, ": holds no usable point (", raw.other_classes, " of ", points,
         " points are of classes that are not read); give --classes all, or those that count");
  if (raw.holes > 0)
    fail(ErrorKind::content, raw.path, ": holds no usable point (", raw.holes, " of ", points,
         " points mark holes); give --nodata none, or the heights that do mark holes");
  if (raw.withheld > 0)
    fail(ErrorKind::content, raw.path, ": holds no usable point (", raw.withheld, " of ", points,
         " points are marked as withheld); clear the flags, or export the cloud again");
  if (raw.too_far == 0)
    fail(ErrorKind::content, raw.path, ": holds no usable point (", points,
         " points, none with finite coordinates); export the cloud again");
  fail(ErrorKind::content, raw.path, ": holds no usable point (", points, " points, ", raw.too_far,
       " of them with coordinates beyond 1e9 m, the others not finite); give the unit of the file, or move the cloud");
}

Eigen::Vector3d origin_of(const RawCloud& raw) {
  if (raw.tags.origin && raw.meaning.axes().is_identity()) return *raw.tags.origin;
  return (0.5 * (raw.box.min + raw.box.max) + Eigen::Vector3d::Constant(0.5)).array().floor();
}

std::vector<Eigen::Vector3d> read_positions(const RawCloud& raw, const RowTable& table, const ReadOptions& options) {
  const Columns found = find_columns(table, raw.path, raw.tags.name_in_file(options.material_field.name));
  const Positions positions{table, found, raw.meaning};
  std::vector<Eigen::Vector3d> all(table.rows);
  for_each_block(table, options.threads, [&](std::size_t first, std::size_t rows, const char* bytes) {
    for (std::size_t i = 0; i < rows; ++i) all[first + i] = positions.of(bytes + i * table.stride) - raw.origin;
  });
  return all;
}

const RowTable::Column* column_named(const std::vector<RowTable::Column>& columns, const std::string& name) {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  return at == columns.end() ? nullptr : &*at;
}

RowTable table_of_doubles(const std::vector<std::string>& names, std::vector<double> numbers) {
  RowTable table;
  for (const std::string& name : names) table.columns.push_back({name, NumberType::float64, 8 * table.columns.size()});
  table.stride = 8 * names.size();
  table.rows = names.empty() ? 0 : numbers.size() / names.size();
  const auto held = std::make_shared<const std::vector<double>>(std::move(numbers));
  table.bytes = reinterpret_cast<const char*>(held->data());
  table.owner = held;
  return table;
}

void fill_cloud(RawCloud& raw, const RowTable& in_file, const ReadOptions& options) {
  RowTable table = in_file;
  for (RowTable::Column& column : table.columns) column.name = utf8_text(column.name);
  for (FileDescription::Field& field : raw.fields) field.name = utf8_text(field.name);
  for (const std::string& name : raw.material_names) raw.tags.materials.push_back({.name = utf8_text(name)});
  if (table.rows == 0) fail(ErrorKind::content, raw.path, ": holds no point; export the cloud again");
  if (table.rows > std::numeric_limits<std::uint32_t>::max() - 1)
    fail(ErrorKind::content, raw.path, ": holds ", table.rows, " points, must be at most 4294967294; split it");
  const std::string& requested = options.material_field.name;
  const Columns found =
      find_columns(table, raw.path, requested.empty() ? raw.tags.material_field : raw.tags.name_in_file(requested));
  raw.float_coordinates = raw.float_coordinates || found.position[0]->type == NumberType::float32;
  if (raw.points_in_file == 0) raw.points_in_file = table.rows;
  decide_meaning(raw, table, found, options);
  const Positions positions{table, found, raw.meaning};
  if (raw.viewpoint) raw.viewpoint = positions.axes.position(*raw.viewpoint);
  for (Eigen::Vector3d& position : raw.stations) position = positions.axes.position(position);

  // Subtract the origin in double, then round to float.
  raw.point.resize(table.rows);
  const bool normals = found.normal[0];
  if (normals) raw.normal.resize(table.rows);
  if (found.area) raw.area.resize(table.rows);
  if (found.noise) raw.noise.resize(table.rows);
  if (found.label) {
    raw.label.resize(table.rows);
    raw.label_field = raw.tags.meant_name(found.label->name);
  }
  const RowTable::Column* const extra = column_named(table.columns, options.extra_field);
  if (extra) raw.extra.resize(table.rows);
  const bool ids = found.id && holds_ids(table, *found.id, options.threads);
  if (ids) raw.id.resize(table.rows);
  for (const RowTable::Column* column : others_of(table, found)) {
    raw.other_columns.push_back(raw.tags.meant_name(column->name));
    if (options.keep_columns) raw.columns.push_back(copy_of(table, *column, raw.other_columns.back()));
  }
  if (found.label && options.keep_columns) raw.columns.push_back(copy_of(table, *found.label, raw.label_field));
  if (found.id && !ids)
    raw.notes.push_back("field '" + found.id->name + "' does not hold 32-bit integers: ids renumbered");
  for_each_block(table, options.threads, [&](std::size_t first, std::size_t rows, const char* bytes) {
    for (std::size_t i = 0; i < rows; ++i) {
      const char* row = bytes + i * table.stride;
      const auto number = [&](const RowTable::Column& c) { return c.value(row); };
      raw.point[first + i] = (positions.of(row) - raw.origin).cast<float>();
      const Eigen::Vector3d normal = normals ? read_triple(found.normal, row) : Eigen::Vector3d::Zero();
      if (normals) raw.normal[first + i] = positions.axes.normal(normal).cast<float>();
      if (found.area)
        raw.area[first + i] = static_cast<float>(number(*found.area) * positions.axes.area_factor(normal));
      if (found.noise) raw.noise[first + i] = static_cast<float>(number(*found.noise) * raw.meaning.unit.value);
      if (found.label) raw.label[first + i] = label_from(number(*found.label), options.material_field.intervals);
      if (extra) raw.extra[first + i] = number(*extra);
      if (ids) raw.id[first + i] = static_cast<std::uint32_t>(number(*found.id));
    }
  });
  cut_polygons(raw);
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/text.hpp"
#include "scene_io/column_names_internal.hpp"
#include "scene_io/coordinate_system_internal.hpp"

namespace insonify {
namespace {

using Names = std::vector<std::string>;

/// The names by which columns are known; the first that a file has counts.
const struct {
  std::array<Names, 3> position = {
      {{"x", "easting", "east", "e", "x_coordinate", "xcoord", "lon", "longitude", "long", "lng"},
       {"y", "northing", "north", "n", "y_coordinate", "ycoord", "lat", "latitude"},
       {"z", "height", "elevation", "elev", "altitude", "alt", "h", "z_coordinate", "zcoord", "depth", "depths",
        "water_depth", "sounding"}}};
  std::array<std::array<const char*, 3>, 4> normal = {{{"nx", "ny", "nz"},
                                                       {"normal_x", "normal_y", "normal_z"},
                                                       {"normalx", "normaly", "normalz"},
                                                       {"n_x", "n_y", "n_z"}}};
  Names area = {"area"}, noise = {"noise"}, id = {"id"}, label = {"label", "material", "class", "classification"};
  Names degrees = {"lon", "longitude", "long", "lng", "lat", "latitude"};
  Names depths = {"depth", "depths", "water_depth", "sounding"};
} known;

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The plain name of a heading such as "Depth (m)" or "z_mm", and its unit in lower case.
struct Heading {
  std::string name, unit;
};

Heading heading_of(const std::string& text) {
  std::string name = lower_case(std::string(trimmed(text, " \t\"")));
  if (name.rfind("scalar_", 0) == 0) name = name.substr(7);
  Heading heading;
  if (const std::size_t open = name.find_first_of("[({"); open != name.npos && open > 0) {
    const std::size_t close = std::min(name.find_first_of("])},;", open), name.size());
    heading.unit = trimmed(name.substr(open + 1, close - open - 1));
    name = trimmed(name.substr(0, open), " \t_");
  }
  std::replace(name.begin(), name.end(), ' ', '_');
  heading.name = name;
  // A unit after an underscore counts only for coordinates.
  const std::size_t line = name.rfind('_');
  if (line == name.npos || !heading.unit.empty() || !(unit_named(name.substr(line + 1)) || name.ends_with("_deg")))
    return heading;
  const std::string before = name.substr(0, line);
  for (const Names& axis : known.position)
    if (holds(axis, before)) heading = {before, name.substr(line + 1)};
  return heading;
}

/// Returns the first column whose plain name is among `names`, in the order of `names`; null if there is none.
const RowTable::Column* find_column(const RowTable& table, const Names& names) {
  for (const std::string& name : names)
    for (const RowTable::Column& column : table.columns)
      if (plain_name(column.name) == name) return &column;
  return nullptr;
}

const RowTable::Column* find_label(const RowTable& table, const std::string& path, const std::string& name) {
  if (name.empty()) return find_column(table, known.label);
  const RowTable::Column* found = column_named(table.columns, name);
  if (!found) found = find_column(table, {plain_name(name)});
  if (!found)
    fail(ErrorKind::content, path, ": no field '", name, "' to take materials from; its fields are '",
         shortened_list(table.columns, " ", &RowTable::Column::name), "': name one of them");
  return found;
}

}  // namespace

bool is_legal_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto good = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= 64 && letter(name.front()) && std::all_of(name.begin(), name.end(), good) &&
         name != "_" && name != "end_header";
}

std::string plain_name(const std::string& name) { return heading_of(name).name; }

Columns find_columns(const RowTable& table, const std::string& path, const std::string& material_field) {
  Columns found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found.position[axis] = find_column(table, known.position[axis]);
    if (!found.position[axis])
      fail(ErrorKind::content, path, ": expected fields x y z, found '",
           shortened_list(table.columns, " ", &RowTable::Column::name), "'; ", "xyz"[axis], " may also be called ",
           joined(std::vector(known.position[axis].begin() + 1, known.position[axis].end())),
           ": rename the coordinate fields");
  }
  for (const auto& names : known.normal) {
    for (std::size_t axis = 0; axis < 3; ++axis) found.normal[axis] = find_column(table, {names[axis]});
    if (found.normal[0] && found.normal[1] && found.normal[2]) break;
    found.normal = {};
  }
  found.area = find_column(table, known.area);
  found.id = find_column(table, known.id);
  found.noise = find_column(table, known.noise);
  found.label = find_label(table, path, material_field);
  return found;
}

bool name_coordinates(const std::vector<std::string>& names) {
  return std::all_of(known.position.begin(), known.position.end(), [&](const Names& axis) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return holds(axis, plain_name(name)); });
  });
}

void take_headings(const RowTable& table, const Columns& found, RawCloud& raw) {
  FileMeaning& meaning = raw.meaning;
  std::array<Heading, 3> heading;
  for (std::size_t axis = 0; axis < 3; ++axis) heading[axis] = heading_of(found.position[axis]->name);
  raw.named_depth = raw.named_depth || holds(known.depths, heading[2].name);
  const auto quoted = [&](std::size_t axis) { return "'" + found.position[axis]->name + "'"; };

  // Coordinates in degrees: the message has a command with the columns and the zone.
  const auto degrees = [&](const Heading& h) {
    return holds(known.degrees, h.name) || h.unit.starts_with("deg") || h.unit == "\xc2\xb0";
  };
  if (degrees(heading[0]) || degrees(heading[1])) {
    const auto number = [&](std::size_t axis) {
      return std::to_string(found.position[axis] - table.columns.data() + 1);
    };
    double x = 0, y = 0;
    table.with_rows(0, 1,
                    [&](const char* row) { x = found.position[0]->value(row), y = found.position[1]->value(row); });
    meaning.no_lengths =
        "columns " + quoted(0) + " and " + quoted(1) +
        " are degrees, but a scene needs metres; project them: awk -F '[,;[:space:]]+' 'NR > 1 {print $" + number(0) +
        ", $" + number(1) + ", $" + number(2) +
        "}' in.csv | gdaltransform -s_srs EPSG:4326 -t_srs EPSG:" + utm_code(x, y) + " > out.xyz" +
        (raw.named_depth ? ", and give --z down" : "") + if_metres;
    return;
  }
  // Heights have the unit of the plane unless they have their own.
  std::array<double, 3> unit{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (heading[axis].unit.empty()) continue;
    unit[axis] = unit_named(heading[axis].unit).value_or(0);
    if (unit[axis] == 0)
      meaning.unit.sentence =
          "the heading " + quoted(axis) + " does not name a known unit: give --unit if it is not metres";
  }
  for (const std::size_t axis : {0, 1})
    if (unit[axis] == 0) unit[axis] = unit[1 - axis];
  if (unit[0] != unit[1])
    fail(ErrorKind::content, raw.path, ": columns ", quoted(0), " and ", quoted(1),
         " differ in unit; name one for both");
  const auto said = [&](std::size_t axis) -> Meant<double> {
    return {unit[axis], MeaningOrigin::file,
            unit[axis] == 1 ? "" : printed("numbers of '%.60s' become metres", found.position[axis]->name.c_str())};
  };
  if (unit[0] > 0) meaning.unit = said(0);
  if (unit[2] > 0 && unit[2] != meaning.unit.value) meaning.unit_z = said(2);
  if (unit[2] == 0 && unit[0] > 0 && unit[0] != 1)
    meaning.unit.sentence += "; so do heights, whose heading " + quoted(2) + " names no unit";
}

std::vector<std::string> legal_names(const std::vector<std::string>& names, const std::vector<std::string>& taken) {
  const auto key = [](const std::string& name) {
    const std::string lower = lower_case(name);
    return lower.rfind("scalar_", 0) == 0 ? lower.substr(7) : lower;
  };
  std::vector<std::string> legal;
  std::set<std::string> used;
  for (const std::string& name : taken) used.insert(key(name));
  for (std::string name : names) {
    if (!is_legal_name(name)) {
      name = lower_case(name.substr(0, 64));
      for (char& c : name)
        if (!is_legal_name(std::string("a") + c)) c = '_';
      if (name.find_first_not_of('_') == name.npos) name = "column";
      if (!is_legal_name(name)) name = "c_" + name.substr(0, 62);
    }
    if (used.contains(key(name))) name += "_in_file";
    std::string numbered = name;
    for (int k = 2; used.contains(key(numbered)); ++k) numbered = name + "_" + std::to_string(k);
    used.insert(key(numbered));
    legal.push_back(std::move(numbered));
  }
  return legal;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "store/scene_file_keys_internal.hpp"

namespace insonify {
namespace {

constexpr Named<PartRest> rest_words[] = {
    {"ground", PartRest::ground}, {"bed", PartRest::bed}, {"none", PartRest::none}};

/// From `least` to `most` numbers in a list; one number may stand by itself.
KeyValue few(std::vector<double>& numbers, std::size_t least, std::size_t most, const char* rule,
             const NumberRule& each = {}, const Scale& scale = as_it_is) {
  KeyValue value = list(numbers, each, scale);
  value.rule = rule;
  value.set = [set = value.set, least, most](const TomlValue& from, const std::string& path) {
    TomlValue as_list = from;
    if (from.is_number() && least == 1) as_list = {.kind = TomlValue::Kind::array, .line = from.line, .items = {from}};
    return as_list.items.size() >= least && as_list.items.size() <= most && set(as_list, path);
  };
  return value;
}

/// Two numbers that ascend, or one.
KeyValue interval(std::vector<double>& numbers, const char* rule, const NumberRule& each) {
  KeyValue value = few(numbers, 1, 2, rule, each);
  value.set = [set = value.set, &numbers](const TomlValue& from, const std::string& path) {
    return set(from, path) && numbers.front() <= numbers.back();
  };
  return value;
}

/// The corners of a polygon, each two numbers.
KeyValue polygon(std::vector<Eigen::Vector2d>& corners) {
  const auto is_corner = [](const TomlValue& item) {
    return item.kind == TomlValue::Kind::array && item.items.size() == 2 &&
           std::ranges::all_of(item.items, [](const TomlValue& x) { return x.is_number() && std::isfinite(x.number); });
  };
  const auto set = [&corners, is_corner](const TomlValue& value, const std::string&) {
    if (value.kind != TomlValue::Kind::array || value.items.size() < 3 || !std::ranges::all_of(value.items, is_corner))
      return false;
    corners.clear();
    for (const TomlValue& item : value.items) corners.emplace_back(item.items[0].number, item.items[1].number);
    return true;
  };
  return {"a list of three or more corners [x, y]", set, [] { return std::optional<std::string>(); }};
}

KeyValue place(std::optional<Eigen::Vector3d>& vector) {
  const auto set = [&vector](const TomlValue& value, const std::string& path) {
    Eigen::Vector3d given;
    const bool good = insonify::vector(given, "").set(value, path);
    if (good) vector = given;
    return good;
  };
  return {"three numbers: x, y, z", set, [] { return std::optional<std::string>(); }};
}

KeyValue optional_text(std::string& string) {
  return omitted_if(text(string), [&string] { return string.empty(); });
}

KeyValue unless_zero(double& x) {
  return omitted_if(number(at(x), positive), [&x] { return x == 0; });
}

/// Rows of how a file is read.
std::vector<Key> reading_keys(const char* section, PartFile& file) {
  return {
      {section, "unit", "", text(file.unit), "of its coordinates: m, mm, cm, km, ft, or metres per unit in quotes"},
      {section, "material", "", optional_text(file.material), "of every surfel, by name; default: those of the file"},
      {section, "materials", "", optional_text(file.materials), "table of materials by label, a file"},
      {section, "material_field", "", optional_text(file.material_field),
       "field of the file that holds materials; default: found by name"},
      {section, "spacing_m", "m", unless_zero(file.spacing),
       "between surfels of a mesh; default: a fiftieth of the diagonal of its box, from 2 mm to 5 cm; of a captured "
       "mesh "
       "that of its overview"},
  };
}

}  // namespace

std::vector<Key> scene_part_keys(SceneTables& t) {
  PartFile& file = t.part.file;
  PartPlacement& p = t.part.placement;
  std::vector<Key> keys = {
      {"part", "file", "", optional_text(file.path),
       "cloud, mesh, `.tiles`, or another scene of parts, which is one rigid part as it is at time 0", true},
      {"part", "name", "", optional_text(t.part.name), "default: the file's, without its extension; one part has it"},
      {"part", "label", "", optional_text(t.part.label),
       "class of its pixels in data sets; default: the name of a part that is placed, the materials of a captured one"},
  };
  for (Key& key : reading_keys("part", file)) keys.push_back(std::move(key));
  const std::vector<Key> others = {
      {"part", "viewpoint_m", "m", place(file.viewpoint), "where the capture stood, which orients normals"},
      {"part", "thin_m", "m", unless_zero(file.thin), "between surfels: denser ones are thinned, as by `prepare`"},
      {"part", "position_m", "m", few(t.position, 2, 3, "two or three numbers: x, y, and z unless it rests"),
       "of the origin of the file's axes at time 0; default, if another of the keys below is given: 0, 0, 0. A part "
       "without any of them is *captured*: it lies where its file has it, and all else rests on it"},
      {"part", "rest", "", omitted_if(word(t.rest, {"ground", "bed", "none"}), [&t] { return t.rest.empty(); }),
       "ground: lowered until the first of its surfels touches; bed: first tilted with the bed under its footprint; "
       "none: z is as given; default: ground for a position of two numbers, none for three"},
      {"part", "bury_m", "m", number(at(p.bury)), "so much lower than it rests; what is below the ground is not there"},
      {"part", "yaw_deg", "deg", number(at(p.yaw), {}, in_degrees), "about z, counter-clockwise from above"},
      {"part", "pitch_deg", "deg", number(at(p.pitch), {}, in_degrees), "about y, positive nose down"},
      {"part", "roll_deg", "deg", number(at(p.roll), {}, in_degrees), "about x"},
      {"part", "scale", "", number(at(p.scale), positive), "of its lengths"},
      {"part", "trajectory", "", optional_text(t.trajectory),
       "CSV of times and poses as of missions, in place of position, rest, velocity and turn"},
      {"part", "velocity_mps", "m/s", vector(p.velocity, "x, y, z"), "of the origin of its axes"},
      {"part", "turn_deg_per_s", "deg/s",
       omitted_if(few(t.turn, 1, 3, "a number, of turning about z, or three: a rotation vector", {}, in_degrees),
                  [&t] { return t.turn.empty(); }),
       "in world axes, about the origin of its axes; default: 0"},
  };
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

std::vector<Key> scene_scatter_keys(SceneTables& t) {
  SceneScatterEntry& s = t.scatter;
  std::vector<Key> keys = {
      {"scatter", "files", "", texts(t.files), "of the bodies, each as likely as the others", true},
      {"scatter", "names", "", texts(s.names), "of the bodies: `NAME-1`, `NAME-2`; default: the files'"},
      {"scatter", "labels", "", texts(s.labels), "classes of their pixels in data sets; default: the names"},
      {"scatter", "count", "",
       interval(t.count, "a whole number from 0, or two: least and most", {.least = 0, .most = 65000, .whole = true}),
       "how many bodies", true},
      {"scatter", "area_m", "m", polygon(s.rule.area), "over which their centres are strewn", true},
      {"scatter", "min_distance_m", "m", unless_zero(t.min_distance),
       "between their centres, and to those of placed parts; default: footprints do not overlap"},
      {"scatter", "yaw_deg", "deg", number(at(s.rule.yaw), not_negative, in_degrees),
       "half width of the uniform draw of their yaw; 180: any"},
      {"scatter", "tilt_deg", "deg", number(at(s.rule.tilt), not_negative, in_degrees),
       "the same of pitch and of roll"},
      {"scatter", "bury", "", interval(t.bury, "a number from 0 to 1, or two: least and most", {.least = 0, .most = 1}),
       "how deep they lie in the ground, in parts of their height; default: 0"},
      {"scatter", "scale", "", interval(t.scale, "a number > 0, or two: least and most", positive),
       "of their lengths; default: 1"},
      {"scatter", "empty_share", "", number(at(s.rule.empty_share), {.least = 0, .most = 1}),
       "of the draws, which have no body at all"},
      {"scatter", "rest", "", word(s.rule.rest, std::span(rest_words).first(2)), "as of a part: ground or bed"},
  };
  for (Key& key : reading_keys("scatter", t.scatter_file)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace insonify

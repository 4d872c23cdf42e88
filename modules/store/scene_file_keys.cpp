// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "store/scene_file_keys_internal.hpp"

namespace insonify {
namespace {

constexpr Named<PartRest> rest_words[] = {
    {"ground", PartRest::ground}, {"bed", PartRest::bed}, {"none", PartRest::none}};

/// One value or two that ascend.
KeyValue interval(std::vector<double>& numbers, const char* rule, const NumberRule& each) {
  return list(given(numbers), each, as_it_is, {.most = 2, .bare = true, .ascending = true, .text = rule});
}

/// Rows of how a file is read.
std::vector<Key> reading_keys(const char* section, PartFile& file) {
  return {
      {section, "unit", "", text(file.unit), "of its coordinates: m, mm, cm, km, ft, or metres per unit in quotes"},
      {section, "material", "", text(given(file.material)), "of every surfel, by name; default: those of the file"},
      {section, "materials", "", text(given(file.materials)), "table of materials by label, a file"},
      {section, "material_field", "", text(given(file.material_field)),
       "field of the file that holds materials; default: found by name"},
      {section, "spacing_m", "m", number(given(file.spacing), positive),
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
      {"part", "file", "", text(given(file.path)),
       "cloud, mesh, `.tiles`, or another scene of parts, which is one rigid part as it is at time 0", true},
      {"part", "name", "", text(given(t.part.name)), "default: the file's, without its extension; one part has it"},
      {"part", "label", "", text(given(t.part.label)),
       "class of its pixels in data sets; default: the name of a part that is placed, the materials of a captured one"},
  };
  for (Key& key : reading_keys("part", file)) keys.push_back(std::move(key));
  const std::vector<Key> others = {
      {"part", "viewpoint_m", "m", vector(file.viewpoint, "x, y, z"), "where the capture stood, which orients normals"},
      {"part", "thin_m", "m", number(given(file.thin), positive),
       "between surfels: denser ones are thinned, as by `prepare`"},
      {"part", "position_m", "m",
       list(given(t.position), {}, as_it_is,
            {.least = 2, .most = 3, .text = "two or three numbers: x, y, and z unless it rests"}),
       "of the origin of the file's axes at time 0; default, if another of the keys below is given: 0, 0, 0. A part "
       "without any of them is *captured*: it lies where its file has it, and all else rests on it"},
      {"part", "rest", "", word(given(t.rest), {"ground", "bed", "none"}),
       "ground: lowered until the first of its surfels touches; bed: first tilted with the bed under its footprint; "
       "none: z is as given; default: ground for a position of two numbers, none for three"},
      {"part", "bury_m", "m", number(p.bury), "so much lower than it rests; what is below the ground is not there"},
      {"part", "yaw_deg", "deg", angle(p.yaw), "about z, counter-clockwise from above"},
      {"part", "pitch_deg", "deg", angle(p.pitch), "about y, positive nose down"},
      {"part", "roll_deg", "deg", angle(p.roll), "about x"},
      {"part", "scale", "", number(p.scale, positive), "of its lengths"},
      {"part", "trajectory", "", text(given(t.trajectory)),
       "CSV of times and poses as of missions, in place of position, rest, velocity and turn"},
      {"part", "velocity_mps", "m/s", vector(p.velocity, "x, y, z"), "of the origin of its axes"},
      {"part", "turn_deg_per_s", "deg/s",
       list(given(t.turn), {}, in_degrees,
            {.most = 3, .bare = true, .text = "a number, of turning about z, or three: a rotation vector"}),
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
      {"scatter", "area_m", "m", polygon(given(s.rule.area)), "over which their centres are strewn", true},
      {"scatter", "min_distance_m", "m", number(given(t.min_distance), positive),
       "between their centres, and to those of placed parts; default: footprints do not overlap"},
      {"scatter", "yaw_deg", "deg", angle(s.rule.yaw, not_negative),
       "half width of the uniform draw of their yaw; 180: any"},
      {"scatter", "tilt_deg", "deg", angle(s.rule.tilt, not_negative), "the same of pitch and of roll"},
      {"scatter", "bury", "", interval(t.bury, "a number from 0 to 1, or two: least and most", {.least = 0, .most = 1}),
       "how deep they lie in the ground, in parts of their height; default: 0"},
      {"scatter", "scale", "", interval(t.scale, "a number > 0, or two: least and most", positive),
       "of their lengths; default: 1"},
      {"scatter", "empty_share", "", number(s.rule.empty_share, {.least = 0, .most = 1}),
       "of the draws, which have no body at all"},
      {"scatter", "rest", "", word(s.rule.rest, std::span(rest_words).first(2)), "as of a part: ground or bed"},
  };
  for (Key& key : reading_keys("scatter", t.scatter_file)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace insonify

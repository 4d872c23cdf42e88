// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "store/scene_file_keys_internal.hpp"

namespace insonify {
namespace {

constexpr Named<PartRest> rest_words[] = {
    {"ground", PartRest::ground}, {"bed", PartRest::bed}, {"none", PartRest::none}};

KeyValue interval(std::vector<double>& numbers, const char* rule, const NumberRule& each) {
  return list(given(numbers), each, as_it_is, {.most = 2, .bare = true, .ascending = true, .text = rule});
}

/// Returns the keys that say how a file is read.
std::vector<Key> reading_keys(const char* section, PartFile& file) {
  std::vector<Key> keys;
  for (const MeaningOption& row : meaning_options())
    keys.push_back({section, row.key, "", meaning(file.meaning, row), row.help});
  const std::vector<Key> others = {
      {section, "material", "", text(given(file.material)),
       "name of one material for every surfel; default: the materials of the file"},
      {section, "materials", "", text(given(file.materials)), "file with a table of materials by label"},
      {section, "material_field", "", text(given(file.material_field)),
       "field of the file that holds materials; default: found by its name"},
      {section, "spacing_m", "m", number(given(file.spacing), positive),
       "distance between surfels of a mesh; default: a fiftieth of the diagonal of its box, from 2 mm to 5 cm; of a "
       "captured mesh: the spacing of its overview"},
  };
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

}  // namespace

std::vector<Key> scene_part_keys(SceneTables& t) {
  PartFile& file = t.part.file;
  PartPlacement& p = t.part.placement;
  std::vector<Key> keys = {
      {"part", "file", "", text(given(file.path)),
       "cloud, mesh, `.tiles`, or another scene of parts, which becomes one rigid part as it is at time 0", true},
      {"part", "name", "", text(given(t.part.name)),
       "name of the part, unique in the file; default: the file's name without its extension"},
      {"part", "label", "", text(given(t.part.label)),
       "class of the part's pixels in data sets; default: the name of a placed part, the materials of a captured part"},
  };
  for (Key& key : reading_keys("part", file)) keys.push_back(std::move(key));
  const std::vector<Key> others = {
      {"part", "viewpoint_m", "m", vector(file.viewpoint, "x, y, z"),
       "position of the scanner, which orients the normals"},
      {"part", "thin_m", "m", number(given(file.thin), positive),
       "least distance between surfels; denser surfels are thinned, as by `prepare`"},
      {"part", "position_m", "m",
       list(given(t.position), {}, as_it_is,
            {.least = 2, .most = 3, .text = "two or three numbers: x, y, and z unless it rests"}),
       "position of the origin of the file's axes at time 0; default, if another of the keys below is given: 0, 0, 0. "
       "A part without any of these keys is *captured*: it lies where its file has it, and all placed parts rest on "
       "it"},
      {"part", "rest", "", word(given(t.rest), {"ground", "bed", "none"}),
       "ground: the part is lowered until the first of its surfels touches; bed: the part is first tilted with the bed "
       "under its footprint; none: z is as given; default: ground for a position of two numbers, none for three"},
      {"part", "bury_m", "m", number(p.bury),
       "depth of the part below its rest; surfels below the ground are left out"},
      {"part", "yaw_deg", "deg", angle(p.yaw), "yaw about z, counter-clockwise from above"},
      {"part", "pitch_deg", "deg", angle(p.pitch), "pitch about y, positive nose down"},
      {"part", "roll_deg", "deg", angle(p.roll), "roll about x"},
      {"part", "scale", "", number(p.scale, positive), "factor of the part's lengths"},
      {"part", "trajectory", "", text(given(t.trajectory)),
       "CSV file of times and poses, as of missions; replaces position, rest, velocity and turn"},
      {"part", "velocity_mps", "m/s", vector(p.velocity, "x, y, z"), "velocity of the origin of the part's axes"},
      {"part", "turn_deg_per_s", "deg/s",
       list(given(t.turn), {}, in_degrees,
            {.most = 3, .bare = true, .text = "a number, of turning about z, or three: a rotation vector"}),
       "rotation in world axes, about the origin of the part's axes; default: 0"},
  };
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

std::vector<Key> scene_scatter_keys(SceneTables& t) {
  SceneScatterEntry& s = t.scatter;
  std::vector<Key> keys = {
      {"scatter", "files", "", texts(t.files), "files of the bodies; each file is equally likely", true},
      {"scatter", "names", "", texts(s.names),
       "names of the bodies: `NAME-1`, `NAME-2`; default: the names of the files"},
      {"scatter", "labels", "", texts(s.labels), "classes of the bodies' pixels in data sets; default: the names"},
      {"scatter", "count", "",
       interval(t.count, "a whole number from 0, or two: least and most", {.least = 0, .most = 65000, .whole = true}),
       "number of bodies", true},
      {"scatter", "area_m", "m", polygon(given(s.rule.area)),
       "polygon over which the centres of the bodies are scattered", true},
      {"scatter", "min_distance_m", "m", number(given(t.min_distance), positive),
       "least distance between centres, and to the centres of placed parts; default: footprints do not overlap"},
      {"scatter", "yaw_deg", "deg", angle(s.rule.yaw, not_negative),
       "half width of the uniform draw of the yaw; 180: any yaw"},
      {"scatter", "tilt_deg", "deg", angle(s.rule.tilt, not_negative),
       "half width of the uniform draws of pitch and roll"},
      {"scatter", "bury", "", interval(t.bury, "a number from 0 to 1, or two: least and most", {.least = 0, .most = 1}),
       "depth of the bodies in the ground, as a fraction of their height; default: 0"},
      {"scatter", "scale", "", interval(t.scale, "a number > 0, or two: least and most", positive),
       "factor of the bodies' lengths; default: 1"},
      {"scatter", "empty_share", "", number(s.rule.empty_share, {.least = 0, .most = 1}),
       "fraction of draws without any body"},
      {"scatter", "rest", "", word(s.rule.rest, std::span(rest_words).first(2)),
       "rest of the bodies, as of a part: ground or bed"},
  };
  for (Key& key : reading_keys("scatter", t.scatter_file)) keys.push_back(std::move(key));
  return keys;
}

}  // namespace insonify

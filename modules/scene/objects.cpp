// SPDX-License-Identifier: BSD-3-Clause
#include "scene/objects.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/text.hpp"
#include "scene/object_shapes_internal.hpp"

namespace insonify {
namespace {

constexpr double smallest = 0.001, largest = 100;  ///< limits of a size [m]

constexpr ObjectOption size(const char* key, double standard, const char* help) {
  return {key, "m", standard, smallest, largest, help};
}
/// Returns the row of a size that may be 0.
constexpr ObjectOption size_or_none(const char* key, double standard, const char* help) {
  return {key, "m", standard, 0, largest, help};
}
constexpr ObjectOption upright(const char* help) { return {"upright", "", 0, 0, 1, help, true}; }

constexpr ObjectOption common_options[] = {
    {"tolerance_mm", "mm", 1, 0.01, 100, "largest distance of the triangles from a curved surface"}};

constexpr ObjectOption cylinder_mine[] = {
    size("length_m", 2.0, "length from end to end"), size("diameter_m", 0.533, "diameter of the cylinder"),
    size_or_none("nose_m", 0, "length of a rounded front end, half an ellipsoid; 0: flat"),
    upright("1: it stands on its flat end")};
constexpr ObjectOption cone_mine[] = {size("base_m", 0.98, "diameter of the base"),
                                      size_or_none("top_m", 0.5, "diameter of the top; 0: a whole cone"),
                                      size("height_m", 0.44, "height of the truncated cone")};
constexpr ObjectOption wedge_mine[] = {
    size("length_m", 1.015, "length of the base"), size("width_m", 0.8, "width of the base"),
    size("height_m", 0.385, "height of the body"), size("top_length_m", 0.6, "length of the upper side"),
    size("top_width_m", 0.45, "width of the upper side")};
constexpr ObjectOption tyre[] = {
    size("diameter_m", 0.632, "diameter of the tread"),
    size("rim_m", 0.406, "diameter of the opening"),
    size("width_m", 0.205, "width from side to side"),
    size_or_none("tread_m", 0.16, "width of the flat tread, and of the gap inside"),
    size_or_none("wall_m", 0.012, "thickness of the sides; 0: a solid ring, with tread_m = 0 a torus"),
    upright("1: it stands on its tread and rolls along x")};
constexpr ObjectOption drum[] = {size("length_m", 0.88, "length from rim to rim"),
                                 size("diameter_m", 0.585, "diameter of the hoops"),
                                 size("hoop_m", 0.006, "height of the two hoops above the drum"),
                                 size("hoop_width_m", 0.04, "width of a hoop, along the drum"),
                                 size("rim_m", 0.012, "thickness of the rims of both ends"),
                                 size_or_none("recess_m", 0.018, "depth of the ends below their rims"),
                                 upright("1: it stands on an end")};
constexpr ObjectOption pipe[] = {
    size("length_m", 3, "length of the pipe"), size("diameter_m", 0.3239, "outer diameter"),
    size("wall_m", 0.0095, "thickness of the wall; the pipe is open at both ends"), upright("1: it stands on an end")};
constexpr ObjectOption crab_pot[] = {
    size("diameter_m", 1.0, "outer diameter"),
    size("height_m", 0.33, "outer height"),
    size("bar_m", 0.016, "thickness of the bars of the frame"),
    {"bars", "", 6, 3, 60, "number of uprights of the frame", true},
    {"mesh_m", "m", 0.08, 0, largest, "distance between the wires of the net; 0: no net"},
    size("wire_m", 0.0025, "thickness of the wires of the net")};
constexpr ObjectOption anchor[] = {size("length_m", 1.2, "length of the shank"),
                                   size("arms_m", 0.84, "distance between the tips of the arms"),
                                   size("stock_m", 1.2, "length of the stock"),
                                   size("bar_m", 0.06, "thickness of the shank and the arms where they meet")};
constexpr ObjectOption cinder_block[] = {size("length_m", 0.397, "length along x"),
                                         size("width_m", 0.194, "width across x"),
                                         size("height_m", 0.194, "height along the cores, which are open"),
                                         size("shell_m", 0.032, "thickness of the long sides"),
                                         size("web_m", 0.025, "thickness of the three webs between them")};
constexpr ObjectOption ladder[] = {
    size("length_m", 3, "length of the rails"),  size("width_m", 0.42, "outer width"),
    size("rail_m", 0.025, "width of a rail"),    size("rail_depth_m", 0.06, "depth of a rail"),
    size("rung_m", 0.03, "thickness of a rung"), {"pitch_m", "m", 0.28, 0.02, largest, "distance from rung to rung"}};
constexpr ObjectOption sphere[] = {size("diameter_m", 0.5, "diameter of the sphere")};
constexpr ObjectOption diver[] = {size("stature_m", 1.8, "height of the diver, without fins"),
                                  size("bottle_m", 0.184, "diameter of the bottle"),
                                  size("bottle_length_m", 0.66, "length of the bottle")};

constexpr const char* of_steel[] = {"steel"};
constexpr const char* of_fibreglass[] = {"fibreglass"};
constexpr const char* of_rubber[] = {"rubber"};
constexpr const char* of_concrete[] = {"concrete"};
constexpr const char* of_aluminium[] = {"aluminium"};
constexpr const char* of_diver[] = {"wet-suit", "rubber", "aluminium"};

constexpr ObjectKind kinds[] = {
    {"cylinder-mine", "cylindrical bottom mine", "533 mm is the torpedo tube that such mines fit, 2 m a typical length",
     true, cylinder_mine, of_steel, build_cylinder_mine},
    {"cone-mine", "bottom mine in the shape of a truncated cone, like the Manta",
     "published diameter and height of the Manta; the top is estimated from pictures", true, cone_mine, of_fibreglass,
     build_cone_mine},
    {"wedge-mine", "low bottom mine with sloping sides, like the Rockan",
     "published length, width and height of the Rockan; its slopes are estimated", true, wedge_mine, of_fibreglass,
     build_wedge_mine},
    {"tyre", "tyre of a car, without its rim", "size 205/55 R16: width, height of its sides and opening follow from it",
     true, tyre, of_rubber, build_tyre},
    {"drum", "closed steel drum with two hoops", "the common drum of 208 to 217 litres, 585 mm over its hoops: typical",
     true, drum, of_steel, build_drum},
    {"pipe", "piece of a steel pipe, open at both ends", "DN 300 of EN 10220: 323.9 mm; a typical wall", true, pipe,
     of_steel, build_pipe},
    {"crab-pot", "round crab pot: frame of bars with a net of wire",
     "pots for Dungeness crab are 0.9 to 1.1 m wide and 0.3 to 0.36 m high: typical", false, crab_pot, of_steel,
     build_crab_pot},
    {"anchor", "anchor with a stock (Admiralty pattern), lying on stock and one arm", "typical proportions", false,
     anchor, of_steel, build_anchor},
    {"cinder-block", "concrete block with two cores", "8 x 8 x 16 inch block of ASTM C90, less the joints of 3/8 inch",
     true, cinder_block, of_concrete, build_cinder_block},
    {"ladder", "straight aluminium ladder, lying", "rungs 0.25 to 0.3 m apart as in EN 131; the rest is typical", false,
     ladder, of_aluminium, build_ladder},
    {"sphere", "sphere", "closed form", true, sphere, of_steel, build_sphere},
    {"diver", "diver who swims along x, with bottle and fins, of ellipsoids",
     "lengths of limbs from Drillis and Contini 1966; widths, fins and the bottle of 11 litres are typical", false,
     diver, of_diver, build_diver}};

}  // namespace

std::span<const ObjectKind> object_kinds() { return kinds; }

const ObjectKind* find_object(const std::string& name) {
  const auto* found =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const ObjectKind& k) { return k.name == name; });
  return found == std::end(kinds) ? nullptr : found;
}

std::vector<ObjectOption> options_of(const ObjectKind& kind) {
  std::vector<ObjectOption> all(kind.options.begin(), kind.options.end());
  all.insert(all.end(), std::begin(common_options), std::end(common_options));
  return all;
}

std::string rule_of(const ObjectOption& option) {
  return printed(option.whole ? "a whole number from %g to %g" : "a number from %g to %g", option.least, option.most);
}

SceneMesh make_object(const std::string& name, const ObjectSettings& settings) {
  const ObjectKind* kind = find_object(name);
  if (!kind)
    fail(ErrorKind::argument, "make_object: no object '", name,
         "', must be one of: ", joined(object_kinds(), ", ", [](const ObjectKind& k) { return std::string(k.name); }));
  const ObjectSizes sizes(*kind, settings);
  ObjectMesh mesh(sizes.tolerance());
  kind->build(sizes, mesh);
  return mesh.finish();
}

}  // namespace insonify

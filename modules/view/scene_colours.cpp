// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "view/scene_colours_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t colours_at_once = 1 << 16;

constexpr std::size_t most_entries = 10;  // largest number in a legend

struct VisibilityColour {
  Visibility visibility;
  const char* text;
  Rgb colour;
};
constexpr VisibilityColour visibility_colours[] = {{Visibility::seen, "seen", {255, 200, 70}},
                                                   {Visibility::hidden, "hidden: in shadow", {42, 66, 138}},
                                                   {Visibility::turned_away, "turned away", {140, 92, 58}},
                                                   {Visibility::outside, "outside the fan or gate", {172, 174, 178}},
                                                   {Visibility::not_queried, "not evaluated", {205, 207, 210}}};

// Light from behind, starboard and above for a head along x, so that faces differ in brightness and ripples show.
const Eigen::Vector3f to_light = Eigen::Vector3f(-0.45F, -0.42F, 0.79F).normalized();

// Returns the brightness of a surface, from 0.4 at grazing light to 1.1 at full light. Back faces are darker, but a
// room seen from outside is not black.
float light_on(const SceneCloud& scene, std::size_t i) {
  const float cosine = scene.normal[i].dot(to_light);
  if (!scene.normals_oriented) return 0.4F + 0.7F * std::abs(cosine);
  return cosine > 0 ? 0.4F + 0.7F * cosine : 0.4F - 0.4F * cosine;
}

Rgb shaded(const Rgb& colour, float light) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(std::min(255.0F, std::round(light * static_cast<float>(colour[c]))));
  return result;
}

template <typename ColourOf>
std::vector<Rgb> per_surfel(const SceneCloud& scene, ColourOf&& colour_of) {
  std::vector<Rgb> colour(scene.size());
  parallel_blocks(scene.size(), colours_at_once, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) colour[i] = colour_of(i);
  });
  return colour;
}

// Returns a scale of heights from low to high without a thousandth at either end, which may be stray points.
ColourScale height_scale(const SceneCloud& scene) {
  const std::size_t step = 1 + scene.size() / 200000;
  std::vector<float> z;
  for (std::size_t i = 0; i < scene.size(); i += step) z.push_back(scene.point[i].z());
  std::sort(z.begin(), z.end());
  const std::size_t stray = z.size() / 1000;
  double low = scene.origin.z() + z[stray], high = scene.origin.z() + z[z.size() - 1 - stray];
  const double least = std::max(1e-3, 1e-9 * std::abs(high));
  if (high - low < least) low -= least / 2, high = low + least;
  return {colour_table("viridis", "show_scene"), low, high};
}

SceneColours by_height(const SceneCloud& scene) {
  const ColourScale scale = height_scale(scene);
  return {per_surfel(scene,
                     [&](std::size_t i) {
                       const double z = scene.origin.z() + static_cast<double>(scene.point[i].z());
                       return shaded(scale.colour(z), light_on(scene, i));
                     }),
          {scale, "Height z [m]", {}}};
}

/// Returns one colour for each name of surfels; number_of(i) is the number of surfel i's name.
template <typename Number>
SceneColours by_name(const SceneCloud& scene, const std::vector<std::string>& names, const Number& number_of) {
  std::vector<std::uint8_t> used(names.size());
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (number_of(i) < used.size()) used[number_of(i)] = 1;
  SceneColours result;
  std::size_t more = 0;
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (!used[m]) continue;
    if (result.key.legend.size() < most_entries)
      result.key.legend.push_back({names[m], material_colours[m % std::size(material_colours)]});
    else
      ++more;
  }
  if (more > 0) result.key.legend.push_back({"and " + std::to_string(more) + " more", unknown_grey});
  result.colour = per_surfel(scene, [&](std::size_t i) {
    return shaded(material_colours[number_of(i) % std::size(material_colours)], light_on(scene, i));
  });
  return result;
}

SceneColours by_material(const SceneCloud& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  return by_name(scene, names, [&](std::size_t i) -> std::size_t { return scene.material[i]; });
}

SceneColours by_part(const SceneCloud& scene) {
  if (scene.part.empty()) return by_material(scene);
  std::vector<std::string> names;
  for (const ScenePart& part : scene.parts) names.push_back(part.name);
  return by_name(scene, names, [&](std::size_t i) -> std::size_t { return scene.part[i]; });
}

// Returns colours by visibility. Shading is reduced, since the colours of shadows are dark already.
SceneColours by_visibility(const SceneCloud& scene, const SceneLook& look, const char* who) {
  if (look.visibility.empty())
    fail(ErrorKind::argument, who, ": look.visibility is empty, but colour is visibility; fill it by find_visibility");
  SceneColours result;
  std::array<std::size_t, std::size(visibility_colours)> count{};
  for (const Visibility visibility : look.visibility)
    ++count[std::min<std::size_t>(static_cast<std::size_t>(visibility), 4)];
  std::array<Rgb, std::size(visibility_colours)> table{};
  for (const VisibilityColour& entry : visibility_colours) {
    table[static_cast<std::size_t>(entry.visibility)] = entry.colour;
    if (count[static_cast<std::size_t>(entry.visibility)] > 0) result.key.legend.push_back({entry.text, entry.colour});
  }
  result.colour = per_surfel(scene, [&](std::size_t i) {
    const auto visibility = std::min<std::size_t>(static_cast<std::size_t>(look.visibility[i]), 4);
    return shaded(table[visibility], 0.4F + 0.6F * light_on(scene, i));
  });
  return result;
}

SceneColours by_level(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options, const char* who) {
  const auto grey = [&](std::size_t i) { return shaded(unknown_grey, light_on(scene, i)); };
  if (look.level_db.empty()) return {per_surfel(scene, grey), {}};
  const ColourScale scale = level_scale(look, options, who);
  return {per_surfel(
              scene,
              [&](std::size_t i) { return std::isnan(look.level_db[i]) ? grey(i) : scale.colour(look.level_db[i]); }),
          {scale, look.level_unit, {}}};
}

// Returns colours by the angle between ray and normal, or its complement. Back-facing surfels are grey.
SceneColours by_angle(const SceneCloud& scene, const SceneLook& look, bool grazing, const char* who) {
  if (!look.head)
    fail(ErrorKind::argument, who, ": look.head is absent, but colour is ", grazing ? "grazing" : "incidence",
         "; the angle is that to the head");
  const ColourScale scale{colour_table("viridis", who), 0, 90};
  const Eigen::Vector3f head = (look.head->world_from_head.translation() - scene.origin).cast<float>();
  return {per_surfel(scene,
                     [&](std::size_t i) {
                       float cosine = (head - scene.point[i]).normalized().dot(scene.normal[i]);
                       if (!scene.normals_oriented) cosine = std::abs(cosine);
                       if (!(cosine > 0)) return shaded(unknown_grey, light_on(scene, i));
                       const double incidence = degrees(std::acos(std::min(1.0F, cosine)));
                       return scale.colour(grazing ? 90 - incidence : incidence);
                     }),
          {scale, grazing ? "Grazing angle [°]" : "Angle of incidence [°]", {}}};
}

}  // namespace

ColourScale level_scale(const SceneLook& look, const PictureOptions& options, const char* who) {
  Grid<float> levels(1, static_cast<Eigen::Index>(look.level_db.size() + look.soundings.level_db.size()));
  auto* const end = std::copy(look.level_db.begin(), look.level_db.end(), levels.data());
  std::copy(look.soundings.level_db.begin(), look.soundings.level_db.end(), end);
  return colour_scale(levels, options, who);
}

SceneColours colour_surfels(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                            const char* who) {
  if (look.colour == SceneColour::height) return by_height(scene);
  if (look.colour == SceneColour::material) return by_material(scene);
  if (look.colour == SceneColour::part) return by_part(scene);
  if (look.colour == SceneColour::visibility) return by_visibility(scene, look, who);
  if (look.colour == SceneColour::level) return by_level(scene, look, options, who);
  return by_angle(scene, look, look.colour == SceneColour::grazing, who);
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_cloud.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// Ten colours distinguishable with most colour-vision deficiencies, the first for the commonest material.
inline constexpr Rgb material_colours[] = {{203, 180, 135}, {86, 140, 185}, {214, 104, 74}, {104, 160, 92},
                                           {150, 116, 176}, {222, 170, 50}, {60, 165, 160}, {206, 122, 160},
                                           {128, 128, 128}, {140, 96, 66}};

/// A colour and its meaning.
struct LegendEntry {
  std::string text;
  Rgb colour{};
};

/// Key to the colours of a scene: a scale with its unit, or a legend, or neither.
struct SceneKey {
  std::optional<ColourScale> scale;  ///< in units of `unit`, although its fields end in _db
  std::string unit;
  std::vector<LegendEntry> legend;
};

/// One colour per surfel, and the key.
struct SceneColours {
  std::vector<Rgb> colour;
  SceneKey key;
};

/// Returns the colours of the surfels by look.colour. Throws Error(argument) as show_scene.
SceneColours colour_surfels(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                            const char* who);

/// Returns the common level scale of the surfels and soundings of `look`.
ColourScale level_scale(const SceneLook& look, const PictureOptions& options, const char* who);

/// Colour of surfels without data.
constexpr Rgb unknown_grey = {150, 152, 156};

}  // namespace insonify

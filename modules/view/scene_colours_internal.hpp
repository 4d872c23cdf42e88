#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_cloud.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// A colour and what it stands for.
struct LegendEntry {
  std::string text;
  Rgb colour{};
};

/// What the colours of a scene mean: a scale with its unit, or a legend. Both absent: nothing to explain.
struct SceneKey {
  std::optional<ColourScale> scale;  ///< in the unit of `unit`, whatever its fields are called
  std::string unit;
  std::vector<LegendEntry> legend;
};

/// One colour per surfel and what it means.
struct SceneColours {
  std::vector<Rgb> colour;
  SceneKey key;
};

/// Colours of the surfels by look.colour. Throws Error(argument) as show_scene.
SceneColours colour_surfels(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                            const char* who);

/// Scale of levels: that of the surfels and soundings of `look` together.
ColourScale level_scale(const SceneLook& look, const PictureOptions& options, const char* who);

/// Colour of surfels of which nothing is known.
constexpr Rgb unknown_grey = {150, 152, 156};

}  // namespace insonify

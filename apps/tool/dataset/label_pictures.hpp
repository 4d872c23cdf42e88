// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "returns/ping.hpp"

/// Classes of pixels, and their colours in pictures.
namespace insonify::tool {

/// The least share of a pixel's energy that gives its class: the default of data sets, and the share of pictures.
constexpr double least_label_share = 0.5;
/// Values of a class: nothing, shadow, then materials.
constexpr std::uint8_t shadow_class = 1;

/// The names of the classes of labels: nothing, shadow, then the materials.
std::vector<std::string> class_names(const PixelLabels& labels);

/// The class of every sample, beams x bins, numbered as `classes`; nothing where a label has less than `share` (E125).
Grid<std::uint8_t> classes_of(const PixelLabels& labels, double share, const std::vector<std::string>& classes);

/// --min-level: a level [dB], "black" for `black_db`, or nothing of "". Throws Error(argument).
std::optional<double> parse_min_level(const std::string& text, double black_db);
/// The text of --help on --min-level.
inline constexpr const char* min_level_help =
    "[dB] surfaces have no class in pixels below; black: below the darkest grey; default: they have one at any level";

/// The classes with nothing in place of surfaces where the level is below `min_level`, if that is given; shadow stays.
Grid<std::uint8_t> classes_above(const Grid<std::uint8_t>& classes, const Grid<float>& level_db,
                                 std::optional<double> min_level);

/// One row of beams of a ping, from the lowest; all of it if it has one. Layers and other maps than levels and labels
/// are left out.
Ping row_of(const Ping& ping, std::size_t row);
/// How many rows of beams it has.
std::size_t rows_of(const Ping& ping);

/// Value, name and colour of every class, as JSON.
nlohmann::ordered_json palette_json(const std::vector<std::string>& classes);

}  // namespace insonify::tool

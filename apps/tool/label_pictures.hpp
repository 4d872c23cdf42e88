#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "returns/ping.hpp"

/// Classes of pixels, and their colours in pictures.
namespace insonify::tool {

/// Of a pixel's energy, at least, for its class: the default of data sets, and that of pictures.
constexpr double least_label_share = 0.5;
/// Values of a class: nothing, shadow, then materials.
constexpr std::uint8_t shadow_class = 1;

/// The names of the classes of labels: nothing, shadow, then the materials.
std::vector<std::string> class_names(const PixelLabels& labels);

/// The class of every sample, beams x bins, numbered as `classes`; nothing where a label has less than `share` (E125).
Grid<std::uint8_t> classes_of(const PixelLabels& labels, double share, const std::vector<std::string>& classes);

/// One row of beams of a ping, from the lowest; all of it if it has one. Layers and other maps than levels and labels are
/// left out.
Ping row_of(const Ping& ping, std::size_t row);
/// How many rows of beams it has.
std::size_t rows_of(const Ping& ping);

/// Value, name and colour of every class, as JSON.
nlohmann::ordered_json palette_json(const std::vector<std::string>& classes);

}  // namespace insonify::tool

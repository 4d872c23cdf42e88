// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compare_ranges.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/image_comparison.hpp"
#include "compare/range_bands.hpp"
#include "compare/side_scan_statistics.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t bands_of_range = 5;

ordered_json json_of(const RangeBand& band) {
  if (band.mean_level_db == 0 && band.amplitude_contrast == 0) return nullptr;  // too few levels
  return {{"mean_level_db", band.mean_level_db},
          {"amplitude_contrast", band.amplitude_contrast},
          {"deviation_db", band.deviation_db},
          {"width_beams", band.width_beams},
          {"width_bins", band.width_bins}};
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

ordered_json side_json(const ComparedFile& file) {
  const SideScanStatistics s = side_scan_statistics(file.image.level_db, *file.image.gate);
  std::vector<double> first, height, above;
  for (std::size_t p = 0; p < s.first_return.size(); ++p) {
    if (!s.first_return[p]) continue;
    first.push_back(*s.first_return[p]);
    if (p < file.altitude.size() && file.altitude[p] > 0)
      height.push_back(file.altitude[p]), above.push_back(*s.first_return[p] - file.altitude[p]);
  }
  ordered_json json = {{"first_return_m", first.empty() ? ordered_json() : ordered_json(median_of(first))},
                       {"pings_with_a_first_return", first.size()},
                       {"shadow_share", s.shadow_share},
                       {"shadow_depth_db", s.shadow_depth_db},
                       {"longest_shadow_m", s.longest_shadow},
                       {"longest_shadow_from_m", s.longest_from},
                       {"longest_shadow_ping", s.longest_ping}};
  if (!height.empty()) {
    json["altitude_m"] = median_of(height);
    json["first_return_less_altitude_m"] = median_of(above);
  }
  return json;
}

/// To a tenth of a millimetre: a recording begins at a millionth of a bin.
double rounded(double range) { return std::round(1e4 * range) / 1e4; }

std::string cell(const ordered_json& value, const char* key) {
  return value.is_null() || !value.contains(key) || value[key].is_null()
             ? "-"
             : fmt::format("{:.3g}", value[key].get<double>());
}

}  // namespace

ordered_json range_bands_json(const ComparedFile& a, const ComparedFile& b) {
  if (!b.image.gate) return nullptr;
  const auto of_a = range_bands(unclipped_levels(a.image), *b.image.gate, bands_of_range);
  const auto of_b = range_bands(unclipped_levels(b.image), *b.image.gate, bands_of_range);
  ordered_json bands = ordered_json::array();
  for (std::size_t k = 0; k < of_a.size(); ++k)
    bands.push_back({{"from_m", of_a[k].from}, {"to_m", of_a[k].to}, {"a", json_of(of_a[k])}, {"b", json_of(of_b[k])}});
  return bands;
}

ordered_json side_scan_json(const ComparedFile& a, const ComparedFile& b) {
  if (!a.waterfall || !b.waterfall) return nullptr;
  return {{"a", side_json(a)}, {"b", side_json(b)}};
}

std::string ranges_table(const ordered_json& bands, const ordered_json& side_scan) {
  std::string text;
  if (!bands.is_null()) {
    text += fmt::format("{:<20} {:>15} {:>15} {:>15} {:>15}\n", "range [m], A and B", "level [dB]", "contrast",
                        "deviation [dB]", "width [bins]");
    for (const auto& band : bands) {
      text += fmt::format(
          "{:<20}", fmt::format("{:.3g} to {:.3g}", rounded(band["from_m"].get<double>()), band["to_m"].get<double>()));
      for (const char* key : {"mean_level_db", "amplitude_contrast", "deviation_db", "width_bins"})
        text += fmt::format(" {:>7} {:>7}", cell(band["a"], key), cell(band["b"], key));
      text += "\n";
    }
  }
  if (side_scan.is_null()) return text;
  for (const auto& [key, name] : {std::pair("first_return_m", "first return [m]"),
                                  {"altitude_m", "altitude [m]"},
                                  {"first_return_less_altitude_m", "first return - altitude [m]"},
                                  {"shadow_share", "share in shadow"},
                                  {"shadow_depth_db", "bed over shadow [dB]"},
                                  {"longest_shadow_m", "longest shadow [m]"},
                                  {"longest_shadow_from_m", "it begins at [m]"}})
    text += fmt::format("{:<28} {:>10} {:>10}\n", name, cell(side_scan["a"], key), cell(side_scan["b"], key));
  return text;
}

}  // namespace insonify::tool

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "files/utc.hpp"
#include "tool/info/info.hpp"
#include "tool/run/swath_pings.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

constexpr double deviations_of_95 = 1.959963985;

/// Returns the median; null of none.
ordered_json median_or_null(std::vector<double> values) {
  if (values.empty()) return {};
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void add_soundings(const SwathRecord& record, ordered_json& info) {
  FactSpan depth, across, angle, level;
  std::size_t soundings = 0, rejected = 0;
  std::vector<double> vertical, horizontal;
  for (const SwathPing& ping : record.pings)
    for (const SwathSounding& sounding : ping.soundings) {
      ++soundings, rejected += sounding.rejected ? 1 : 0;
      if (sounding.rejected) continue;
      depth.add(sounding.depth), across.add(sounding.across), angle.add(degrees(sounding.angle));
      level.add(sounding.level_db);
      if (std::isfinite(sounding.vertical_deviation)) vertical.push_back(sounding.vertical_deviation);
      if (std::isfinite(sounding.horizontal_deviation)) horizontal.push_back(sounding.horizontal_deviation);
    }
  info["soundings"] = soundings, info["rejected"] = rejected;
  info["depth_m"] = depth.json(), info["across_m"] = across.json(), info["angle_deg"] = angle.json();
  if (!record.unit.empty()) info["levels"] = record.unit, info["level_db"] = level.json();
  if (!vertical.empty()) info["vertical_deviation_m"] = median_or_null(vertical);
  if (!horizontal.empty()) info["horizontal_deviation_m"] = median_or_null(horizontal);
}

/// An order of IHO S-44, edition 6.1: the largest TVU is sqrt(a^2 + (b depth)^2), the largest THU c + d depth. (E214)
struct IhoOrder {
  const char* name;
  double a, b, c, d;
  bool holds(const SwathSounding& sounding, double depth) const {
    return deviations_of_95 * sounding.vertical_deviation <= std::hypot(a, b * depth) &&
           deviations_of_95 * sounding.horizontal_deviation <= c + d * depth;
  }
};
constexpr IhoOrder iho_orders[] = {{"exclusive", 0.15, 0.0075, 1, 0},
                                   {"special", 0.25, 0.0075, 2, 0},
                                   {"1a, 1b", 0.5, 0.013, 5, 0.05},
                                   {"2", 1, 0.023, 20, 0.1}};

/// Adds the shares of the soundings with stated uncertainties that reach each order, and the finest that 95 % reach.
void add_orders(const SwathRecord& record, ordered_json& info) {
  std::array<double, std::size(iho_orders)> reached{};
  double stated = 0;
  for (const SwathPing& ping : record.pings)
    for (const SwathSounding& sounding : ping.soundings) {
      if (sounding.rejected || std::isnan(sounding.vertical_deviation) || std::isnan(sounding.horizontal_deviation))
        continue;
      ++stated;
      for (std::size_t k = 0; k < reached.size(); ++k)
        reached[k] += iho_orders[k].holds(sounding, std::max(0.0, sounding.depth)) ? 1 : 0;
    }
  if (!record.total_deviations || stated == 0) return;
  info["iho_order"] = "none";
  for (std::size_t k = reached.size(); k-- > 0;)
    if (reached[k] >= 0.95 * stated) info["iho_order"] = iho_orders[k].name;
  for (std::size_t k = 0; k < reached.size(); ++k) info["iho_orders"][iho_orders[k].name] = reached[k] / stated;
}

void add_way(const SwathPings& swath, ordered_json& info) {
  FactSpan latitude, longitude;
  double way = 0;
  const std::vector<SwathPing>& pings = swath.record().pings;
  for (std::size_t p = 0; p < pings.size(); ++p) {
    latitude.add(degrees(pings[p].position.latitude)), longitude.add(degrees(pings[p].position.longitude));
    if (p > 0)
      way +=
          (swath.track_point(p).world_from_head.translation() - swath.track_point(p - 1).world_from_head.translation())
              .head<2>()
              .norm();
  }
  info["latitude_deg"] = latitude.json(), info["longitude_deg"] = longitude.json();
  info["track_length_m"] = way;
}

}  // namespace

ordered_json info_of_swath(const std::string& path) {
  const SwathPings swath(read_swath(path));
  const SwathRecord& record = swath.record();
  const SwathPing& first = record.pings.front();
  ordered_json info = {
      {"path", path}, {"format", record.format}, {"sonar", record.sonar}, {"pings", record.pings.size()}};
  std::size_t beams = 0;
  for (const SwathPing& ping : record.pings) beams = std::max(beams, ping.beams);
  info["beams"] = beams;
  add_soundings(record, info);
  add_orders(record, info);
  if (first.frequency > 0) info["centre_frequency_hz"] = first.frequency;
  if (first.sound_speed > 0) info["sound_speed"] = first.sound_speed;
  info["first_utc"] = utc_after("1970-01-01T00:00:00Z", first.time);
  info["last_utc"] = utc_after("1970-01-01T00:00:00Z", record.pings.back().time);
  add_way(swath, info);
  info["profiles"] = record.profiles.size(), info["attitudes"] = record.attitudes.size();
  info["records"] = record.records;
  const std::string word = shell_word(path);
  info["next"] = {"insonify compare OTHER.gsf " + word, "insonify image " + word + " -o swath.png",
                  "insonify view " + word};
  return info;
}

}  // namespace insonify::tool

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "files/utc.hpp"
#include "tool/info/info.hpp"
#include "tool/run/record_file.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Adds the facts of a side-scan beside its samples.
void add_side_scan(const Record& record, ordered_json& info) {
  const std::vector<Ping>& pings = record.cube.pings;
  info["channels"] = record.channels;
  FactSpan altitude, depth;
  for (std::size_t p = 0; p < pings.size(); ++p) {
    if (record.altitude[p] > 0) altitude.add(record.altitude[p]);
    depth.add(-pings[p].world_from_head.translation().z());
  }
  if (!altitude.json().is_null()) info["altitude_m"] = altitude.number_or_json();
  info["depth_m"] = depth.number_or_json();
  if (record.cube.anchor) {
    info["latitude_deg"] = record.cube.anchor->latitude_deg;
    info["longitude_deg"] = record.cube.anchor->longitude_deg;
    double way = 0;
    for (std::size_t p = 1; p < pings.size(); ++p)
      way += (pings[p].world_from_head.translation() - pings[p - 1].world_from_head.translation()).head<2>().norm();
    info["track_length_m"] = way;
  }
}

}  // namespace

ordered_json info_of_record(const std::string& path) {
  const Record record = read_record(path);
  const std::vector<Ping>& pings = record.cube.pings;
  const Ping& first = pings.front();
  ordered_json info = {
      {"path", path},
      {"format", record.kind},
      {"sonar", record.cube.sonar},
      {"pings", pings.size()},
      {"beams", first.fan.beams()},
      {"bins", first.gate.bins()},
      {"max_range_m", first.gate.min_range + static_cast<double>(first.gate.bins()) * first.gate.bin_size},
      {"bin_size_m", first.gate.bin_size}};
  if (record.cube.centre_frequency > 0) info["centre_frequency_hz"] = record.cube.centre_frequency;
  if (first.sound_speed > 0) info["sound_speed"] = first.sound_speed;
  if (first.time > 1e6) {  // since 1970; a smaller one is since the sonar was switched on
    info["first_utc"] = utc_after("1970-01-01T00:00:00Z", first.time);
    info["last_utc"] = utc_after("1970-01-01T00:00:00Z", pings.back().time);
  }
  info["levels"] = record.unit;
  const std::string word = shell_word(path);
  if (record.side_scan) {
    add_side_scan(record, info);
    info["next"] = {"insonify image " + word + " --view waterfall -o waterfall.png",
                    "insonify compare RUN " + word + "  # a run of one side"};
  } else {
    const auto [low, high] = std::minmax_element(first.fan.azimuth.begin(), first.fan.azimuth.end());
    info["field_of_view_deg"] = degrees(*high - *low);
    info["next"] = {"insonify image " + word + " -o fan.png", "insonify compare RUN " + word};
  }
  info["next"].push_back("insonify view " + word);
  return info;
}

}  // namespace insonify::tool

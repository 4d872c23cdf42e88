// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "store/mission_file.hpp"

namespace insonify::tool {

/// For the manifest of a survey: start_utc and anchor, null if unknown.
nlohmann::ordered_json frame_json(const SurveyFrame& frame);

/// A head of a merged survey and its cube.
struct HeadCube {
  std::string name, path;
};

/// The ways of the heads as GeoJSON: for each a LineString of longitude, latitude and height (WGS 84, E90), with its
/// name, the numbers of its pings, and their times: UTC, or [s] without start_utc. Heads of one ping give a Point.
/// `frame` has an anchor.
nlohmann::ordered_json track_geojson(const SurveyFrame& frame, const std::vector<HeadCube>& heads);

}  // namespace insonify::tool

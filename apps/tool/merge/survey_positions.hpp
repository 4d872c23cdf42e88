// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "store/mission_file.hpp"

namespace insonify::tool {

/// For the manifest of a survey: start_utc and anchor, null if unknown, and the system of its world if it is known.
nlohmann::ordered_json frame_json(const SurveyFrame& frame);

/// A head of a merged survey and its cube.
struct HeadCube {
  std::string name, path;
};

/// The ways of the heads as GeoJSON: for each a LineString of longitude, latitude and height (WGS 84, E90), with its
/// name, the numbers of its pings, and their times: UTC, or [s] without start_utc. Heads of one ping give a Point.
/// place      where the world is
/// start_utc  of time 0, or ""
nlohmann::ordered_json track_geojson(const Georeference& position, const std::string& start_utc,
                                     const std::vector<HeadCube>& heads);

}  // namespace insonify::tool

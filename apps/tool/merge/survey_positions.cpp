// SPDX-License-Identifier: BSD-3-Clause
#include "tool/merge/survey_positions.hpp"

#include <cmath>

#include "core/units.hpp"
#include "files/utc.hpp"
#include "store/cube.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Longitude and latitude to 1e-9 degrees, which is a tenth of a millimetre, and height to a millimetre.
ordered_json coordinates_of(const Georeference& world, const Pose& world_from_head) {
  const GeoPosition position = geo_from_world(world, world_from_head.translation());
  return {std::round(1e9 * degrees(position.longitude)) / 1e9, std::round(1e9 * degrees(position.latitude)) / 1e9,
          std::round(1e3 * position.height) / 1e3};
}

}  // namespace

ordered_json frame_json(const SurveyFrame& frame) {
  ordered_json json = {{"start_utc", nullptr}, {"anchor", nullptr}};
  if (!frame.start_utc.empty()) json["start_utc"] = frame.start_utc;
  if (frame.anchor)
    json["anchor"] = {{"latitude_deg", frame.anchor->latitude_deg},
                      {"longitude_deg", frame.anchor->longitude_deg},
                      {"heading_deg", frame.anchor->heading_deg}};
  if (!frame.system.empty()) json["system"] = frame.system;
  return json;
}

ordered_json track_geojson(const Georeference& georeference, const std::string& start_utc,
                           const std::vector<HeadCube>& heads) {
  ordered_json features = ordered_json::array();
  for (const HeadCube& head : heads) {
    ordered_json line = ordered_json::array(), times = ordered_json::array(), numbers = ordered_json::array();
    for (const TrackPoint& point : read_track(head.path)) {
      line.push_back(coordinates_of(georeference, point.world_from_head));
      numbers.push_back(point.number);
      if (start_utc.empty())
        times.push_back(point.time);
      else
        times.push_back(utc_after(start_utc, point.time));
    }
    const bool single = line.size() == 1;
    features.push_back(
        {{"type", "Feature"},
         {"properties", {{"head", head.name}, {"ping", numbers}, {"time", times}}},
         {"geometry", {{"type", single ? "Point" : "LineString"}, {"coordinates", single ? line[0] : line}}}});
  }
  return {{"type", "FeatureCollection"}, {"features", features}};
}

}  // namespace insonify::tool

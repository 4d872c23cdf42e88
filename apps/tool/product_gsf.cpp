#include <algorithm>
#include <cmath>
#include <memory>

#include "core/units.hpp"
#include "formats/gsf_file.hpp"
#include "tool/product_run.hpp"

namespace insonify::tool {
namespace {

/// Axes of the vessel at a head: ahead and to starboard, level, from the port axis of the head.
struct VesselAxes {
  Eigen::Vector3d ahead, starboard;
  double roll;  ///< starboard down [rad]
  explicit VesselAxes(const Pose& world_from_head) {
    const Eigen::Vector3d port = world_from_head.linear().col(1);
    ahead = port.cross(Eigen::Vector3d::UnitZ());
    ahead = ahead.norm() > 1e-6 ? ahead.normalized() : Eigen::Vector3d::UnitX();
    starboard = ahead.cross(Eigen::Vector3d::UnitZ());
    roll = std::asin(std::clamp(port.z(), -1.0, 1.0));
  }
};

/// A sounding where it lies on the globe, in axes of the vessel at its head.
GsfBeam placed_beam(const PlacedRun& run, const Anchor& here, const BottomSoundings& found, std::size_t i,
                    double sound_speed, GsfBeam beam) {
  const Eigen::Vector3d away = world_from_geo(here, geo_from_world(run.reference(), found.position[i]));
  const auto deviation = static_cast<double>(found.deviation[i]);
  beam.detected = true;
  beam.depth = -found.position[i].z();
  beam.along = away.x(), beam.across = -away.y();
  beam.travel_time = 2 * found.range[i] / sound_speed;
  beam.level_db = static_cast<double>(found.level_db[i]);
  beam.quality = static_cast<double>(found.quality[i]);
  beam.vertical_deviation = deviation * std::cos(beam.angle);
  beam.horizontal_deviation = deviation * std::sin(beam.angle);
  return beam;
}

GsfPing gsf_ping(const PlacedRun& run, const Ping& ping, const BottomSoundings& found) {
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const VesselAxes axes(ping.world_from_head);
  GsfPing out;
  out.time = run.start + ping.time;
  out.place = geo_from_world(run.reference(), head);
  out.heading = out.course = heading_of(run.reference(), head, axes.ahead);
  out.roll = axes.roll;
  out.number = static_cast<std::uint16_t>(ping.number);
  out.surface_sound_speed = ping.sound_speed;
  out.range = ping.gate.max_range;
  out.beam_width_along = ping.fan.elevation_width, out.beam_width_across = ping.fan.beam_width;
  const Anchor here{degrees(out.place.latitude), degrees(out.place.longitude), degrees(out.heading)};
  std::vector<std::pair<double, GsfBeam>> beams;
  std::size_t next = 0;  // soundings are by beams
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const Eigen::Vector3d axis =
        ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
    GsfBeam beam;
    beam.angle = std::acos(std::clamp(-axis.z(), -1.0, 1.0));
    beam.azimuth = std::atan2(axis.dot(axes.ahead), axis.dot(axes.starboard));
    const double across = axis.dot(axes.starboard);
    if (next == found.size() || found.beam[next] != b) beams.emplace_back(across, beam);
    for (; next < found.size() && found.beam[next] == b; ++next)  // each a beam of its own
      beams.emplace_back(across, placed_beam(run, here, found, next, ping.sound_speed, beam));
  }
  std::stable_sort(beams.begin(), beams.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [across, beam] : beams) out.beams.push_back(beam);
  return out;
}

}  // namespace

std::size_t gsf_product(const PlacedRun& run) {
  std::unique_ptr<GsfFile> file;
  GsfPing last;
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    GsfPing swath = gsf_ping(run, ping, found);
    if (!file) {
      const SoundSpeedProfile uniform{{0}, {ping.sound_speed}};
      file = std::make_unique<GsfFile>(run.options.output, run.pings.environment.profile.value_or(uniform), swath.place,
                                       swath.time,
                                       std::vector<std::string>{"REFERENCE TIME=1970/001 00:00:00", "GEOID=WGS-84",
                                                                "TIDAL_DATUM=UNKNOWN", "PLATFORM_TYPE=SURFACE_SHIP"});
    } else if (swath.time > last.time) {
      const Anchor from{degrees(last.place.latitude), degrees(last.place.longitude), 0};
      const Eigen::Vector3d way = world_from_geo(from, swath.place);  // north, west
      swath.speed = std::hypot(way.x(), way.y()) / (swath.time - last.time);
      if (swath.speed > 0) swath.course = std::atan2(-way.y(), way.x());
    }
    file->add(swath);
    last = std::move(swath);
  });
  file->finish();
  return soundings;
}

}  // namespace insonify::tool

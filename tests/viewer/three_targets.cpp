// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/three_targets.hpp"

#include "support/test.hpp"

namespace insonify {
namespace {

constexpr std::size_t beams = 41, bins = 120;
constexpr float loud = 10, soft = 0.01F;  // [Pa], 60 dB apart

// Adds a plate of 5 x 5 surfels, 2 cm apart, facing the head.
void add_plate(SceneCloud& scene, const Pose& pose, const Eigen::Vector3d& middle, std::uint16_t material) {
  const Eigen::Vector3d towards = (pose.translation() - middle).normalized();
  const Eigen::Vector3d across = towards.cross(Eigen::Vector3d::UnitZ()).normalized(), up = across.cross(towards);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) add_surfel(scene, middle + 0.02 * (i * across + j * up), towards, 4e-4, material);
}

void add_echo(std::vector<Ping>& pings, const Target& target) {
  for (Ping& ping : pings)
    ping.pressure(static_cast<Eigen::Index>(target.pixel.beam), static_cast<Eigen::Index>(target.pixel.bin)) = loud;
}

}  // namespace

LazyPings reel_in_memory(std::vector<Ping> pings) {
  std::vector<TrackPoint> positions;
  for (const Ping& ping : pings) positions.push_back(ping);
  const auto held = std::make_shared<const std::vector<Ping>>(std::move(pings));
  PingSource source;
  source.ping = [held](std::size_t i) { return (*held)[i]; };
  source.beam = [held](std::size_t first, std::size_t count, std::size_t beam) {
    ComplexGridF rows(static_cast<Eigen::Index>(count), (*held)[first].pressure.cols());
    for (std::size_t i = 0; i < count; ++i)
      rows.row(static_cast<Eigen::Index>(i)) = (*held)[first + i].pressure.row(static_cast<Eigen::Index>(beam));
    return rows;
  };
  return {std::move(positions), std::move(source)};
}

TargetData three_targets(std::size_t pings, bool with_contributors) {
  TargetData made;
  ViewerData& data = made.data;
  data.title = "three targets";
  Ping ping;
  ping.world_from_head = pose_from_yaw_pitch_roll({10, 20, -3}, radians(30), 0, 0);
  ping.fan = make_fan(beams, radians(82), radians(2), radians(20));  // 2 degrees apart, beam 20 ahead
  ping.gate = {2, 14, 0.1};
  ping.sound_speed = 1500, ping.absorption_db_per_m = 0.25;
  ping.pressure = ComplexGridF::Constant(beams, bins, soft);
  for (std::size_t i = 0; i < pings; ++i) {
    made.pings.push_back(ping);
    made.pings.back().number = static_cast<std::int64_t>(7 + i);
    made.pings.back().time = 0.5 * static_cast<double>(i);
  }

  data.scene.origin = {8, 22, 0};
  data.scene.materials.clear();
  for (const char* name : {"iron", "wood", "rubber"}) data.scene.materials.push_back({name});
  const auto target_at = [&](const char* name, std::size_t beam, std::size_t bin, std::uint16_t material) {
    Target target{name, ping.fan.azimuth[beam], ping.gate.centre(bin), {beam, bin}, {}};
    target.position = ping.world_from_head * (target.range * unit_vector({target.azimuth, 0}));
    add_plate(data.scene, ping.world_from_head, target.position, material);
    add_echo(made.pings, target);
    return target;
  };
  const bool port_last = ping.fan.azimuth[0] < 0;  // for either numbering of the fan
  made.port = target_at("iron", port_last ? 33 : 7, 40, 0);
  made.starboard = target_at("wood", port_last ? 7 : 33, 40, 1);
  made.far = target_at("rubber", 20, 100, 2);
  data.pings = reel_in_memory(made.pings);
  if (!with_contributors) return made;

  // Two of the port target's own surfels.
  Contributors list{beams, bins, 2, {}, {}, {}, {}, {}, {}};
  const std::size_t entries = beams * bins * 2;
  list.surfel.assign(entries, Contributors::none);
  list.id.assign(entries, Contributors::none);
  list.share.assign(entries, 0);
  list.elevation.assign(entries, 0);
  list.material.assign(entries, Contributors::no_material);
  list.path.assign(entries, PathKind::direct);
  for (const std::uint32_t k : {0U, 1U}) {
    const std::size_t at = list.at(made.port.pixel.beam, made.port.pixel.bin, k);
    list.surfel[at] = 12 - 5 * k;
    list.id[at] = data.scene.id[12 - 5 * k];
    list.share[at] = k == 0 ? 0.75F : 0.2F;
    list.elevation[at] = static_cast<float>(radians(k == 0 ? 0 : -1.5));
    list.material[at] = 0;
    list.path[at] = k == 0 ? PathKind::direct : PathKind::one_bounce;
  }
  data.contributors.assign(pings, list);
  return made;
}

}  // namespace insonify

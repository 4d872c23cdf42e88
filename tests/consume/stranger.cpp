// SPDX-License-Identifier: BSD-3-Clause
// A program of a user of PCL: a cloud in memory, pings from several threads, soundings back as a PCL cloud; a scene
// source of its own, and echoes of its own.
#include <future>
#include <iostream>
#include <memory>
#include <vector>

#include <insonify/beamforming/synthesizer.hpp>
#include <insonify/core/units.hpp>
#include <insonify/scene_io/pcl_bridge.hpp>
#include <insonify/simulate/ping_simulator.hpp>
#include <insonify/store/sonar_file.hpp>
#include <insonify/survey/scene_source.hpp>
#include <insonify/view/picture.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

using namespace insonify;

// The reachable part of a scene that is too large to be sorted whole.
class NearPart : public SceneSource {
 public:
  explicit NearPart(const SceneCloud& all) : all_(all), whole_(whole_of(all)) {}
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator,
                                                 const PingEvent& event) const override {
    const InsonifiedRegion region = simulator.reach(whole_, event);
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < all_.size(); ++i)
      if (may_intersect(region, all_.origin + all_.point[i].cast<double>(), 0, all_.area[i])) near.push_back(i);
    auto part = std::make_shared<SceneCloud>(subset(all_, near));
    part->part_of = whole_;  // so that the ping is that of the whole scene, to the byte
    return std::make_shared<PreparedScene>(std::move(part), 1);
  }

 private:
  const SceneCloud& all_;
  WholeScene whole_;
};

// Returns the peak of an echo of 1 Pa from 5 m straight ahead, received by the user's own array [Pa].
double peak_of_an_echo(SonarSpec spec) {
  SonarHead head = make_head(spec, 1500);
  head.array.spacing = 1500 / spec.centre_frequency / 2;
  head.array.shading.assign(128, 1.0);
  Echoes echoes;
  echoes.amplitude = {1}, echoes.delay = {10 / 1500.0}, echoes.u = {0}, echoes.v = {0};
  return Synthesizer(head, {.sound_speed = 1500}).pressure(echoes).abs().maxCoeff();
}

int main() {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 100; ++i)
    for (int j = -50; j < 50; ++j) cloud.emplace_back(0.1F * static_cast<float>(i), 0.1F * static_cast<float>(j), 0.0F);
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, 10);
  const auto loaded = from_pcl(cloud, options);

  SonarSpec spec = find_sonar("p900-45").spec;
  spec.max_range = 8;
  const PingSimulator simulator(make_head(spec, sound_speed({})), {}, {.threads = 1});
  const PreparedScene scene(loaded.scene);
  std::vector<std::future<SimulatedPing>> pings;
  for (int k = 0; k < 4; ++k)
    pings.push_back(std::async(std::launch::async, [&, k] {
      return simulator.ping(scene, {.world_from_head = pose_from_yaw_pitch_roll({0.2 * k, 0, 2}, 0, radians(20), 0)});
    }));
  const NearPart source(loaded.scene);
  const double peak = peak_of_an_echo(spec);
  bool good = !colour_map_names().empty() && peak > 0.9 && peak < 1.0001;
  for (int k = 0; k < 4; ++k) {
    const SimulatedPing ping = pings[k].get();
    good = good && to_pcl(ping.soundings).width > 100;
    const PingEvent event{.world_from_head = ping.ping.world_from_head};
    good =
        good && (simulator.ping(*source.scene_for(simulator, event), event).ping.pressure == ping.ping.pressure).all();
  }
  std::cout << (good ? "good\n" : "bad\n");
  return good ? 0 : 1;
}

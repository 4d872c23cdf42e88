// SPDX-License-Identifier: BSD-3-Clause
// Cost of moving parts: part_speed [SURFELS] [PINGS]. Pings of a harbour alone and of the same harbour with ten parts
// of 5000 surfels that stand elsewhere in every ping, by turns; medians, and the peak of memory of each in a child
// process.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../wide_head.hpp"
#include "core/stop_watch.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/posed_scene.hpp"
#include "simulate/ping_simulator.hpp"

namespace {

using namespace insonify;

constexpr int moving_parts = 10, surfels_of_part = 5000;

/// Returns a sphere of 0.4 m, on a Fibonacci spiral.
std::shared_ptr<const SceneCloud> sphere() {
  SceneCloud cloud;
  const double radius = 0.4, golden = pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < surfels_of_part; ++i) {
    const double z = 1 - (2 * i + 1.0) / surfels_of_part, ring = std::sqrt(1 - z * z);
    const Eigen::Vector3d n(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
    add_surfel(cloud, radius * n, n, 4 * pi * radius * radius / surfels_of_part);
  }
  return std::make_shared<const SceneCloud>(std::move(cloud));
}

/// Returns the parts at ping number `ping`: they go round in front of the head.
std::vector<PlacedPart> parts_in(int ping, const std::shared_ptr<const SceneCloud>& cloud) {
  std::vector<PlacedPart> parts;
  for (int k = 0; k < moving_parts; ++k) {
    const double turn = 0.1 * ping + 0.6 * k, away = 4 + 1.5 * k;
    PlacedPart part{.name = "part-" + std::to_string(k), .cloud = cloud};
    part.world_from_part = pose_from_yaw_pitch_roll({away + std::cos(turn), std::sin(turn), -4}, turn, 0, 0);
    part.velocity = {-std::sin(turn), std::cos(turn), 0}, part.turn_rate = {0, 0, 1};
    parts.push_back(part);
  }
  return parts;
}

struct Bench {
  PingSimulator simulator{wide_head(14000, 30), Environment{}};
  SceneCloud harbour;
  std::shared_ptr<const SceneCloud> cloud = sphere();
  explicit Bench(std::size_t surfels) : harbour(make_built_in_scene("harbour", {.points = surfels})) {}

  /// Returns a function that pings the bed alone.
  std::function<void(int)> alone() {
    auto scene = std::make_shared<PreparedScene>(std::move(harbour));
    return [this, scene](int ping) { simulator.ping(*scene, {.world_from_head = harbour_pose(), .number = ping}); };
  }
  /// Returns a function that pings the bed with moving parts.
  std::function<void(int)> with_parts() {
    std::vector<PlacedPart> bed{
        {.name = "harbour", .cloud = std::make_shared<const SceneCloud>(std::move(harbour)), .captured = true}};
    auto scene = std::make_shared<PosedScene>(bed, cloud->materials);
    return [this, scene](int ping) {
      simulator.ping(*scene->pose(parts_in(ping, cloud)), {.world_from_head = harbour_pose(), .number = ping});
    };
  }
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Runs `run` in a child process and prints its peak of memory.
void report_memory(const char* what, const std::function<void()>& run) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    run();
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::printf("%-12s peak of memory %6.0f MB\n", what, static_cast<double>(used.ru_maxrss) / 1024);
    std::fflush(stdout);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

}  // namespace

int main(int count, char** argument) {
  const std::size_t surfels = count > 1 ? std::strtoull(argument[1], nullptr, 10) : 1'000'000;
  const int pings = count > 2 ? std::atoi(argument[2]) : 100;
  const auto ping_all = [pings](const std::function<void(int)>& ping) {
    for (int p = 0; p < pings; ++p) ping(p);
  };
  report_memory("alone", [&] { ping_all(Bench(surfels).alone()); });
  report_memory("with parts", [&] { ping_all(Bench(surfels).with_parts()); });

  Bench one(surfels), other(surfels);
  const auto alone = one.alone(), with_parts = other.with_parts();
  std::vector<double> seconds[2];
  for (int p = 0; p < pings; ++p)
    for (int which = 0; which < 2; ++which) {
      StopWatch watch;
      (which == 0 ? alone : with_parts)(p);
      seconds[which].push_back(watch.lap());
    }
  std::printf("medians of %d pings: alone %.1f ms, with parts %.1f ms, ratio %.3f\n", pings, 1e3 * median(seconds[0]),
              1e3 * median(seconds[1]), median(seconds[1]) / median(seconds[0]));
}

// SPDX-License-Identifier: BSD-3-Clause
// Tests the memory of a ping: it grows with the points in view, and those out of view cost none.
#include <malloc.h>

#include "support/checked_ping.hpp"
#include "support/sanitizers.hpp"

namespace insonify::ping_memory {

/// Returns a line of Linux' account of this process [bytes]; 0 without one.
double memory_line(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name, 0) == 0) return 1024 * std::stod(line.substr(name.size()));
  return 0;
}

/// Returns the largest resident set since the last call of forget_peak [bytes].
double peak_memory() { return memory_line("VmHWM:"); }

bool forget_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good() && peak_memory() > 0 && peak_memory() < 1.1 * memory_line("VmRSS:");
}

/// Returns a wall of side x side surfels, 6 m square and 8 m ahead.
SceneCloud wall(int side, double x = 8) {
  SceneCloud scene;
  const auto n = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const float step = 6.0F / static_cast<float>(side);
  scene.origin = {x, -3, -3};
  scene.point.reserve(n);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      scene.point.emplace_back(0.0F, (static_cast<float>(i) + 0.5F) * step, (static_cast<float>(j) + 0.5F) * step);
  scene.normal.assign(n, {-1, 0, 0});
  scene.area.assign(n, step * step);
  scene.material.assign(n, 0);
  scene.id.resize(n);
  for (std::size_t i = 0; i < n; ++i) scene.id[i] = static_cast<std::uint32_t>(i);
  return scene;
}

/// Returns the memory of a ping of `scene` beyond the scene itself [bytes].
double memory_of_ping(const SceneCloud& scene) {
  forget_peak();
  const double before = peak_memory();
  const SimulatedPing p = ping_of(scene, {.sampling = {.scatterers_per_cell = 0}});
  EXPECT_GT(p.ping.pressure.abs().maxCoeff(), 0);
  return peak_memory() - before;
}

// A ping needs 34 bytes per surfel of the scene and the arrays of the surfels in view, which grow linearly with their
// number: 120 bytes per surfel when this was written. Scenes larger than memory are not covered here.
TEST(MemoryInView, grows_with_the_points_in_view_and_no_faster) {
  if (sanitized || !forget_peak()) GTEST_SKIP() << "peak memory cannot be measured here";
  constexpr double bytes_per_surfel = 250;
  const double half = memory_of_ping(wall(1000)), full = memory_of_ping(wall(1414));
  EXPECT_LT(full, bytes_per_surfel * 1414 * 1414);
  EXPECT_LT(full, 2.5 * half);
  RecordProperty("bytes_per_surfel", std::to_string(full / (1414 * 1414)));
}

// Points that are neither in the gate nor can occlude it are discarded at once: two million of them beyond the gate
// cost a ping of one small plate no more than sorting them into blocks (two keys of 8 bytes each), and do not change a
// bit of the result.
TEST(MemoryOutOfView, is_not_taken_by_points_out_of_view) {
  if (sanitized || !forget_peak()) GTEST_SKIP() << "peak memory cannot be measured here";
  const SceneCloud near = plate(6, 1, 30);
  SceneCloud far = wall(1414, 40);
  far.origin.setZero();
  for (auto& p : far.point) p += Eigen::Vector3f(40, -3, -3);
  const std::size_t beyond = far.size();
  for (std::size_t i = 0; i < near.size(); ++i) {
    far.point.push_back(near.point[i]);
    far.normal.push_back(near.normal[i]);
    far.area.push_back(near.area[i]);
    far.material.push_back(0);
    far.id.push_back(near.id[i]);
  }
  for (std::size_t i = 0; i < beyond; ++i) far.id[i] += static_cast<std::uint32_t>(near.size());
  const double alone = memory_of_ping(near), among = memory_of_ping(far);
  EXPECT_LT(among - alone, 18.0 * static_cast<double>(beyond));  // bytes
  EXPECT_TRUE(same(image(ping_of(far, {.sampling = {.scatterers_per_cell = 0}})),
                   image(ping_of(near, {.sampling = {.scatterers_per_cell = 0}}))));
}

}  // namespace insonify::ping_memory

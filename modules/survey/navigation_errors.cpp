// SPDX-License-Identifier: BSD-3-Clause
#include "survey/navigation_errors.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/random.hpp"

namespace insonify {
namespace {

using Components = Eigen::Vector<double, 6>;

constexpr double nodes_per_correlation = 10, most_nodes = 1e7;

/// Returns the six independent standard normal numbers of a node.
Components normals_of(std::uint64_t seed, std::uint64_t node) {
  Components n;
  for (std::uint64_t pair = 0; pair < 3; ++pair) {
    // E|z|^2 = 1: real and imaginary part have half of it each.
    const std::complex<double> z =
        std::sqrt(2.0) * random_complex_normal(seed, RandomStage::navigation, {node, pair, 0});
    n[static_cast<Eigen::Index>(2 * pair)] = z.real();
    n[static_cast<Eigen::Index>(2 * pair + 1)] = z.imag();
  }
  return n;
}

void require_valid_noise(const NavigationNoise& noise) {
  for (const auto& [value, name] : {std::pair(noise.position, "position"), std::pair(noise.heading, "heading"),
                                    std::pair(noise.attitude, "attitude")})
    if (!(value >= 0 && std::isfinite(value)))
      fail(ErrorKind::argument, "navigation_errors: ", name, " = ", value, ", must be finite and >= 0");
  if (!(noise.correlation_time > 0 && std::isfinite(noise.correlation_time)))
    fail(ErrorKind::argument, "navigation_errors: correlation_time = ", noise.correlation_time,
         " s, must be finite and > 0");
}

}  // namespace

NavigationErrors navigation_errors(const Trajectory& trajectory, const NavigationNoise& noise, std::uint64_t seed) {
  require_valid_noise(noise);
  NavigationErrors errors{trajectory.time.front(), noise.correlation_time / nodes_per_correlation, {}};
  const double count = std::ceil((trajectory.time.back() - errors.begin) / errors.step) + 2;
  if (!(count <= most_nodes))
    fail(ErrorKind::argument, "navigation_errors: correlation_time = ", noise.correlation_time, " s, must be at least ",
         noise.correlation_time * count / most_nodes, " s for a trajectory of ", trajectory.time.back() - errors.begin,
         " s");

  const double kept = std::exp(-1 / nodes_per_correlation), fresh = std::sqrt(1 - kept * kept);  // (E98)
  Components sigma;
  sigma << noise.position, noise.position, noise.position, noise.heading, noise.attitude, noise.attitude;
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(count); ++k) {
    const Components drawn = sigma.cwiseProduct(normals_of(seed, k));
    errors.nodes.push_back(k == 0 ? drawn : Components(kept * errors.nodes.back() + fresh * drawn));
  }
  return errors;
}

Pose believed_pose(const NavigationErrors& errors, double time, const Pose& true_pose) {
  if (errors.nodes.empty()) return true_pose;
  const double last = static_cast<double>(errors.nodes.size() - 1);
  const double position = std::clamp((time - errors.begin) / errors.step, 0.0, last);
  const auto before = static_cast<std::size_t>(std::min(position, std::max(0.0, last - 1)));
  const double share = position - static_cast<double>(before);
  const Components e =
      (1 - share) * errors.nodes[before] + share * errors.nodes[std::min(before + 1, errors.nodes.size() - 1)];
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Pose believed = true_pose;
  believed.translation() += e.head<3>();
  believed.linear() = AngleAxisd(e[3], Vector3d::UnitZ()) * true_pose.linear() * AngleAxisd(e[4], Vector3d::UnitY()) *
                      AngleAxisd(e[5], Vector3d::UnitX());
  return believed;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/surface_scattering.hpp"

#include "core/random.hpp"
#include "support/test.hpp"

namespace insonify::surface_scattering_tests {

using Eigen::Vector3d;

TEST(SurfaceScattering, lambert_has_a_cosine_for_each_leg_and_albedo_pi_mu) {
  const SurfaceTable table = surface_table(std::vector<Material>{{"m", 0.1}}, 1e5, 1500);
  EXPECT_NEAR(table[0]->cross_section({0.5, 0.25, 0.3}), 0.0125, 1e-15);
  EXPECT_EQ(table[0]->cross_section({0.5, -0.25, 0.3}), 0);
  EXPECT_EQ(table[0]->back(0.5), 0.05);
  for (const double cosine : {0.1, 0.7, 1.0}) EXPECT_NEAR(albedo(*table[0], cosine), 0.1 * pi, 1e-12);
}

// Means of a function over the drawn directions agree with its integral over their density.
TEST(SurfaceScattering, directions_are_drawn_with_their_density) {
  for (const double slope : {0.0, 0.1, 0.4}) {
    const Vector3d in(std::sin(0.7), 0, std::cos(0.7)), towards(-std::sin(0.5), 0, std::cos(0.5));
    double drawn = 0, integral = 0;
    constexpr int n = 400;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j) {
        const Vector3d out = sampled_direction(slope, in, (k + 0.5) / n, (j + 0.5) / n);
        EXPECT_NEAR(out.norm(), 1, 1e-9);
        if (out.z() > 0) drawn += std::pow(std::max(0.0, out.dot(towards)), 8) / (n * n);
        const double z = (k + 0.5) / n, turn = 2 * pi * (j + 0.5) / n, s = std::sqrt(1 - z * z);
        const Vector3d o(s * std::cos(turn), s * std::sin(turn), z);
        integral += sampling_density(slope, {in.z(), z, in.dot(o)}) * std::pow(std::max(0.0, o.dot(towards)), 8) * 2 *
                    pi / (n * n);
      }
    EXPECT_NEAR(drawn, integral, 2e-3 * integral) << slope;
  }
}

}  // namespace insonify::surface_scattering_tests

// SPDX-License-Identifier: BSD-3-Clause
// Tests that surfels which give little of the energy at their range are split less (E127).
#include "sampling/visible_surfels.hpp"
#include "sampling_scenes.hpp"

namespace {

const BeamFan one_beam = make_fan(1, 0, radians(1), radians(60));
const RangeGate fine_gate{0.1, 50, 0.01};

/// Returns surfels of 0.1 m^2 that face the head, side by side in the middle of a cell of range, and one farther off.
SceneCloud facing_surfels(int beside, double step) {
  SceneCloud scene;
  for (int k = 0; k < beside; ++k) {
    const double u = step * (k - 0.5 * (beside - 1));
    const Eigen::Vector3d along(std::sqrt(1 - u * u), u, 0);
    add_surfel(scene, 10.01 * along, -along, 0.1);
  }
  add_surfel(scene, {20.01, 0, 0}, {-1, 0, 0}, 0.1);
  return scene;
}

using Energy = std::shared_ptr<const SurfelEnergy>;

/// Returns an energy that depends on position alone.
Energy energy_by(std::function<double(const Eigen::Vector3d&)> of_position) {
  struct ByPosition final : SurfelEnergy {
    std::function<double(const Eigen::Vector3d&)> of_position;
    double of(const Eigen::Vector3d& p, double, double, std::size_t) const override { return of_position(p); }
  };
  const auto energy = std::make_shared<ByPosition>();
  energy->of_position = std::move(of_position);
  return energy;
}
Energy even_energy() {
  return energy_by([](const Eigen::Vector3d&) { return 1.0; });
}

/// Returns the number of parts of each surfel.
std::vector<int> parts_of(const SceneCloud& scene, const Energy& energy, double per_cell = 1000) {
  const SamplingOptions options{
      .scatterers_per_cell = per_cell, .occlusion = false, .azimuth_margin = pi, .energy = energy};
  std::vector<int> parts(scene.size(), 0);
  for (const std::uint32_t s : find_scatterers(scene, Pose::Identity(), one_beam, fine_gate, options).scatterers.surfel)
    ++parts[s];
  return parts;
}

/// Returns energies by side: `left` for u > 0.1, 1 elsewhere.
Energy louder_by(double left) {
  return energy_by([left](const Eigen::Vector3d& p) { return p.y() > 0.1 * p.norm() ? left : 1; });
}

}  // namespace

TEST(PartShares, give_each_surfel_eight_times_its_share_of_what_its_range_gives) {
  // A whole range may have 8 x 1000 parts: of two surfels with energies of 1 and 1/99, 7920 and 80.
  const SceneCloud scene = facing_surfels(2, 0.3);
  const std::vector<int> by_cells = parts_of(scene, nullptr), by_shares = parts_of(scene, louder_by(1.0 / 99));
  ASSERT_GT(by_cells[1], 100);
  EXPECT_EQ(by_shares[0], by_cells[0]);
  EXPECT_EQ(by_shares[1], 80);
  EXPECT_EQ(by_shares[2], by_cells[2]) << "alone at its range";
  // There are as many as the cells need if that is less, and at least one.
  EXPECT_EQ(parts_of(scene, louder_by(1)), by_cells);
  EXPECT_EQ(parts_of(scene, louder_by(1e-9))[1], 1);
  EXPECT_EQ(parts_of(scene, louder_by(0))[1], 1);
}

TEST(PartShares, count_the_surfels_of_one_range_together) {
  // A hundred alike have a hundredth of 8 x 1000 parts each, whatever lies farther off.
  const SceneCloud scene = facing_surfels(100, 0.01);
  const std::vector<int> by_shares = parts_of(scene, even_energy());
  const std::vector<int> by_cells = parts_of(scene, nullptr);
  ASSERT_GT(by_cells[50], 80);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(by_shares[k], std::min(by_cells[k], 80)) << k;
  EXPECT_GT(by_shares[100], 80);
}

TEST(PartShares, follow_from_cross_section_of_a_tilted_surfel_over_the_ranges_that_it_spans) {
  // Seen at 60 degrees a disc of 0.1 m^2 spans 0.31 m: 16 or 17 cells of 2 cm, each with parts of its own.
  SceneCloud scene;
  add_surfel(scene, {10, 0, 0}, {-0.5, 0, std::sqrt(0.75)}, 0.1);
  const std::vector<int> few = parts_of(scene, even_energy(), 1);
  EXPECT_EQ(few[0], parts_of(scene, nullptr, 1)[0]) << "8 parts in each of 16 ranges would be more";
  struct Noting final : SurfelEnergy {
    mutable std::vector<double> seen;
    double of(const Eigen::Vector3d& p, double cosine, double area, std::size_t material) const override {
      seen = {p.x(), cosine, area, static_cast<double>(material)};
      return 1;
    }
  };
  const auto noting = std::make_shared<const Noting>();
  parts_of(scene, noting);
  EXPECT_NEAR(noting->seen.at(0), 10, 1e-6);
  EXPECT_NEAR(noting->seen.at(1), 0.5, 1e-6);
  EXPECT_NEAR(noting->seen.at(2), 0.1, 1e-6);
  EXPECT_EQ(noting->seen.at(3), 0);
}

TEST(PartShares, of_a_fan_are_of_what_one_main_lobe_hears_from_a_range) {
  // Pairs one above the other at u = 0 and at u = 0.4, discs of 3 cm seen face on from 10 m, and one alone at u = 0.3.
  SceneCloud scene;
  const auto add = [&scene](double u, double v) {
    const Eigen::Vector3d along(std::sqrt(1 - u * u - v * v), u, v);
    add_surfel(scene, 10.01 * along, -along, pi * 0.03 * 0.03);
  };
  add(0, 0), add(0, 0.3), add(0.4, 0), add(0.4, 0.3), add(0.3, 0.3);
  const Energy quiet_above = energy_by([](const Eigen::Vector3d& p) { return p.z() > 1 ? 1e-3 : 1.0; });
  const double per_cell = 1e5, share = 1e-3 / 1.001;
  const auto parts = [&](double field_of_view, const Energy& energy) {
    const SamplingOptions options{
        .scatterers_per_cell = per_cell, .occlusion = false, .azimuth_margin = pi, .energy = energy};
    std::vector<int> number(scene.size(), 0);
    const BeamFan fan = make_fan(91, field_of_view, radians(1), radians(60));
    for (const auto s : find_scatterers(scene, Pose::Identity(), fan, {9, 11, 0.01}, options).scatterers.surfel)
      ++number[s];
    return number;
  };
  // Main lobes everywhere: a surfel with all parts of its cells gives three tenths of what is received.
  const std::vector<int> by_cells = parts(radians(90), nullptr), of_fan = parts(radians(90), quiet_above);
  ASSERT_GT(by_cells[1], 1000);
  EXPECT_EQ(of_fan[0], by_cells[0]);
  EXPECT_NEAR(of_fan[1], per_cell / 0.3 * share, 1);
  EXPECT_EQ(of_fan[4], by_cells[4]) << "alone in its direction";
  // Main lobes to u = 0.2: beyond, as many as cells ask for.
  const Energy silent_above = energy_by([](const Eigen::Vector3d& p) { return p.z() > 1 ? 1e-9 : 1.0; });
  const std::vector<int> of_lobes = parts(radians(20), silent_above);
  EXPECT_EQ(of_lobes[1], 1);
  EXPECT_EQ(of_lobes[3], parts(radians(20), nullptr)[3]);
  EXPECT_GT(of_lobes[3], 100);
}

TEST(PartShares, leave_parts_where_they_are_and_are_the_same_for_listed_and_streamed_surfels) {
  const SceneCloud scene = facing_surfels(2, 0.3);
  SamplingOptions options{.scatterers_per_cell = 1000, .occlusion = false, .azimuth_margin = pi};
  const auto sampled = [&] {
    return find_scatterers(scene, Pose::Identity(), one_beam, fine_gate, options).scatterers;
  };
  const Scatterers all = sampled();
  options.energy = louder_by(1.0 / 99);
  for (const int threads : {1, 3}) {
    options.threads = threads;
    const Scatterers fewer = sampled();
    ASSERT_LT(fewer.size(), all.size());
    for (std::size_t i = 0; i < fewer.size(); ++i) {
      const auto same = static_cast<std::size_t>(std::find(all.id.begin(), all.id.end(), fewer.id[i]) - all.id.begin());
      ASSERT_LT(same, all.size());
      EXPECT_EQ(fewer.range[i], all.range[same]);
      EXPECT_EQ(fewer.azimuth[i], all.azimuth[same]);
    }
    const PreparedScene prepared(scene);
    const VisibleSurfels visible = find_visible(prepared, Pose::Identity(), one_beam, fine_gate, options);
    std::vector<std::uint64_t> ids = make_chunks(scene, Pose::Identity(), visible).id, expected = fewer.id;
    std::sort(ids.begin(), ids.end()), std::sort(expected.begin(), expected.end());
    EXPECT_EQ(ids, expected);
  }
}

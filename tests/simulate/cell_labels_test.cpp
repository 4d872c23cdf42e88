// SPDX-License-Identifier: BSD-3-Clause
// Labels of display cells (E194, E195) against those of contributors, geometry and energies known beforehand.
#include <map>

#include "returns/label_objects.hpp"
#include "simulate/ping_simulator.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::cell_label_tests {

constexpr int cell_count = 60;
const SonarHead swath_head = small_head({.beams = 48,
                                         .field_of_view_deg = 60,
                                         .beam_width_deg = 2,
                                         .elevation_width_deg = 30,
                                         .min_range = 3,
                                         .max_range = 15});

/// Returns a bed of sand with a wall of steel, which hides a part of it, and a block of rock.
const SceneCloud& field() {
  static const SceneCloud scene = [] {
    SceneCloud made;
    made.materials = {{"sand", 0.01}, {"steel", 0.05}, {"rock", 0.03}};
    const auto face = [&](const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                          const Eigen::Vector3d& normal, std::uint16_t material) {
      const std::size_t before = made.size();
      add_rectangle(made, corner, u, v, normal, 0.06);
      std::fill(made.material.begin() + static_cast<std::ptrdiff_t>(before), made.material.end(), material);
    };
    face({2, -7, 0}, {12, 0, 0}, {0, 14, 0}, {0, 0, 1}, 0);
    face({6, -2, 0}, {0, 2, 0}, {0, 0, 0.8}, {-1, 0, 0}, 1);
    face({8, 1, 0}, {0, 1.5, 0}, {0, 0, 0.6}, {-1, 0, 0}, 2);
    face({8, 1, 0.6}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, 1}, 2);
    return made;
  }();
  return scene;
}
Pose over_field() { return pose_from_yaw_pitch_roll({0, 0, 2.2}, 0, radians(14), 0); }

SimulationOptions with_labels(int threads = 0) {
  SimulationOptions o;
  o.outputs.display_bins = cell_count, o.outputs.labels = true, o.threads = threads;
  return o;
}
SimulatedPing labelled(const SimulationOptions& o, const SonarHead& head = swath_head,
                       const Environment& environment = {}) {
  return simulate_event(field(), head, {.world_from_head = over_field()}, environment, o);
}

/// Energy share of each label of contributors, in each display cell of a ping of samples.
using SharesOfLabels = std::map<std::uint16_t, double>;
std::vector<std::vector<SharesOfLabels>> shares_in_cells(const SimulatedPing& samples, const RangeGate& cells) {
  const Ping& ping = samples.ping;
  std::vector<std::vector<SharesOfLabels>> shares(ping.fan.beams(), std::vector<SharesOfLabels>(cells.bins()));
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    std::vector<double> all(cells.bins(), 0);
    for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
      const auto cell = static_cast<std::size_t>((ping.gate.centre(n) - cells.min_range) / cells.bin_size);
      if (cell >= cells.bins()) continue;
      const double energy = static_cast<double>(samples.outputs.contributors.total[b * ping.gate.bins() + n]);
      const auto row = static_cast<Eigen::Index>(b), column = static_cast<Eigen::Index>(n);
      all[cell] += energy;
      if (const std::uint16_t label = ping.labels.material(row, column); label < PixelLabels::shadow)
        shares[b][cell][label] += energy * static_cast<double>(ping.labels.share(row, column));
    }
    for (std::size_t c = 0; c < cells.bins(); ++c)
      for (auto& [label, energy] : shares[b][c]) energy = all[c] > 0 ? energy / all[c] : 0;
  }
  return shares;
}

/// Returns the ping with labels of samples, from contributors.
const SimulatedPing& of_contributors() {
  static const SimulatedPing made = [] {
    SimulationOptions samples;
    samples.outputs.contributors = 1;
    samples.sampling.scatterers_per_cell = 16;
    return labelled(samples);
  }();
  return made;
}

TEST(CellLabels, are_those_of_contributors_where_one_label_has_most_of_a_cell) {
  const SimulatedPing& referee = of_contributors();
  const Ping cells = labelled(with_labels()).ping;
  ASSERT_EQ(cells.labels.names, referee.ping.labels.names);
  const auto shares = shares_in_cells(referee, cells.gate);
  std::size_t clear = 0, others = 0, shares_off = 0;
  std::set<std::uint16_t> seen;
  for (std::size_t b = 1; b + 1 < cells.fan.beams(); ++b)
    for (std::size_t c = 1; c + 1 < cells.gate.bins(); ++c)
      for (const auto& [label, share] : shares[b][c]) {
        if (share < 0.7) continue;
        const auto row = static_cast<Eigen::Index>(b), column = static_cast<Eigen::Index>(c);
        ++clear, seen.insert(label);
        others += cells.labels.material(row, column) != label;
        shares_off += std::abs(static_cast<double>(cells.labels.share(row, column)) - share) > 0.25;
      }
  EXPECT_GT(clear, 1000U);
  EXPECT_EQ(seen.size(), 3U);
  EXPECT_LT(static_cast<double>(others), 0.01 * static_cast<double>(clear));
  EXPECT_LT(static_cast<double>(shares_off), 0.05 * static_cast<double>(clear));
  RecordProperty("cells", static_cast<int>(clear)), RecordProperty("other labels", static_cast<int>(others));
}

TEST(CellLabels, shadow_is_where_all_samples_of_a_cell_have_it) {
  const Ping &samples = of_contributors().ping, cells = labelled(with_labels()).ping;
  std::size_t dark = 0, dark_amiss = 0, lit = 0, lit_amiss = 0;
  for (Eigen::Index b = 1; b + 1 < cells.labels.material.rows(); ++b)
    for (Eigen::Index c = 1; c + 1 < cell_count; ++c) {
      std::size_t all = 0, in_shadow = 0;
      for (std::size_t n = 0; n < samples.gate.bins(); ++n) {
        const double away = samples.gate.centre(n) - cells.gate.centre(static_cast<std::size_t>(c));
        if (std::abs(away) > 0.5 * cells.gate.bin_size) continue;
        ++all;
        // Require shadow in the samples of the beams beside it, too: edges of shadows may lie there.
        const auto column = static_cast<Eigen::Index>(n);
        for (const Eigen::Index near : {b - 1, b, b + 1})
          in_shadow += samples.labels.material(near, column) == PixelLabels::shadow;
      }
      const bool is_shadow = cells.labels.material(b, c) == PixelLabels::shadow;
      if (in_shadow == 3 * all) ++dark, dark_amiss += !is_shadow;
      if (in_shadow == 0) ++lit, lit_amiss += is_shadow;
    }
  EXPECT_GT(dark, 100U);
  EXPECT_GT(lit, 500U);
  EXPECT_LT(static_cast<double>(dark_amiss), 0.02 * static_cast<double>(dark)) << dark;
  EXPECT_LT(static_cast<double>(lit_amiss), 0.02 * static_cast<double>(lit)) << lit;
}

TEST(CellLabels, do_not_depend_on_threads_nor_change_the_image) {
  const Ping one = labelled(with_labels(1)).ping, three = labelled(with_labels(3)).ping;
  SimulationOptions plain = with_labels();
  plain.outputs.labels = false;
  EXPECT_TRUE(same(labelled(plain).ping.pressure, one.pressure));
  for (const auto map : {&PixelLabels::material, &PixelLabels::second})
    EXPECT_TRUE(same(one.labels.*map, three.labels.*map));
  for (const auto map : {&PixelLabels::share, &PixelLabels::second_share, &PixelLabels::elevation})
    EXPECT_TRUE(same(one.labels.*map, three.labels.*map));
  EXPECT_TRUE(same(one.labels.id, three.labels.id));
  EXPECT_EQ(material_image(one.labels).cols(), cell_count);
  EXPECT_EQ(instance_image(one.labels).rows(), 48);
}

TEST(CellLabels, of_cells_that_are_means_of_samples_are_those_of_drawn_ones) {
  SimulationOptions samples = with_labels();
  samples.synthesis.phases = true;
  const Ping drawn = labelled(with_labels()).ping, averaged = labelled(samples).ping;
  EXPECT_FALSE(same(drawn.pressure, averaged.pressure));
  EXPECT_TRUE(same(drawn.labels.material, averaged.labels.material));
  EXPECT_TRUE(same(drawn.labels.id, averaged.labels.id));
  // These cells hold so few samples that they are never drawn.
  SimulationOptions fine = with_labels();
  fine.outputs.display_bins = 400;
  const PixelLabels labels = labelled(fine).ping.labels;
  EXPECT_EQ(labels.material.cols(), 400);
  EXPECT_GT((material_image(labels) < PixelLabels::shadow).count(), 4000);
}

TEST(CellLabels, shares_leave_out_noise_and_reverberation) {
  Environment turbid;
  turbid.volume_scattering_db = -30;
  SimulationOptions noisy = with_labels();
  noisy.effects.noise = true;
  const PixelLabels clear = labelled(with_labels()).ping.labels, dim = labelled(noisy, swath_head, turbid).ping.labels;
  EXPECT_TRUE(same(clear.material, dim.material));
  EXPECT_LT((clear.share - dim.share).abs().maxCoeff(), 0.02);
}

/// Tests two squares of one surfel each in one cell, at different elevations.
TEST(CellLabels, shares_and_elevation_are_those_of_two_echoes) {
  SceneCloud two;
  two.materials = {{"sand", 0.1}, {"steel", 0.1}};
  const double up = radians(4);
  const auto at = [](double range, double elevation) {
    return Eigen::Vector3d(range * std::cos(elevation), 0, range * std::sin(elevation));
  };
  add_surfel(two, at(9.1, up), -at(1, up), 3e-4, 0);
  add_surfel(two, at(9.1, -up), -at(1, -up), 1e-4, 1);
  SimulationOptions o = with_labels();
  const Ping ping = simulate_event(two, swath_head, {}, {}, o).ping;
  const auto cell = static_cast<Eigen::Index>((9.1 - ping.gate.min_range) / ping.gate.bin_size);
  for (const Eigen::Index beam : {23, 24}) {
    EXPECT_EQ(ping.labels.material(beam, cell), 0);
    EXPECT_EQ(ping.labels.second(beam, cell), 1);
    EXPECT_NEAR(ping.labels.share(beam, cell), 0.75, 0.02);
    EXPECT_NEAR(ping.labels.second_share(beam, cell), 0.25, 0.02);
    EXPECT_NEAR(ping.labels.elevation(beam, cell), up, 1e-3);
    EXPECT_EQ(ping.labels.id(beam, cell), two.id[0]);
  }
  EXPECT_EQ(ping.labels.material(2, cell), PixelLabels::nothing) << "where side lobes alone hear them";
  EXPECT_EQ(ping.labels.material(23, cell + 5), PixelLabels::nothing);
}

TEST(CellLabels, need_cells) {
  SimulationOptions o = with_labels();
  o.outputs.display_bins = 0;
  EXPECT_EQ(error_of([&] { labelled(o); }),
            "PingSimulator: options.outputs.labels = true, must be false without display_bins: labels are of cells");
}

}  // namespace insonify::cell_label_tests

// SPDX-License-Identifier: BSD-3-Clause
// Visible surfels are sorted by bands of range, inside each by u, and then by index.
#include "core/random.hpp"
#include "sampling/sort_by_place_internal.hpp"
#include "sampling_scenes.hpp"

namespace {

const RangeGate gate_of_bands{1, 41, 0.05};  // bands of 3.2 m

/// Returns surfels at random, of which many share a place, and many more a step of u.
SceneCloud crowded_scene(std::size_t count) {
  SceneCloud scene;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto at = random_uniform(5, RandomStage::surfel_split, {k % 3 == 0 ? 0 : k, 0, 0});
    const auto beside = random_uniform(6, RandomStage::surfel_split, {k, 0, 0});
    const double range = 0.5 + 45 * at[0], u = k % 3 == 1 ? 0.3 + 1e-8 * at[1] : 2 * at[1] - 1;
    const double across = std::sqrt(1 - u * u);
    add_surfel(scene, {range * across, range * u, 0}, {-1, 0, 0}, k % 5 == 0 ? 1e-4 : 1e-4 + 1e-5 * beside[0]);
  }
  return scene;
}

}  // namespace

TEST(SortByPlace, is_by_band_and_u_and_index) {
  const SceneCloud scene = crowded_scene(30000);
  const HeadFrame head(scene, Pose::Identity());
  std::vector<std::uint32_t> surfels;
  std::vector<std::uint16_t> pieces;
  for (std::uint32_t s = 1; s < scene.size(); s += 2)
    surfels.push_back(s), pieces.push_back(static_cast<std::uint16_t>(1 + s % 9));
  const PlacedSurfels by_u = sort_by_place(scene, head, gate_of_bands, SurfelOrder::range_and_u, surfels, pieces, 2);
  const PlacedSurfels by_band = sort_by_place(scene, head, gate_of_bands, SurfelOrder::range, surfels, pieces, 2);

  const auto band = [](const SurfelBounds& b) {
    return static_cast<int>(std::max(0.0, (b.range - gate_of_bands.min_range) / (64 * gate_of_bands.bin_size)));
  };
  ASSERT_EQ(by_u.surfel.size(), surfels.size());
  std::size_t same_u = 0;
  for (std::size_t k = 0; k + 1 < by_u.surfel.size(); ++k) {
    const auto key = [&](const PlacedSurfels& of, std::size_t at, bool with_u) {
      return std::tuple(band(of.bounds[at]), with_u ? of.bounds[at].u : 0.0, of.surfel[at]);
    };
    ASSERT_LT(key(by_u, k, true), key(by_u, k + 1, true)) << k;
    ASSERT_LT(key(by_band, k, false), key(by_band, k + 1, false)) << k;
    same_u += by_u.bounds[k].u == by_u.bounds[k + 1].u;
  }
  EXPECT_GT(same_u, 1000);
  EXPECT_EQ(band(by_u.bounds.front()), 0);
  EXPECT_GT(band(by_u.bounds.back()), 10);

  // Bounds and numbers of parts go with their surfel.
  for (std::size_t k = 0; k < by_u.surfel.size(); ++k) {
    const std::uint32_t s = by_u.surfel[k];
    ASSERT_EQ(by_u.pieces[k], 1 + s % 9);
    ASSERT_EQ(by_u.bounds[k].range, head.position_of(s).norm());
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/scene_cut.hpp"

#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

const Pose over_the_scene = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);

/// The region that a head of 64 beams of two degrees reaches, out to 20 m.
struct Reach {
  BeamFan fan = small_head({}).fan;
  RangeGate gate{0.5, 20, 0.05};
  InsonifiedRegion region;
  explicit Reach(const Pose& pose = over_the_scene) {
    fan.beam_width = radians(2);
    region.world_from_head = pose;
    region.sector = insonified_sector(fan, radians(20));
    region.gate = gate;
  }
};

SceneCut cut_of(const SceneCloud& scene, const Reach& reach = Reach(), int threads = 0) {
  return cut_scene(PreparedScene(scene, threads), reach.region, reach.fan, reach.gate, {0.5, 0, 0.1, threads});
}

double range_of(const SceneCloud& scene, std::size_t i, const Reach& reach) {
  return (scene.origin + scene.point[i].cast<double>() - reach.region.world_from_head.translation()).norm();
}

void expect_same(const SceneCloud& a, const SceneCloud& b) {
  EXPECT_TRUE(a.point == b.point && a.normal == b.normal && a.area == b.area && a.id == b.id &&
              a.unevenness == b.unevenness && a.material == b.material);
}

/// Returns the sum of the areas times cos^2 of incidence within fan and gate.
double lambert_sum(const SceneCloud& s, const Reach& reach) {
  const SectorBounds sector(reach.region.sector);
  const Pose head_from_world = reach.region.world_from_head.inverse();
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Eigen::Vector3d p = head_from_world * (s.origin + s.point[i].cast<double>());
    if (p.norm() > reach.gate.max_range || !sector.holds(p)) continue;
    sum += s.area[i] * std::pow((head_from_world.linear() * s.normal[i].cast<double>()).dot(p) / p.norm(), 2);
  }
  return sum;
}

}  // namespace

TEST(SceneCut, is_coarser_but_nowhere_wider_than_half_a_beam) {
  const SceneCloud scene = harbour(200000);
  const Reach reach;
  const SceneCut cut = cut_of(scene, reach);
  const SceneCloud& s = cut.scene.scene();
  std::size_t merged = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const float own = scene.area[cut.stands_for[i]];
    EXPECT_EQ(s.id[i], scene.id[cut.stands_for[i]]);
    EXPECT_EQ(s.material[i], scene.material[cut.stands_for[i]]);
    if (s.area[i] == own) continue;
    ++merged;
    // Lambert's law of a rough node at most doubles its area.
    EXPECT_LE(std::sqrt(s.area[i] / 2), 0.5 * reach.fan.beam_width * range_of(s, i, reach));
  }
  EXPECT_GT(merged, 1000U);
  EXPECT_EQ(s.part_of->surfels, scene.size());
  EXPECT_EQ(cut.scene.whole().mean_spacing, whole_of(scene).mean_spacing);
}

// The bound on the spread of normals is that of Lambert's law.
TEST(SceneCut, merges_no_surfels_of_another_law) {
  SceneCloud scene = harbour(100000);
  scene.materials[0].law = SeabedLaw{};
  const SceneCut cut = cut_of(scene);
  const SceneCloud& s = cut.scene.scene();
  std::size_t merged = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const bool alone = s.area[i] == scene.area[cut.stands_for[i]];
    EXPECT_TRUE(alone || s.material[i] != 0);
    merged += !alone;
  }
  EXPECT_GT(merged, 10U);
}

TEST(SceneCut, returns_as_much_by_lamberts_law_as_the_surfels_within_reach) {
  const SceneCloud scene = harbour(200000);
  const Reach reach;
  const SceneCut cut = cut_of(scene, reach);
  EXPECT_NEAR(lambert_sum(cut.scene.scene(), reach) / lambert_sum(scene, reach), 1, 1e-3);
  std::set<std::uint32_t> ids(cut.scene.scene().id.begin(), cut.scene.scene().id.end());
  EXPECT_EQ(ids.size(), cut.scene.scene().size());
}

TEST(SceneCut, of_the_surfels_within_reach_alone_is_the_same) {
  const SceneCloud scene = harbour(200000);
  const Reach reach;
  const float largest = whole_of(scene).largest_area;
  const auto within_reach = [&](const SceneCloud& s) {
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < s.size(); ++i)
      if (may_intersect(reach.region, s.origin + s.point[i].cast<double>(), 0, largest)) near.push_back(i);
    return subset(s, near);
  };
  SceneCloud part = within_reach(scene);
  ASSERT_LT(part.size(), scene.size() / 2);
  part.part_of = whole_of(scene);
  // Some surfels of the whole stand just beside the region.
  expect_same(within_reach(cut_of(part, reach).scene.scene()), within_reach(cut_of(scene, reach).scene.scene()));
}

TEST(SceneCut, does_not_depend_on_threads_or_where_scene_and_head_are) {
  SceneCloud scene = harbour(60000);
  const SceneCut here = cut_of(scene, Reach(), 1);
  expect_same(here.scene.scene(), cut_of(scene, Reach(), 3).scene.scene());
  const Eigen::Vector3d far(512345, 4.2e6, -32);
  scene.origin += far;
  Pose moved = over_the_scene;
  moved.pretranslate(far);
  expect_same(here.scene.scene(), cut_of(scene, Reach(moved)).scene.scene());
}

// A node that reaches across an end of the sampled ranges would be received as a whole or not at all.
TEST(SceneCut, no_node_reaches_across_the_ends_of_the_gate) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 300000, .size = {30, 30}});
  Reach reach(pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0));
  reach.gate.min_range = 10;
  const SceneCut cut = cut_of(plane, reach);
  const SceneCloud& s = cut.scene.scene();
  std::size_t near = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double radius = std::sqrt(s.area[i] / 2), off = std::abs(range_of(s, i, reach) - 10);
    const bool merged = s.area[i] > 1.5 * plane.area[cut.stands_for[i]];
    EXPECT_TRUE(!merged || off >= 0.75 * radius) << s.area[i];
    near += off < 0.1;
  }
  EXPECT_GT(near, 100U);
}

// At grazing incidence, a plane with the mean normal returns less than its surfels.
TEST(SceneCut, returns_as_much_as_the_surfels_of_rough_ground_by_lamberts_law) {
  SceneCloud rough = make_built_in_scene("plane", {.points = 300000, .size = {30, 30}});
  std::mt19937 random(5);
  std::normal_distribution<float> slope(0, 0.02F);
  for (Eigen::Vector3f& normal : rough.normal) normal = Eigen::Vector3f(slope(random), slope(random), 1).normalized();
  const Reach reach(Pose(Eigen::Translation3d(-15, 0, 1.5)));
  const SceneCut cut = cut_of(rough, reach);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < cut.stands_for.size(); ++i)
    merged += cut.scene.scene().area[i] > 1.5F * rough.area[cut.stands_for[i]];
  EXPECT_GT(4 * merged, cut.stands_for.size());
  EXPECT_NEAR(lambert_sum(cut.scene.scene(), reach) / lambert_sum(rough, reach), 1, 0.003);
}

// Rough ground hides parts of itself at grazing incidence, and errors of narrow nodes average out.
TEST(SceneCut, rough_ground_is_merged_in_narrow_nodes_and_where_the_head_looks_down_on_it) {
  SceneCloud rough = make_built_in_scene("plane", {.points = 1000000, .size = {8, 8}});
  std::mt19937 random(5);
  for (Eigen::Vector3f& normal : rough.normal) {  // slopes of 0.21: a mean square sine of 0.042
    const float turn = std::uniform_real_distribution<float>(0, 6.2831853F)(random);
    normal = Eigen::Vector3f(0.21F * std::cos(turn), 0.21F * std::sin(turn), 1).normalized();
  }
  // Shares of the merged area, in nodes of at least twelve surfels: of those narrower than a third of what is allowed,
  // and of wider ones.
  const auto shares = [&](const Pose& pose) {
    const Reach reach(pose);
    const SceneCut cut = cut_of(rough, reach);
    const SceneCloud& s = cut.scene.scene();
    double all = 0, narrow = 0, wide = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      all += s.area[i];
      if (s.area[i] < 12 * rough.area[cut.stands_for[i]]) continue;
      const double most = 0.5 * reach.fan.beam_width * range_of(s, i, reach);
      (std::sqrt(s.area[i]) < most / 3 ? narrow : wide) += s.area[i];
    }
    return std::pair(narrow / all, wide / all);
  };
  const auto from_above = shares(pose_from_yaw_pitch_roll({4, 0, 12}, 0, radians(90), 0)),
             at_grazing = shares(Pose(Eigen::Translation3d(-8, 0, 2)));
  EXPECT_GT(from_above.first, 0.5);
  EXPECT_LT(from_above.second, 0.01);
  EXPECT_LT(at_grazing.first + at_grazing.second, 0.05);
  // Squared cosines of 0.28 to 0.37, at which no relief turns away (E225).
  const auto slanting = shares(pose_from_yaw_pitch_roll({-13.6, 0, 10.5}, 0, radians(33), 0));
  EXPECT_LT(slanting.first + slanting.second, 0.05);
}

TEST(SceneCut, a_plane_in_which_the_head_lies_has_areas_above_zero) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 100000, .size = {30, 30}});
  for (const double height : {0.0, 1e-4}) {
    const Reach reach(Pose(Eigen::Translation3d(-5, 15, height)));
    const SceneCut cut = cut_of(plane, reach);
    EXPECT_LT(2 * cut.stands_for.size(), plane.size());
    for (const float area : cut.scene.scene().area) EXPECT_GT(area, 0);
  }
}

TEST(SceneCut, no_node_is_thicker_than_a_quarter_of_a_cell_of_range) {
  SceneCloud stairs = make_built_in_scene("plane", {.points = 300000, .size = {30, 30}});
  for (Eigen::Vector3f& p : stairs.point) p.z() += std::fmod(std::abs(p.x()), 0.4F) < 0.2F ? 0.004F : 0;
  const Reach reach(pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0));
  const PreparedScene scene(stairs);
  const auto size = [&](double range_resolution) {
    return cut_scene(scene, reach.region, reach.fan, reach.gate, {0.5, 0, range_resolution}).scene.scene().size();
  };
  EXPECT_LT(1.5 * static_cast<double>(size(0.1)), static_cast<double>(size(0.004)));
}

// A head that draws nearer resolves more, but nodes of one spacing stay what they are.
TEST(SceneCut, of_one_spacing_has_the_same_nodes_from_everywhere) {
  const SceneCloud scene = harbour(200000);
  const PreparedScene prepared(scene);
  const auto nodes_from = [&](double x, CutOptions options) {
    const Reach reach(pose_from_yaw_pitch_roll({x, 0, -3}, 0, radians(10), 0));
    options.range_resolution = 0.1;
    const SceneCut cut = cut_scene(prepared, reach.region, reach.fan, reach.gate, options);
    std::map<std::uint32_t, Eigen::Vector3f> nodes;
    for (std::size_t i = 0; i < cut.stands_for.size(); ++i) {
      const Eigen::Vector3f& p = cut.scene.scene().point[i];
      // Both heads reach this box at a distance from the ends of fan and gate.
      const bool common = p.x() > 12 && p.x() < 17 && std::abs(p.y()) < 5;
      if (common && p != scene.point[cut.stands_for[i]]) nodes[cut.stands_for[i]] = p;
    }
    return nodes;
  };
  const auto lost = [&](const CutOptions& options) {
    const auto far = nodes_from(0, options), near = nodes_from(1, options);
    EXPECT_GT(far.size(), 100U);
    return 1 - static_cast<double>(std::count_if(far.begin(), far.end(),
                                                 [&](const auto& node) {
                                                   const auto found = near.find(node.first);
                                                   return found != near.end() && found->second == node.second;
                                                 })) /
                   static_cast<double>(far.size());
  };
  EXPECT_LT(lost({.most_spacing = 0.3}), 0.01);
  EXPECT_GT(lost({.most_width = 0.5}), 0.1);
}

namespace {

/// A plate of 2 x 2 m, 5 m ahead of the origin and turned by 20 degrees about the vertical, and a wall 8 m ahead.
struct PlateBeforeAWall {
  static constexpr double side = 2;
  Eigen::Vector3d along{side * std::sin(radians(20.0)), side*std::cos(radians(20.0)), 0}, up{0, 0, side};
  Eigen::Vector3d corner = Eigen::Vector3d(5, 0, 0) - (along + up) / 2, normal = up.cross(along).normalized();
  SceneCloud scene;

  PlateBeforeAWall() {
    add_rectangle(scene, {8, -4, -1.5}, {0, 8, 0}, {0, 0, 3}, {-1, 0, 0}, 0.01);
    add_rectangle(scene, corner, along, up, normal, 0.01);
  }
  /// Returns the distance from the plate's outline of the direction to a position, in the plane of the plate [m].
  double from_outline(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d meets = position * corner.dot(normal) / position.dot(normal) - corner;
    const Eigen::Array2d at(meets.dot(along) / side, meets.dot(up) / side);
    const Eigen::Array2d beyond = (at - side / 2).abs() - side / 2;
    return beyond.maxCoeff() < 0 ? -beyond.maxCoeff() : beyond.max(0.0).matrix().norm();
  }
  /// Returns the numbers of a cut's nodes across the outline, of other nodes, and of surfels at the outline.
  std::array<std::size_t, 3> counted(const SceneCloud& of) const {
    const SceneCut cut = cut_of(of, Reach(Pose::Identity()));
    const SceneCloud& s = cut.scene.scene();
    std::array<std::size_t, 3> count{};
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Eigen::Vector3d position = world(s, i);
      const double scale = corner.dot(normal) / position.dot(normal), half = scale * std::sqrt(s.area[i]) / 2;
      if (s.area[i] > 1.5 * of.area[cut.stands_for[i]])
        ++count[from_outline(position) < 0.8 * half ? 0 : 1];
      else
        count[2] += from_outline(position) < half;
    }
    return count;
  }
};

}  // namespace

// A node is seen whole or not at all. Across the edge of what stands before it, half of it is hidden.
TEST(SceneCut, divides_nodes_at_silhouettes) {
  PlateBeforeAWall of;
  const auto [across, elsewhere, surfels] = of.counted(of.scene);
  EXPECT_EQ(across, 0U);
  EXPECT_GT(elsewhere, 800U);
  EXPECT_GT(surfels, 500U);
}

TEST(SceneCut, divides_nodes_of_scans_and_of_small_scenes) {
  PlateBeforeAWall of;
  of.scene.part_of = whole_of(of.scene);
  of.scene.part_of->surfels = 1 << 20;
  EXPECT_GT(of.counted(of.scene)[0], 40U);
  of.scene.noise.assign(of.scene.size(), 1e-4F);
  EXPECT_EQ(of.counted(of.scene)[0], 0U);
}

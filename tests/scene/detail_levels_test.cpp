// SPDX-License-Identifier: BSD-3-Clause
#include "scene/detail_levels.hpp"

#include "scene/built_in_scenes.hpp"
#include "scene/prepared_scene.hpp"
#include "support/test.hpp"

namespace {

DetailLevels levels_of(const SceneCloud& scene, int threads = 0) {
  return detail_levels(scene, whole_of(scene).mean_spacing, threads);
}

/// Returns the surfels below a root, node or child.
std::vector<std::uint32_t> surfels_below(const DetailLevels& levels, std::uint32_t index) {
  if (index < levels.surfels) return {index};
  std::vector<std::uint32_t> all;
  const DetailNode& node = levels.node[index - levels.surfels];
  for (std::uint32_t k = 0; k < node.children; ++k)
    for (const std::uint32_t i : surfels_below(levels, levels.child[node.first_child + k])) all.push_back(i);
  return all;
}

/// Adds a square grid of surfels, `spacing` apart, in the plane through `at` that is spanned by two unit vectors.
void add_grid(SceneCloud& scene, const Eigen::Vector3d& at, const Eigen::Vector3d& right, const Eigen::Vector3d& up,
              int across, int along, double spacing, std::uint16_t material = 0) {
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j)
      add_surfel(scene, at + spacing * ((i + 0.5) * right + (j + 0.5) * up), right.cross(up), spacing * spacing,
                 material);
}

const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX(), aside = Eigen::Vector3d::UnitY(),
                      aloft = Eigen::Vector3d::UnitZ();

std::size_t nodes_of(const SceneCloud& scene) { return levels_of(scene).node.size(); }

/// Returns the area of the largest node [m^2].
double largest_node(const SceneCloud& scene) {
  double largest = 0;
  for (const DetailNode& node : levels_of(scene).node) largest = std::max<double>(largest, node.area);
  return largest;
}

}  // namespace

TEST(DetailLevels, hold_every_surfel_once_within_blocks_and_nodes) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 40000});
  const DetailLevels levels = levels_of(scene);
  std::vector<int> times(scene.size(), 0);
  std::uint32_t end = 0;
  for (const DetailBlock& block : levels.block) {
    EXPECT_EQ(block.begin, end);
    end = block.end;
    for (std::uint32_t k = block.begin; k < block.end; ++k)
      for (const std::uint32_t i : surfels_below(levels, levels.root[k])) {
        ++times[i];
        ASSERT_LE((scene.point[i] - block.centre).norm(), block.radius);
      }
  }
  EXPECT_EQ(end, levels.root.size());
  EXPECT_THAT(times, testing::Each(1));
  EXPECT_LT(levels.root.size(), scene.size() / 4);
}

// In a view from one position noise is raised where lines of sight pass an edge: nodes do not spread it, and do not lose
// it.
TEST(DetailLevels, keep_surfels_of_uneven_noise_apart) {
  SceneCloud scene;
  add_grid(scene, {0, 0, 0}, ahead, aside, 64, 64, 0.01);
  scene.noise.assign(scene.size(), 0.001F);
  const std::size_t even = levels_of(scene).root.size();
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (i % 64 < 5) scene.noise[i] = 0.2F;  // a strip
  const DetailLevels levels = levels_of(scene);
  std::size_t raised = 0;
  for (std::uint32_t n = 0; n < levels.node.size(); ++n) {
    const DetailNode& node = levels.node[n];
    float most = 0;
    for (const std::uint32_t i : surfels_below(levels, static_cast<std::uint32_t>(levels.surfels + n)))
      most = std::max(most, scene.noise[i]);
    EXPECT_GE(node.noise, 0.8F * most - 0.003F * std::sqrt(node.area));
    raised += most > 0.1F;
  }
  EXPECT_GT(raised, 50U);                         // they do merge with each other
  EXPECT_LT(levels.root.size(), 3 * even + 300);  // and so does the rest
}

TEST(DetailLevels, nodes_are_the_means_of_their_surfels) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 40000});
  const DetailLevels levels = levels_of(scene);
  ASSERT_GT(levels.node.size(), 5000U);
  for (std::uint32_t n = 0; n < levels.node.size(); n += 7) {
    const DetailNode& node = levels.node[n];
    Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = point;
    double area = 0, along = 0;
    float nearest = std::numeric_limits<float>::infinity();
    const auto surfels = surfels_below(levels, static_cast<std::uint32_t>(levels.surfels + n));
    for (const std::uint32_t i : surfels) {
      const double a = scene.area[i];
      area += a, point += a * scene.point[i].cast<double>(), normal += a * scene.normal[i].cast<double>();
      EXPECT_EQ(scene.material[i], node.material);
      const Eigen::Vector3f away = scene.point[i] - node.point;
      EXPECT_LE(away.norm() + std::sqrt(a / 2), node.extent * 1.0001);
      nearest = std::min(nearest, away.norm());
    }
    EXPECT_NEAR(node.area, area, 1e-5 * area);
    EXPECT_LT((node.point.cast<double>() - point / area).norm(), 1e-4 * node.extent + 1e-5);
    EXPECT_LT((node.normal.cast<double>() - normal.normalized()).norm(), 1e-5);
    const Eigen::Vector3d direction = Eigen::Vector3d(2, -3, 6) / 7;
    for (const std::uint32_t i : surfels)
      along += scene.area[i] * std::pow(scene.normal[i].cast<double>().dot(direction), 2) / area;
    EXPECT_NEAR(quadratic_form(node.normals, direction), along, 1e-6);
    // For a node of nodes it is the nearest of the children's.
    EXPECT_LE((scene.point[node.nearest] - node.point).norm(), node.extent);
  }
}

TEST(DetailLevels, nodes_are_as_thick_as_their_children_lie_off_the_plane) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 40000});
  const DetailLevels levels = levels_of(scene);
  for (const DetailNode& node : levels.node) {
    float thickness = 0;
    for (std::uint32_t k = node.first_child; k < node.first_child + node.children; ++k) {
      const std::uint32_t child = levels.child[k];
      const DetailNode* const below = child < levels.surfels ? nullptr : &levels.node[child - levels.surfels];
      const Eigen::Vector3f away = (below ? below->point : scene.point[child]) - node.point;
      thickness = std::max(thickness, std::abs(away.dot(node.normal)) + (below ? below->thickness : 0));
    }
    ASSERT_FLOAT_EQ(node.thickness, thickness);
    ASSERT_LE(node.thickness, 0.1F * node.extent);
  }
}

TEST(DetailLevels, squares_of_an_even_plane_are_nodes_of_four) {
  SceneCloud plane;
  add_grid(plane, {0, 0, 0.01}, ahead, aside, 64, 64, 1.0 / 16);
  const DetailLevels levels = levels_of(plane);
  EXPECT_EQ(levels.root.size(), 1U);
  EXPECT_EQ(levels.node.size(), 1024U + 256 + 64 + 16 + 4 + 1);
  for (const DetailNode& node : levels.node) {
    EXPECT_EQ(node.children, 4);
    EXPECT_NEAR(node.extent * node.extent, node.area / 2, 1e-5);
    EXPECT_NEAR(quadratic_form(node.normals, node.normal.cast<double>()), 1, 1e-6);
  }
}

TEST(DetailLevels, what_is_no_compact_flat_piece_of_one_material_merges_in_pairs_at_most) {
  const double s = 1.0 / 16;
  SceneCloud line, net, materials, gap, rod;
  add_grid(line, {0, 0, 0.01}, ahead, aside, 64, 1, s);
  for (int k = 0; k < 16; ++k) add_grid(net, {0, k * 4 * s, 0.01}, ahead, aside, 64, 1, s);
  materials.materials.resize(2);
  for (int k = 0; k < 32; ++k)
    add_grid(materials, {0, k * s, 0.01}, ahead, aside, 32, 1, s, static_cast<std::uint16_t>(k % 2));
  add_grid(gap, {0, 0, 0.01}, ahead, aside, 1, 1, s), add_grid(gap, {0.7, 0.7, 0.01}, ahead, aside, 1, 1, s);
  for (int k = 0; k < 8; ++k) {  // a rod as thick as its surfels are wide
    const double turn = k * std::numbers::pi / 4;
    const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
    for (int j = 0; j < 64; ++j) add_surfel(rod, s / 2 * out + (j + 0.5) * s * aloft, out, s * s * 0.4);
  }
  EXPECT_LE(largest_node(line), 2.001 * s * s);
  EXPECT_LE(largest_node(net), 2.001 * s * s);
  EXPECT_LE(largest_node(materials), 2.001 * s * s);
  EXPECT_EQ(nodes_of(gap), 0U);
  EXPECT_EQ(nodes_of(rod), 0U);
}

TEST(DetailLevels, both_faces_of_a_plate_and_sheets_one_behind_the_other_stay_apart) {
  SceneCloud plate, sheets;
  const double s = 1.0 / 16;
  add_grid(plate, {0, 0, 0.5}, ahead, aside, 32, 32, s), add_grid(plate, {0, 0, 0.499}, aside, ahead, 32, 32, s);
  for (const DetailNode& node : levels_of(plate).node) EXPECT_EQ(std::abs(node.normal.z()), 1);
  EXPECT_EQ(levels_of(plate).root.size(), 2U);
  // Two sheets a millimetre apart have twice the area of one piece.
  add_grid(sheets, {0, 0, 0.5}, ahead, aside, 32, 32, s), add_grid(sheets, {0, 0, 0.501}, ahead, aside, 32, 32, s);
  EXPECT_EQ(nodes_of(sheets), 0U);
}

TEST(DetailLevels, without_sides_normals_may_have_either_sign) {
  SceneCloud plane;
  add_grid(plane, {0, 0, 0.01}, ahead, aside, 32, 32, 1.0 / 16);
  for (std::size_t i = 0; i < plane.size(); i += 2) plane.normal[i] *= -1;
  const std::size_t with_sides = nodes_of(plane);
  plane.normals_oriented = false;
  const DetailLevels levels = levels_of(plane);
  EXPECT_EQ(levels.root.size(), 1U);
  EXPECT_NEAR(quadratic_form(levels.node.back().normals, levels.node.back().normal.cast<double>()), 1, 1e-6);
  EXPECT_NE(levels.node.size(), with_sides);
}

TEST(DetailLevels, surfels_in_one_point_strays_and_all_spacings_do_not_break_them) {
  SceneCloud heap;
  for (int i = 0; i < 300; ++i) add_surfel(heap, {1, 2, 3}, aloft, 1e-4);
  EXPECT_EQ(nodes_of(heap), 0U);
  SceneCloud mixed = make_built_in_scene("harbour", {.points = 5000});
  for (const double far : {1e5, -3e6, 1e9}) add_surfel(mixed, {far, far, far}, aloft, 1e6);
  add_grid(mixed, {0, 0, -2}, ahead, aside, 50, 50, 1e-3);
  const DetailLevels levels = levels_of(mixed);
  std::size_t surfels = 0;
  for (const std::uint32_t root : levels.root) surfels += surfels_below(levels, root).size();
  EXPECT_EQ(surfels, mixed.size());
  EXPECT_TRUE(levels_of({}).root.empty());
  SceneCloud no_area;
  for (int i = 0; i < 10; ++i) add_surfel(no_area, {0.01 * i, 0, 0}, aloft, 0);
  EXPECT_EQ(levels_of(no_area).root.size(), 10U);
}

TEST(DetailLevels, do_not_depend_on_threads) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 60000});
  const DetailLevels one = levels_of(scene, 1), three = levels_of(scene, 3);
  EXPECT_EQ(one.root, three.root);
  EXPECT_EQ(one.child, three.child);
  ASSERT_EQ(one.node.size(), three.node.size());
  for (std::size_t n = 0; n < one.node.size(); ++n) EXPECT_EQ(one.node[n].point, three.node[n].point);
}

TEST(DetailLevels, refuse_facets) {
  SceneCloud scene;
  scene.facet.push_back({ahead.cast<float>(), aside.cast<float>(), aloft.cast<float>()});
  EXPECT_THAT(error_of([&] { detail_levels(scene, 1); }, ErrorKind::argument), HasSubstr("must be discs"));
}

// SPDX-License-Identifier: BSD-3-Clause
// Clouds that are rasters of heights become surfaces of triangles.
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "scene_io/load_scene.hpp"
#include "support/files.hpp"
#include "support/height_field.hpp"

using namespace insonify;

namespace {

constexpr double half_side = 1, spacing = 0.1;  // 21 x 21 nodes

double wave(double x, double y) { return 0.2 * std::sin(3 * x) * std::cos(2 * y); }

LoadedScene loaded_from(const std::string& points, const LoadOptions& options = {}) {
  return load_scene(own_file("raster.xyz", points), options);
}
std::string raster() { return points_of(height_field({5, -3}, half_side, spacing, wave)); }

// Returns the points of `text` that `keep(row, column)` selects, moved by `change`.
template <typename Keep, typename Change>
std::string changed(const std::string& text, Keep&& keep, Change&& change) {
  std::istringstream in(text);
  std::ostringstream out;
  Eigen::Vector3d p;
  for (int i = 0; in >> p.x() >> p.y() >> p.z(); ++i)
    if (keep(i / 21, i % 21)) {
      change(p);
      out << p.transpose() << '\n';
    }
  return out.str();
}
bool all(int, int) { return true; }
void nothing(const Eigen::Vector3d&) {}

double area_of_mesh(const SceneMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) sum += area_of(corners_of(mesh, t));
  return sum;
}

double height_of_normal(const SceneMesh& mesh, std::size_t t) {
  const auto [a, b, c] = corners_of(mesh, t);
  return (b - a).cross(c - a).z();
}

}  // namespace

TEST(Raster, has_two_triangles_in_each_cell_and_keeps_its_points) {
  const LoadedScene loaded = loaded_from(raster());
  ASSERT_TRUE(loaded.mesh);
  EXPECT_EQ(loaded.scene.size(), 441u);
  EXPECT_EQ(loaded.mesh->triangle.size(), 800u);
  EXPECT_NE(loaded.report.format.find("raster of heights"), std::string::npos);
  double plan = 0;
  for (std::size_t t = 0; t < 800; ++t) plan += height_of_normal(*loaded.mesh, t) / 2;
  EXPECT_NEAR(plan, 4, 1e-5);
  EXPECT_TRUE(loaded.mesh->normals_oriented);
}

TEST(Raster, is_cut_along_the_shorter_diagonals_of_its_cells) {
  // Level on one side of y = x, rising on the other.
  const auto bent = [](double x, double y) { return std::max(0.0, x - y); };
  const LoadedScene loaded = loaded_from(points_of(height_field({0, 0}, half_side, spacing, bent)));
  ASSERT_TRUE(loaded.mesh);
  EXPECT_NEAR(area_of_mesh(*loaded.mesh), 2 + 2 * std::sqrt(3), 1e-4);
}

TEST(Raster, may_have_cells_of_any_shape) {
  const std::string wide = changed(raster(), all, [](Eigen::Vector3d& p) { p.x() *= 3; });
  ASSERT_TRUE(loaded_from(wide).mesh);
  EXPECT_EQ(loaded_from(wide).mesh->triangle.size(), 800u);
}

TEST(Raster, has_holes_where_nodes_are_missing) {
  const auto keep = [](int row, int column) { return !(row == 5 && column == 7) && !(row == 0 && column == 0); };
  const LoadedScene loaded = loaded_from(changed(raster(), keep, nothing));
  ASSERT_TRUE(loaded.mesh);
  // One triangle is left of each cell round the missing node, and of that of the corner.
  EXPECT_EQ(loaded.mesh->triangle.size(), 800u - 4 - 1);
}

TEST(Raster, faces_the_viewpoint) {
  for (const double height : {10.0, -10.0}) {
    LoadOptions seen;
    seen.viewpoint = Eigen::Vector3d(5, -3, height);
    const LoadedScene loaded = loaded_from(raster(), seen);
    ASSERT_TRUE(loaded.mesh);
    EXPECT_TRUE(loaded.mesh->normals_oriented);
    for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t)
      EXPECT_GT(height_of_normal(*loaded.mesh, t) * height, 0);
  }
}

TEST(Raster, is_not_seen_in_clouds_off_a_grid_or_with_two_heights_at_a_node) {
  const auto is_raster = [](const std::string& points) {
    return loaded_from(points).report.format.find("raster of heights") != std::string::npos;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const std::string jittered =
      changed(raster(), all, [&](Eigen::Vector3d& p) { p.x() += 0.2 * spacing * uniform(random); });
  EXPECT_FALSE(is_raster(jittered));
  EXPECT_TRUE(loaded_from(jittered).mesh);  // of another kind
  const std::string uneven = changed(raster(), all, [](Eigen::Vector3d& p) {
    if (std::abs(p.x() - 5) < 0.1 * spacing) p.x() += 0.1 * spacing;  // one column
  });
  EXPECT_FALSE(is_raster(uneven));
  const std::string above = raster() + changed(raster(), all, [](Eigen::Vector3d& p) { p.z() += 5; });
  EXPECT_FALSE(loaded_from(above).mesh);
  const auto lifted = [](Eigen::Vector3d& p) { p.z() += 1e-6; };
  EXPECT_FALSE(is_raster(raster() + changed(raster(), all, lifted)));
  LoadOptions even;
  even.mesh_spacing = spacing;
  EXPECT_FALSE(loaded_from(raster(), even).mesh);
}

TEST(Raster, with_noise_has_smooth_heights_where_its_points_stand) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.5 * spacing);
  const LoadedScene loaded = loaded_from(changed(raster(), all, [&](Eigen::Vector3d& p) { p.z() += noise(random); }));
  ASSERT_TRUE(loaded.mesh);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const Eigen::Vector3d p = loaded.scene.origin + loaded.scene.point[i].cast<double>();
    EXPECT_EQ(loaded.mesh->point[i].head<2>(), loaded.scene.point[i].head<2>());
    before += std::pow(p.z() - wave(p.x(), p.y()), 2);
    after += std::pow(loaded.scene.origin.z() + loaded.mesh->point[i].z() - wave(p.x(), p.y()), 2);
  }
  EXPECT_LT(after, 0.3 * before);
}

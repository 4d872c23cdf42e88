// SPDX-License-Identifier: BSD-3-Clause
// Rough ground at grazing angles: pings of clouds drawn from generated beds against their triangles, facet by facet
// with an exact walk of every line of sight. tests/benchmarks/accuracy/exact_height_field.cpp prints the same for
// larger ones.
#include <cmath>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/files.hpp"
#include "support/heads.hpp"
#include "support/rough_field.hpp"
#include "support/scene_for_ping.hpp"

using namespace insonify;

namespace {

constexpr Eigen::Index groups = 4, bands = 5;

const SonarHead& head() {
  static const SonarHead made = small_head({.beams = 96, .min_range = 0.6, .max_range = 3.1});
  return made;
}
// Returns a pose 0.5 m above the bed, with about 10 degrees of grazing at the far end.
Pose pose() { return pose_from_yaw_pitch_roll({-1.6, 0, 0.75}, 0, radians(12), 0); }

const HeightField& bed() {
  static const HeightField field = rough_field({.half = 1.5, .shortest = 0.12, .boulders = 2, .terraces = false});
  return field;
}

LoadOptions from_above() {
  LoadOptions load;
  load.viewpoint = Eigen::Vector3d(0, 0, 1000);
  return load;
}
LoadedScene drawn(const DrawOptions& draw, const LoadOptions& load = from_above()) {
  return load_scene(own_file("bed.xyz", text_of(draw_points(bed(), draw))), load);
}

Grid<double> truth(const HeightField& field, bool occlusion = true, const Pose& from = pose()) {
  return energy_by_definition(field, Material{}.lambert_mu, head(), from, medium_of(Water{}, 450e3), 2, groups, bands,
                              occlusion);
}
const Grid<double>& truth_of_bed() {
  static const Grid<double> energy = truth(bed());
  return energy;
}

Grid<double> energy(const LoadedScene& loaded, SamplingKind kind = SamplingKind::surfels, const Pose& from = pose()) {
  SimulationOptions options;
  options.synthesis.method = SynthesisMethod::incoherent;
  options.sampling.kind = kind;
  options.sampling.rays_per_beam = 2048;
  const SceneCloud scene = scene_for_ping(loaded, head(), from, options);
  return energy_of(simulate_ping(scene, head(), from, {}, options).ping.pressure, groups, bands);
}

double ratio_db(double a, double b) { return db_from_power(a / b); }

void expect_levels(const Grid<double>& found, const Grid<double>& wanted, double total, double band) {
  EXPECT_NEAR(ratio_db(found.sum(), wanted.sum()), 0, total);
  const double strongest = wanted.colwise().sum().maxCoeff();
  for (Eigen::Index n = 0; n < bands; ++n) {
    if (wanted.col(n).sum() < 1e-3 * strongest) continue;
    EXPECT_NEAR(ratio_db(found.col(n).sum(), wanted.col(n).sum()), 0, band) << "band " << n;
  }
}

// Returns the energy of surfels wrongly hidden less that of those wrongly shown, by band, as fractions of the visible
// energy.
Grid<double> net_hidden(const LoadedScene& loaded) {
  SimulationOptions options;
  options.sampling.scatterers_per_cell = 0;
  const SceneCloud scene = scene_for_ping(loaded, head(), pose(), options);
  SamplingOptions sampling = resolve_ping(whole_of(scene), head(), {pose()}, {}, options).view.sampling;
  const Scatterers seen = find_scatterers(scene, pose(), head().fan, head().gate, sampling).scatterers;
  sampling.occlusion = false;
  const Scatterers all = find_scatterers(scene, pose(), head().fan, head().gate, sampling).scatterers;
  std::vector<double> shown(scene.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) shown[seen.surfel[i]] = 1;
  Grid<double> net = Grid<double>::Zero(1, bands), to_see = net;
  const Medium medium = medium_of(Water{}, 450e3);
  for (std::size_t i = 0; i < all.size(); i += 5) {
    Eigen::Vector3d position = scene.origin + scene.point[all.surfel[i]].cast<double>();
    position.z() = bed().at(position.head<2>());
    if (!std::isfinite(position.z()) || !(all.projected_area[i] > 0)) continue;
    const double beam_azimuth =
        heard_by_definition(all.range[i] * unit_vector({all.azimuth[i], all.elevation[i]}), all.cos_incidence[i],
                            all.projected_area[i] / all.cos_incidence[i], 1, head(), medium);
    const auto band = std::min(bands - 1, static_cast<Eigen::Index>((all.range[i] - 0.6) / 2.5 * bands));
    const bool open = bed().in_view(position, pose().translation());
    to_see(band) += open ? beam_azimuth : 0;
    net(band) += beam_azimuth * ((open ? 1 : 0) - shown[all.surfel[i]]);
  }
  return net / to_see;
}

std::string note_of(const LoadReport& report) {
  std::string all;
  for (const std::string& note : report.notes) all += note + "\n";
  return all;
}

// Writes the triangles of the bed as a file, which is no raster.
std::string mesh_file(const HeightField& field) {
  std::ostringstream text;
  text.precision(9);
  std::size_t corners = 0;
  for (Eigen::Index j = 0; j + 1 < field.z.rows(); ++j)
    for (Eigen::Index i = 0; i + 1 < field.z.cols(); ++i)
      for (const HeightField::Triangle& t : field.triangles(j, i)) {
        for (const Eigen::Vector3d& corner : t) text << "v " << corner.transpose() << '\n';
        text << "f " << corners + 1 << ' ' << corners + 2 << ' ' << corners + 3 << '\n';
        corners += 3;
      }
  return own_file("bed.obj", text.str());
}

}  // namespace

TEST(RoughGround, hides_much_of_what_would_be_heard) {
  EXPECT_LT(ratio_db(truth_of_bed().rightCols(2).sum(), truth(bed(), false).rightCols(2).sum()), -0.5);
}

TEST(RoughGround, is_heard_as_it_is_from_a_raster_a_mesh_and_points_anywhere) {
  const LoadedScene raster = drawn({}), mesh = load_scene(mesh_file(bed())), jittered = drawn({.jitter = 0.35});
  expect_levels(energy(raster), truth_of_bed(), 0.05, 0.15);
  expect_levels(energy(mesh), truth_of_bed(), 0.05, 0.15);
  expect_levels(energy(jittered), truth_of_bed(), 0.1, 0.3);
  expect_levels(energy(drawn({.stretch = 5})), truth_of_bed(), 0.1, 0.3);
}

TEST(RoughGround, is_hidden_wrongly_no_more_than_it_is_shown_wrongly) {
  EXPECT_LT(net_hidden(drawn({})).abs().maxCoeff(), 0.001);
  EXPECT_LT(net_hidden(load_scene(mesh_file(bed()))).abs().maxCoeff(), 0.001);
  EXPECT_LT(net_hidden(drawn({.jitter = 0.35})).abs().maxCoeff(), 0.03);
}

TEST(RoughGround, with_noise_is_heard_as_the_surface_behind_it) {
  expect_levels(energy(drawn({.noise = 0.25})), truth_of_bed(), 0.1, 0.3);
  expect_levels(energy(drawn({.jitter = 0.35, .noise = 0.25})), truth_of_bed(), 0.1, 0.3);
}

// The surface of noisy points is that of smoothed heights, which lose as much slope of what is finer than the noise as
// noise adds.
TEST(RoughGround, with_noise_of_a_spacing_is_as_rough_as_it_is) {
  for (const DrawOptions& draw : {DrawOptions{.noise = 1}, DrawOptions{.jitter = 0.35, .noise = 1}})
    expect_levels(energy(drawn(draw)), truth_of_bed(), 0.1, 0.3);
  expect_levels(energy(drawn({.stretch = 5, .noise = 0.5})), truth_of_bed(), 0.2, 0.3);
}

TEST(RoughGround, is_heard_as_it_is_by_a_head_5_cm_above_it_at_a_degree_of_grazing) {
  const HeightField smooth = rough_field({.half = 1.5, .shortest = 0.5, .boulders = 0, .terraces = false});
  const Eigen::Vector2d position(-1.3, 0.2);
  const Pose low = pose_from_yaw_pitch_roll({position.x(), position.y(), smooth.at(position) + 0.05}, 0, radians(1), 0);
  const LoadedScene raster = load_scene(own_file("low.xyz", text_of(draw_points(smooth))), from_above());
  const LoadedScene points =
      load_scene(own_file("low.xyz", text_of(draw_points(smooth, {.jitter = 0.35}))), from_above());
  const Grid<double> wanted = truth(smooth, true, low);
  expect_levels(energy(raster, SamplingKind::surfels, low), wanted, 0.1, 0.3);
  expect_levels(energy(points, SamplingKind::surfels, low), wanted, 0.1, 0.3);
}

TEST(RoughGround, finer_than_the_spacing_of_its_points_is_heard_as_what_they_show) {
  const DrawOptions coarse{.spacing = 0.1};
  const LoadedScene loaded = drawn(coarse);
  HeightField shown = rough_field({.half = 1.5, .spacing = 0.1, .boulders = 2, .terraces = false});
  expect_levels(energy(loaded), truth(shown), 0.1, 0.3);
}

TEST(RoughGround, with_holes_is_heard_without_them) {
  const HeightField open = with_holes(bed(), 0.12, 2);
  for (const double jitter : {0.0, 0.35}) {
    const std::string points = text_of(draw_points(open, {.jitter = jitter}));
    expect_levels(energy(load_scene(own_file("open.xyz", points), from_above())), truth(open), 0.1, 0.3);
  }
}

TEST(RoughGround, is_met_by_rays_where_it_is) {
  expect_levels(energy(drawn({}), SamplingKind::rays), truth_of_bed(), 0.05, 0.2);
}

TEST(RoughGround, sampled_evenly_is_heard_as_it_is) {
  LoadOptions even = from_above();
  even.mesh_spacing = 0.01;
  const LoadedScene loaded = drawn({}, even);
  EXPECT_FALSE(loaded.mesh);
  const double wanted = std::accumulate(loaded.scene.area.begin(), loaded.scene.area.end(), 0.0) / 1e-4;
  EXPECT_NEAR(static_cast<double>(loaded.scene.size()) / wanted, 1, 0.3);
  expect_levels(energy(loaded), truth_of_bed(), 0.05, 0.15);
}

// A prepared file is pinged like the file that prepare read, to the last bit.
TEST(RoughGround, is_the_same_after_it_was_prepared) {
  const std::pair<DrawOptions, std::string> cases[] = {
      {{}, "raster.ply"}, {{}, "raster.pcd"}, {{.jitter = 0.35}, "points.ply"}, {{.noise = 0.25}, "noisy.ply"}};
  for (const auto& [draw, name] : cases) {
    const LoadedScene loaded = drawn(draw);
    save_scene(own_path(name), loaded);
    const LoadedScene again = load_scene(own_path(name));
    ASSERT_TRUE(again.mesh) << name;
    EXPECT_EQ(again.mesh->triangle, loaded.mesh->triangle) << name;
    EXPECT_EQ((energy(again) == energy(loaded)).all(), true) << name;
  }
  LoadOptions from_below;
  from_below.viewpoint = Eigen::Vector3d(0, 0, -1000);
  const LoadedScene roof = drawn({}, from_below);
  save_scene(own_path("roof.ply"), roof);
  EXPECT_EQ(load_scene(own_path("roof.ply")).mesh.value().triangle, roof.mesh.value().triangle);
  const LoadedScene mesh = load_scene(mesh_file(bed()));
  save_scene(own_path("mesh.ply"), mesh);
  const LoadedScene again = load_scene(own_path("mesh.ply"));
  ASSERT_TRUE(again.mesh);
  EXPECT_EQ(again.mesh->triangle, mesh.mesh->triangle);
  EXPECT_EQ((energy(again) == energy(mesh)).all(), true);
  save_scene(own_path("mesh.pcd"), mesh);
  EXPECT_FALSE(load_scene(own_path("mesh.pcd")).mesh);
}

// A prepared PLY says which points are neighbours, so that nothing is joined again; one without faces is joined as
// ever.
TEST(RoughGround, that_was_prepared_keeps_its_triangles_in_the_file) {
  const LoadedScene loaded = drawn({.jitter = 0.35});
  save_scene(own_path("bed.ply"), loaded);
  const std::string bytes = file_bytes(own_path("bed.ply")), all = std::to_string(loaded.mesh->triangle.size());
  const std::string half = replaced(bytes, "element face " + all, "element face " + std::to_string(1000));
  const LoadedScene some =
      load_scene(own_file("some.ply", half.substr(0, half.size() - 13 * (loaded.mesh->triangle.size() - 1000))));
  ASSERT_TRUE(some.mesh);
  EXPECT_EQ(some.mesh->triangle, std::vector(loaded.mesh->triangle.begin(), loaded.mesh->triangle.begin() + 1000));
  EXPECT_EQ(some.scene.size(), loaded.scene.size());

  SceneCloud points = loaded.scene;
  points.point = loaded.mesh->point;
  save_scene(own_path("points.ply"), points, loaded.columns);
  EXPECT_EQ(file_bytes(own_path("points.ply")).find("element face"), std::string::npos);
  EXPECT_EQ(load_scene(own_path("points.ply")).mesh.value().triangle, loaded.mesh->triangle);
}

// Normals of a file that are smoother than the facets between its points, here those across two spacings, hold nothing
// that the points do not: its triangles scatter with their own. Normals of what is finer than the spacing say how the
// surface scatters, while where it stands and what it hides is that of its triangles.
TEST(RoughGround, with_normals_of_its_own_has_them_unless_they_are_smoother_than_its_facets) {
  const std::string head = "x y z nx ny nz\n";
  std::string smooth = head, rippled = head, fallen = head;
  double tilt = 0;
  for (const Eigen::Vector3d& p : draw_points(bed())) {
    const auto slope = [&](const Eigen::Vector2d& step) {
      const auto at = [&](const Eigen::Vector2d& q) { return bed().at(q.cwiseMax(-1.499).cwiseMin(1.499)); };
      return (at(p.head<2>() + step) - at(p.head<2>() - step)) / (2 * step.norm());
    };
    const Eigen::Vector3d normal(-slope({0.01, 0}), -slope({0, 0.01}), 1);
    const auto add = [&](const Eigen::Vector3d& n, std::string& text) {
      text += text_of({p}), text.back() = ' ', text += text_of({n.normalized()});
    };
    tilt += 2.4;
    add(normal, smooth);
    add(normal + Eigen::Vector3d(std::sin(tilt), std::cos(tilt), 0), rippled);
    add({1, 0, 0}, fallen);
  }
  const LoadedScene as_facets = load_scene(own_file("bed.xyz", smooth));
  ASSERT_TRUE(as_facets.mesh);
  EXPECT_TRUE(as_facets.mesh->normal.empty());
  EXPECT_NE(note_of(as_facets.report).find("the normals are smoother than the surface"), std::string::npos);
  expect_levels(energy(as_facets), truth_of_bed(), 0.05, 0.15);

  const LoadedScene as_given = load_scene(own_file("rippled.xyz", rippled));
  ASSERT_TRUE(as_given.mesh);
  EXPECT_EQ(as_given.mesh->normal, as_given.scene.normal);
  EXPECT_FALSE(load_scene(own_file("fallen.xyz", fallen)).mesh);

  for (const LoadedScene* loaded : {&as_facets, &as_given}) {
    save_scene(own_path("bed.ply"), *loaded);
    const LoadedScene again = load_scene(own_path("bed.ply"));
    ASSERT_TRUE(again.mesh);
    EXPECT_EQ(again.mesh->normal, loaded->mesh->normal);
    EXPECT_EQ((energy(again) == energy(*loaded)).all(), true);
  }
}

TEST(RoughGround, is_no_height_field_where_walls_stand_on_it_or_surfaces_lie_above_each_other) {
  std::vector<Eigen::Vector3d> points = draw_points(bed(), {.jitter = 0.35});
  const std::size_t one = points.size();
  for (std::size_t i = 0; i < one; ++i) points.push_back(points[i] + Eigen::Vector3d(0.004, 0.003, 0.8));
  EXPECT_FALSE(load_scene(own_file("twice.xyz", text_of(points)), from_above()).mesh);
}

// A viewpoint says which side of a surface reflects, and nothing about its shape.
TEST(RoughGround, is_the_same_surface_whatever_the_viewpoint) {
  LoadOptions from_a_side, from_nowhere;
  from_a_side.viewpoint = Eigen::Vector3d(-3, 0, 1);
  const LoadedScene seen = drawn({.jitter = 0.35}, from_a_side), above = drawn({.jitter = 0.35}),
                    unknown = drawn({.jitter = 0.35}, from_nowhere);
  ASSERT_TRUE(seen.mesh && above.mesh && unknown.mesh);
  EXPECT_EQ(seen.mesh->triangle, above.mesh->triangle);
  EXPECT_EQ(seen.mesh->triangle, unknown.mesh->triangle);
  EXPECT_EQ(seen.scene.area, above.scene.area);
  EXPECT_EQ(seen.scene.area, unknown.scene.area);
  EXPECT_EQ(seen.mesh->point, above.mesh->point);
  EXPECT_TRUE(seen.scene.normals_oriented && !unknown.scene.normals_oriented);
}

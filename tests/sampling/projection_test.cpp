// SPDX-License-Identifier: BSD-3-Clause
// Compares KD-trees, raster and prepared scenes with brute force: the same bytes at different cost.
#include "sampling_scenes.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/thin_scene.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

struct Position {
  std::string name;
  SceneCloud scene;
  Pose pose = Pose::Identity();
  BeamFan fan = wide_fan();
  bool hides_something = true;
};

void punch_hole(SceneCloud& scene, double half_width) {
  std::vector<std::uint32_t> keep;
  for (std::uint32_t i = 0; i < scene.size(); ++i)
    if (std::max(std::abs(scene.point[i].y()), std::abs(scene.point[i].z())) > half_width) keep.push_back(i);
  scene = subset(scene, keep);
}

void add_pole(SceneCloud& scene, double x, double y, double radius, double spacing) {
  const int around = static_cast<int>(2 * pi * radius / spacing);
  for (double z = -1.5; z < 1.5; z += spacing)
    for (int k = 0; k < around; ++k) {
      const Vector3d d(std::cos(2 * pi * k / around), std::sin(2 * pi * k / around), 0);
      add_surfel(scene, Vector3d(x, y, z) + radius * d, d, 2 * pi * radius / around * spacing);
    }
}

std::vector<Position> positions() {
  std::vector<Position> all(11);
  all[0].name = "wall with a hole";
  add_wall(all[0].scene, 4, 3, 2, 0.08, 0.4);
  punch_hole(all[0].scene, 0.5);
  add_wall(all[0].scene, 8, 5, 3, 0.12, 0.4);
  all[1].name = "pole before a wall";
  add_pole(all[1].scene, 4, 0.3, 0.1, 0.04);
  add_wall(all[1].scene, 7, 2, 1.5, 0.06, 0.4);
  all[2].name = "sphere over a plane";
  add_sphere(all[2].scene, {5, 0, 1}, 0.6, 1500);
  add_rectangle(all[2].scene, {2, -4, 0}, {14, 0, 0}, {0, 8, 0}, {0, 0, 1}, 0.15, 0.4);
  all[2].pose = at(0, 0, 2, 0, 12);
  all[3].name = "two walls one bin apart";
  add_wall(all[3].scene, 5, 2, 2, 0.08, 0.4);
  add_wall(all[3].scene, 5.05, 2, 2, 0.08, 0.3);
  all[3].hides_something = false;  // nearer than the roughness of one surface
  all[4].name = "grazing plane";
  add_rectangle(all[4].scene, {1, -5, 0}, {25, 0, 0}, {0, 10, 0}, {0, 0, 1}, 0.2, 0.5);
  all[4].pose = at(0, 0, 0.3);
  all[4].hides_something = false;
  all[5].name = "sparse fence";
  for (int k = -12; k <= 12; ++k) add_pole(all[5].scene, 4, 0.25 * k, 0.02, 0.02);
  add_wall(all[5].scene, 6, 4, 1.5, 0.08, 0.4);
  all[6].name = "closed body, looked at in all directions";
  add_sphere(all[6].scene, {0.1, 0, 0.2}, 2, 3000, -1);
  add_sphere(all[6].scene, {0, 0, 0}, 5, 4000, -1);
  add_sphere(all[6].scene, {0.6, 0.4, -0.7}, 0.3, 400);
  all[6].fan = make_fan(90, 2 * pi, radians(4), radians(100));
  all[7].name = "head close to a wall of wide surfels";
  add_wall(all[7].scene, 0.25, 2, 2, 0.1, 0.4);
  punch_hole(all[7].scene, 0.1);
  add_wall(all[7].scene, 6, 4, 3, 0.1, 0.4);
  all[8].name = "surfels of all sizes";
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1, 1), size(-5, -1);
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p(5 + 5 * anywhere(random), 5 * anywhere(random), 3 * anywhere(random));
    const Vector3d n(anywhere(random), anywhere(random), anywhere(random));
    add_surfel(all[8].scene, p, n.normalized(), std::pow(10, size(random)));
  }
  all[8].scene.normals_oriented = false;
  all[9].name = "all points at one place";
  for (int i = 0; i < 300; ++i) add_surfel(all[9].scene, {5, 0.3, 0.1}, {-1, 0, 0}, 1);
  all[9].hides_something = false;
  all[10].name = "mixed density";
  add_rectangle(all[10].scene, {4, -3, -2}, {0, 3, 0}, {0, 0, 4}, {-1, 0, 0}, 0.25, 0.4);
  add_rectangle(all[10].scene, {4, 0, -2}, {0, 3, 0}, {0, 0, 4}, {-1, 0, 0}, 0.04, 0.4);
  add_wall(all[10].scene, 7, 6, 3, 0.1, 0.4);
  return all;
}

SamplingOptions options_for(SamplingKind kind, Projection projection) {
  SamplingOptions options = unsplit();
  options.kind = kind;
  options.projection = projection;
  options.rays_per_beam = 12;
  return options;
}

/// Returns the Lambert cross-section without mu of a bed with a sphere and a wall [dB].
double cross_section_db(const SceneCloud& scene, const SamplingOptions& options) {
  const BeamFan fan = make_fan(64, radians(50), radians(1), radians(15));
  const Scatterers s = find_scatterers(scene, at(0, 0, 0, 0, 10), fan, {0.1, 13, 0.05}, options).scatterers;
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) sum += s.projected_area[i] * s.cos_incidence[i];
  return 10 * std::log10(sum);
}
SceneCloud bed_with_sphere_and_wall(double spacing) {
  SceneCloud scene;
  add_rectangle(scene, {2, -6, -2}, {12, 0, 0}, {0, 12, 0}, {0, 0, 1}, spacing, 0.5);
  add_sphere(scene, {6, 0.5, -1}, 0.8, static_cast<int>(4 * pi * 0.64 / (spacing * spacing)));
  add_wall(scene, 11, 4, 2, spacing, 0.5);
  return scene;
}

constexpr SamplingKind kinds[] = {SamplingKind::surfels, SamplingKind::rays};

}  // namespace

TEST(Projection, changes_no_byte_of_the_result) {
  for (const Position& position : positions())
    for (const SamplingKind kind : kinds) {
      const auto look = [&](Projection projection) {
        return find_scatterers(position.scene, position.pose, position.fan, long_gate(), options_for(kind, projection));
      };
      const Sampling plain = look(Projection::brute_force);
      EXPECT_GT(plain.scatterers.size(), 50u) << position.name;
      if (kind == SamplingKind::surfels) {
        EXPECT_EQ(plain.report.hidden > 30, position.hides_something) << position.name;
      }
      for (const Projection projection : {Projection::kdtree, Projection::raster, Projection::automatic}) {
        const Sampling fast = look(projection);
        const char* const of = kind == SamplingKind::rays ? "rays" : "surfels";
        EXPECT_TRUE(equal(fast.scatterers, plain.scatterers))
            << position.name << ", " << of << ", " << static_cast<int>(projection);
        EXPECT_EQ(fast.report.hidden, plain.report.hidden) << position.name;
        EXPECT_EQ(fast.report.rays_missed, plain.report.rays_missed) << position.name;
        EXPECT_EQ(fast.report.rays_unknown, plain.report.rays_unknown) << position.name;
        if (projection != Projection::automatic) {
          EXPECT_EQ(fast.report.projection, projection);
        }
      }
    }
}

TEST(Projection, chosen_automatically_is_the_raster_unless_most_surfels_are_wide) {
  const auto used = [](double distance) {
    SceneCloud scene;
    add_wall(scene, distance, 4, 4, 0.1);
    return find_scatterers(scene, Pose::Identity(), wide_fan(), long_gate(), unsplit()).report.projection;
  };
  EXPECT_EQ(used(8), Projection::raster);
  SceneCloud thick;  // each with a footprint of many degrees
  add_sphere(thick, {0, 0, 0}, 1, 5000, -1);
  for (float& a : thick.area) a = 0.1f;
  const BeamFan all_round = make_fan(90, 2 * pi, radians(4), radians(100));
  EXPECT_EQ(find_scatterers(thick, Pose::Identity(), all_round, long_gate(), unsplit()).report.projection,
            Projection::kdtree);
}

TEST(PreparedScene, gives_the_bytes_of_the_scene_itself) {
  auto all = positions();
  all.push_back({"harbour", make_built_in_scene("harbour", {.points = 20000}), at(0, 0, -3, 0, 10)});
  all.push_back({"rough harbour far from zero", all.back().scene, at(0, 0, -3, 0, 10)});
  all.back().scene.origin = {5e5, -4e6, 10};
  all.back().pose.translation() += all.back().scene.origin;
  for (auto& material : all.back().scene.materials) material.relief_slope = 0.2;
  for (const Position& position : all) {
    const PreparedScene prepared(position.scene);
    for (const SamplingKind kind : kinds)
      for (const double max_range : {3.0, 12.0, 80.0}) {
        SamplingOptions options = options_for(kind, Projection::automatic);
        options.scatterers_per_cell = 0.1;
        const RangeGate gate{0.1, max_range, 0.05};
        const Sampling plain = find_scatterers(position.scene, position.pose, position.fan, gate, options);
        const Sampling fast = find_scatterers(prepared, position.pose, position.fan, gate, options);
        EXPECT_TRUE(equal(fast.scatterers, plain.scatterers)) << position.name << " to " << max_range << " m";
        EXPECT_EQ(fast.report.in_gate, plain.report.in_gate) << position.name;
        EXPECT_EQ(fast.report.surfels, plain.report.surfels) << position.name;
      }
  }
}

TEST(PreparedScene, gives_the_same_bytes_for_any_number_of_threads_and_projection) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const BeamFan fan = make_fan(128, radians(130), radians(1), radians(20));
  for (const SamplingKind kind : kinds)
    for (const Projection projection : {Projection::kdtree, Projection::raster}) {
      SamplingOptions options = options_for(kind, projection);
      options.scatterers_per_cell = 1;
      options.threads = 1;
      const Sampling one = find_scatterers(PreparedScene(scene, 1), at(0, 0, -3, 0, 10), fan, {1, 40, 0.01}, options);
      EXPECT_GT(one.scatterers.size(), 500u);
      for (const int threads : {2, 7}) {
        options.threads = threads;
        const Sampling many =
            find_scatterers(PreparedScene(scene, threads), at(0, 0, -3, 0, 10), fan, {1, 40, 0.01}, options);
        EXPECT_TRUE(equal(many.scatterers, one.scatterers)) << threads;
        EXPECT_EQ(many.report.rays_unknown, one.report.rays_unknown);
      }
    }
}

TEST(PreparedScene, refuses_invalid_pings) {
  SceneCloud scene;
  add_wall(scene, 5, 1, 1, 0.1);
  const PreparedScene prepared(scene);
  EXPECT_EQ(error_of([&] {
              find_scatterers(prepared, Pose::Identity(), wide_fan(), {2, 1, 0.1});
            }),
            error_of([&] {
              find_scatterers(scene, Pose::Identity(), wide_fan(), {2, 1, 0.1});
            }));
  EXPECT_NE(error_of([&] { find_scatterers(prepared, Pose::Identity(), wide_fan(), {2, 1, 0.1}); }), "no error");
}

// Lambert cross-section without mu: four and sixteen times as many surfels or rays change it by less than 0.1 dB.
TEST(Level, does_not_depend_on_density_of_points_or_rays) {
  const auto level_db = [](double spacing, const SamplingOptions& options) {
    return cross_section_db(bed_with_sphere_and_wall(spacing), options);
  };
  const auto options_of = [](SamplingKind kind, Projection projection, int rays) {
    SamplingOptions options = options_for(kind, projection);
    options.rays_per_beam = rays;
    return options;
  };
  for (const Projection projection : {Projection::kdtree, Projection::raster}) {
    for (const SamplingKind kind : kinds) {
      const double finest = level_db(0.02, options_of(kind, projection, 256));
      for (const double spacing : {0.04, 0.08})
        EXPECT_NEAR(level_db(spacing, options_of(kind, projection, 256)), finest, 0.1)
            << spacing << " m, " << static_cast<int>(kind);
    }
    const double most_rays = level_db(0.04, options_of(SamplingKind::rays, projection, 1024));
    for (const int rays : {64, 256})
      EXPECT_NEAR(level_db(0.04, options_of(SamplingKind::rays, projection, rays)), most_rays, 0.1) << rays << " rays";
  }
}

// The cloud is thinned to a quarter and a sixteenth of its surfels.
TEST(Level, is_kept_by_thinning) {
  const SceneCloud scene = bed_with_sphere_and_wall(0.03);
  const double dense = cross_section_db(scene, unsplit());
  for (const double spacing : {0.06, 0.12}) {
    const SceneCloud thinned = thin_scene(scene, spacing);
    EXPECT_NEAR(static_cast<double>(scene.size()) / static_cast<double>(thinned.size()), std::pow(spacing / 0.03, 2),
                0.25 * std::pow(spacing / 0.03, 2));
    EXPECT_NEAR(cross_section_db(thinned, unsplit()), dense, 0.1) << spacing << " m";
  }
}

TEST(Report, counts_surfels_too_large_for_4096_parts) {
  SceneCloud scene;
  add_surfel(scene, {5, 0, 0}, {-1, 0, 0}, pi);
  add_surfel(scene, {5, 3, 0}, {-1, 0, 0}, 1e-4);
  const Sampling s = find_scatterers(scene, Pose::Identity(), wide_fan(), long_gate(), {.scatterers_per_cell = 1e5});
  EXPECT_EQ(s.report.capped, 1u);
  EXPECT_EQ(find_scatterers(scene, Pose::Identity(), wide_fan(), long_gate(), unsplit()).report.capped, 0u);
}

// Between +-20 degrees a wall 5 m away; without a wall, or beside it, there is open water.
TEST(Report, distinguishes_a_hole_in_the_scan_from_open_water) {
  SceneCloud scene;
  add_wall(scene, 5, 3, 3, 0.1);
  const BeamFan fan = make_fan(40, radians(40), radians(0.5), radians(15));
  const auto look = [&] {
    return find_scatterers(scene, Pose::Identity(), fan, long_gate(),
                           {.kind = SamplingKind::rays, .rays_per_beam = 400})
        .report;
  };
  EXPECT_EQ(look().rays_missed, 0u);
  punch_hole(scene, 0.2);  // 4 x 4 surfels missing: 5 spacings from centre to centre
  const SamplingReport hole = look();
  EXPECT_GT(hole.rays_missed, 3u);
  EXPECT_EQ(hole.rays_unknown, hole.rays_missed);
  punch_hole(scene, 1);  // a window, whose middle counts as open water
  const SamplingReport window = look();
  EXPECT_GT(window.rays_missed, 10 * hole.rays_missed);
  EXPECT_LT(window.rays_unknown, window.rays_missed / 10);
  scene = {};
  EXPECT_EQ(look().rays_unknown, 0u);
}

// The position of a part, recomputed from range, azimuth and elevation, lies in the plane of its surfel to rounding:
// ahead, astern, above, below, near and far.
TEST(Splitting, directions_of_parts_are_good_to_1e_12) {
  SceneCloud scene;
  for (const double range : {0.3, 3.0, 50.0}) add_sphere(scene, {0, 0, 0}, range, 200, -1);
  add_surfel(scene, {0, 0, 5}, {0, 0, -1}, 1);
  add_surfel(scene, {0, 0, -5}, {0, 0, 1}, 1);
  add_surfel(scene, {-5, 0, 0}, {1, 0, 0}, 1);
  SamplingOptions options{.scatterers_per_cell = 100, .elevation_half_extent = pi / 2, .occlusion = false};
  const BeamFan all_round = make_fan(90, 2 * pi, radians(4), radians(100));
  const Scatterers s = find_scatterers(scene, Pose::Identity(), all_round, long_gate(), options).scatterers;
  ASSERT_GT(s.size(), 5 * scene.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Vector3d centre = scene.point[s.surfel[i]].cast<double>();
    const Vector3d normal = scene.normal[s.surfel[i]].cast<double>().normalized();
    const Vector3d position = s.range[i] * unit_vector({s.azimuth[i], s.elevation[i]});
    ASSERT_NEAR(normal.dot(position - centre), 0, 1e-12 * s.range[i]);
    ASSERT_LE((position - centre).squaredNorm(), scene.area[s.surfel[i]] / pi * (1 + 1e-9));
    ASSERT_LE(std::abs(s.azimuth[i]), pi);
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// Tests the labels of pixels in a scene of parts, and the view of each part.
#include <cmath>

#include "core/units.hpp"
#include "returns/label_objects.hpp"
#include "sampling/mesh_surfels.hpp"
#include "scene/posed_scene.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::part_labels_tests {

using Eigen::Vector3d;

PlacedPart placed(const std::string& name, const std::string& label, const SceneCloud& cloud, const Vector3d& at) {
  PlacedPart part{.name = name, .label = label, .cloud = std::make_shared<const SceneCloud>(cloud)};
  part.world_from_part.translation() = at;
  return part;
}

SceneCloud ball(double radius) {
  SceneCloud cloud;
  cloud.materials = {{.name = "steel", .lambert_mu = 0.05}};
  add_sphere(cloud, {0, 0, 0}, radius, 4000);
  return cloud;
}

/// Returns an upright plate that faces the head, its middle at the origin.
SceneCloud board(double width, double height) {
  SceneCloud cloud;
  cloud.materials = {{.name = "wood", .lambert_mu = 0.05}};
  add_rectangle(cloud, {0, -width / 2, -height / 2}, {0, width, 0}, {0, 0, height}, {-1, 0, 0}, 0.01);
  return cloud;
}

PlacedPart bed() {
  SceneCloud floor;
  floor.materials = {{.name = "sand"}};
  add_floor(floor, {2, -4, -2}, 160, 0.05);
  return {.name = "bed", .cloud = std::make_shared<const SceneCloud>(floor), .captured = true};
}

PixelLabels labels_of(const std::vector<PlacedPart>& parts) {
  SimulationOptions o;
  o.outputs.contributors = 1;
  const SonarHead head = small_head({.beams = 64, .field_of_view_deg = 60, .beam_width_deg = 1, .max_range = 10});
  return simulate_event(merge_parts(parts), head, {}, Environment{}, o).ping.labels;
}

std::size_t index_of(const PixelLabels& labels, const std::string& part) {
  const auto at = std::find(labels.part_names.begin(), labels.part_names.end(), part);
  return static_cast<std::size_t>(at - labels.part_names.begin());
}

TEST(PartLabels, name_class_and_part_of_every_pixel) {
  const PixelLabels labels =
      labels_of({bed(), placed("pot-1", "pot", ball(0.3), {5, 1, 0}), placed("pot-2", "pot", ball(0.3), {6, -1.5, 0}),
                 placed("a", "", ball(0.2), {4, 0, 0})});
  EXPECT_EQ(labels.part_names, (std::vector<std::string>{"a", "bed", "pot-1", "pot-2"}));
  EXPECT_EQ(labels.part_labels, (std::vector<std::string>{"", "", "pot", "pot"}));
  std::map<std::string, std::map<std::string, int>> classes;  // by part
  const auto material = material_image(labels);
  const auto part = part_image(labels);
  for (Eigen::Index i = 0; i < material.size(); ++i)
    if (material(i) < labels.names.size()) ++classes[labels.part_names.at(part(i))][labels.names[material(i)]];
  EXPECT_EQ(classes["bed"].size(), 1U);
  EXPECT_GT(classes["bed"]["sand"], 500);
  EXPECT_GT(classes["a"]["steel"], 3);
  for (const char* pot : {"pot-1", "pot-2"}) {
    EXPECT_EQ(classes[pot].size(), 1U);
    EXPECT_GT(classes[pot]["pot"], 3) << pot;
  }
  // Objects: the two pots by their parts, numbered above the given objects of the bed; all else by what touches.
  const ObjectKeys keys = object_keys(labels, number_instances({{7, 7}}), 0.5);
  EXPECT_EQ(keys.instances, (SceneInstances{{{2, 10}, {3, 11}}, {}, 11}));
}

TEST(PartLabels, have_the_extents_of_a_sphere_and_all_of_its_share) {
  const PixelLabels labels = labels_of({bed(), placed("ball", "ball", ball(0.3), {6, 0, 0})});
  const PartView& view = labels.views.at(index_of(labels, "ball"));
  EXPECT_EQ(view.visible_share, 1);
  EXPECT_NEAR(view.azimuth.most, std::asin(0.3 / 6), 0.002);
  EXPECT_NEAR(view.azimuth.least, -std::asin(0.3 / 6), 0.002);
  EXPECT_NEAR(view.elevation.most, std::asin(0.3 / 6), 0.002);
  EXPECT_NEAR(view.range.least, 5.7, 0.002);
  EXPECT_NEAR(view.range.most, std::sqrt(36 - 0.09), 0.02);
  EXPECT_EQ(view.world_from_part.translation(), Vector3d(6, 0, 0));
  EXPECT_TRUE(std::isnan(labels.views.at(index_of(labels, "bed")).visible_share));
  EXPECT_EQ(view.scale, 1);
  EXPECT_LT((view.size - Vector3d::Constant(0.6)).norm(), 0.01);  // of its 4000 surfels
  EXPECT_TRUE(labels.views.at(index_of(labels, "bed")).size.hasNaN());
}

// Beside the axis of the head, the sides of a sphere are not where its extents in azimuth and range meet.
TEST(PartLabels, have_the_places_where_a_fan_draws_a_sphere) {
  const Vector3d middle(6, 2.5, -1.6);  // far below: a line array receives it in a beam nearer to its axis
  const PixelLabels labels = labels_of({bed(), placed("ball", "ball", ball(0.3), middle)});
  const PartView& view = labels.views.at(index_of(labels, "ball"));
  PartView::Extent ahead{1e9, -1e9}, port{1e9, -1e9};
  for (int i = 0; i < 200000; ++i) {
    const double z = 1 - (i + 0.5) / 100000, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
    const Vector3d normal(r * std::cos(turn), r * std::sin(turn), z), position = middle + 0.3 * normal;
    if (normal.dot(position) > 0) continue;
    // The picture draws the cone of the beam: at the range of the sphere, and as far to port.
    const Eigen::Vector2d drawn(std::sqrt(position.squaredNorm() - position.y() * position.y()), position.y());
    ahead = {std::min(ahead.least, drawn.x()), std::max(ahead.most, drawn.x())};
    port = {std::min(port.least, drawn.y()), std::max(port.most, drawn.y())};
  }
  EXPECT_NEAR(view.ahead.least, ahead.least, 0.01);
  EXPECT_NEAR(view.ahead.most, ahead.most, 0.02);
  EXPECT_NEAR(view.port.least, port.least, 0.02);
  EXPECT_NEAR(view.port.most, port.most, 0.02);
  // The sector of its ranges and azimuths reaches further.
  EXPECT_GT(view.range.most * std::sin(view.azimuth.most), port.most + 0.05);
  EXPECT_LT(view.beam_azimuth.most, view.azimuth.most - 0.005);
}

/// Returns a body between two corners, as a mesh and surfels 5 cm apart.
SceneCloud chest(const Vector3d& low, const Vector3d& high) {
  SceneMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.point.push_back(
        Vector3d((i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()).cast<float>());
  mesh.material.assign(8, 0);
  mesh.triangle = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  SceneCloud cloud = even_surfels(mesh, 0.05).scene;
  cloud.part_of.reset();
  return cloud;
}

// The head looks along the top, 0.1 to 1 degree from edge-on. Its surfels end before its edges do.
TEST(PartLabels, bound_a_mesh_by_faces_that_are_nearly_edge_on) {
  for (const double below : {0.01, 0.03, 0.1}) {
    const PixelLabels labels =
        labels_of({placed("chest", "chest", chest({-0.5, -0.3, -0.3}, {0.5, 0.3, -below}), {6, 0, 0})});
    const PartView& view = labels.views.at(index_of(labels, "chest"));
    const double far = std::hypot(6.5, 0.3, below), near = std::hypot(5.5, 0, below);
    EXPECT_NEAR(view.range.most, far, 1e-3) << below;
    EXPECT_NEAR(view.range.least, near, 5e-3) << below;
    EXPECT_NEAR(view.ahead.most, std::hypot(6.5, below), 1e-3) << below;
    EXPECT_NEAR(view.port.most, 0.3, 1e-3) << below;
    EXPECT_NEAR(view.port.least, -0.3, 1e-3) << below;
    EXPECT_NEAR(view.beam_azimuth.most, std::asin(0.3 / std::hypot(5.5, 0.3, below)), 1e-3) << below;
    EXPECT_NEAR(view.elevation.least, -std::atan2(0.3, 5.5), 1e-3) << below;
    EXPECT_EQ(view.visible_share, 1) << below;
  }
  // Turned away it ends where its front does.
  const PixelLabels above =
      labels_of({placed("chest", "chest", chest({-0.5, -0.3, -0.3}, {0.5, 0.3, 0.01}), {6, 0, 0})});
  EXPECT_NEAR(above.views.at(index_of(above, "chest")).range.most, std::hypot(5.5, 0.3, 0.3), 1e-3);
}

TEST(PartLabels, know_the_share_that_another_part_hides) {
  // The screen hides the lower third of a board twice as far away.
  const PlacedPart far = placed("far", "far", board(0.9, 0.9), {8, 0, 0});
  const PixelLabels labels = labels_of({far, placed("screen", "screen", board(2, 0.3), {4, 0, -0.225})});
  EXPECT_NEAR(labels.views.at(index_of(labels, "far")).visible_share, 2.0 / 3, 0.02);
  EXPECT_EQ(labels.views.at(index_of(labels, "screen")).visible_share, 1);
}

TEST(PartLabels, do_not_see_a_part_behind_the_head) {
  const PixelLabels labels = labels_of({bed(), placed("aft", "aft", ball(0.3), {-6, 0, 0})});
  EXPECT_TRUE(std::isnan(labels.views.at(index_of(labels, "aft")).visible_share));
  EXPECT_EQ((labels.part == static_cast<std::uint16_t>(index_of(labels, "aft"))).count(), 0);
}

}  // namespace insonify::part_labels_tests

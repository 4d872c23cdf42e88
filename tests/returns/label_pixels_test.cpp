// SPDX-License-Identifier: BSD-3-Clause
// Tests the surface that a pixel shows, and shadow (E125).
#include "returns/label_pixels.hpp"

#include "sonar/pulse.hpp"
#include "support/test.hpp"

namespace {

/// 21 beams of 3 degrees over 40, bins of 1 cm from 2 m to 4 m, a pulse of 1.1 cm; a scene of sand (0) and steel (1) of
/// surfels of 0.56 mm, which echo or are hidden.
class PixelLabelling : public testing::Test {
 protected:
  SonarHead head;
  Medium medium{1500, {0.02, 0, 0}};
  SceneCloud scene;
  Echoes echoes;
  std::vector<std::uint32_t> surfel;
  std::vector<LegPair> legs;
  std::vector<Visibility> others;
  static constexpr Eigen::Index ahead = 10, bin = 100;

  void SetUp() override {
    head.pulse = {600e3, 30e3, 200};
    head.array = array_for_beam_width(radians(3), 1500 / 600e3, Shading::taylor, -30);
    head.fan = make_fan(21, radians(40), radians(3), radians(30));
    head.gate = {2, 4, 0.01};
    scene.materials = {Material{}, Material{}};
    scene.materials[0].name = "sand", scene.materials[1].name = "steel";
  }
  double range_of(Eigen::Index n) const { return head.gate.centre(static_cast<std::size_t>(n)); }
  std::uint32_t position(double range, double u, std::uint16_t material, double area = 1e-6) {
    scene.point.emplace_back(range * Eigen::Vector3d(std::sqrt(1 - u * u), u, 0).cast<float>());
    scene.normal.emplace_back(-1, 0, 0), scene.area.push_back(static_cast<float>(area));
    scene.material.push_back(material), scene.id.push_back(100 + static_cast<std::uint32_t>(scene.size() - 1));
    others.push_back(Visibility::not_queried);
    return static_cast<std::uint32_t>(scene.size() - 1);
  }
  /// Adds an echo of power 1 from `metres` behind the middle of bin `n`.
  void hear(Eigen::Index n, double metres, double u, std::uint16_t material, double power = 1, double area = 1e-6) {
    const double range = range_of(n) + metres;
    surfel.push_back(position(range, u, material, area)), legs.push_back({});
    echoes.delay.push_back(2 * range / medium.sound_speed), echoes.u.push_back(u), echoes.v.push_back(0);
    echoes.amplitude.emplace_back(std::sqrt(power), 0);
  }
  void hide(Eigen::Index n, double metres, double u, double area = 1e-6) {
    others[position(range_of(n) + metres, u, 1, area)] = Visibility::hidden;
  }
  Contributors found() const {
    const SurfelEchoes all[] = {{echoes, surfel, legs}};
    return find_contributors(scene, all, head, medium);
  }
  PixelLabels labels() const {
    const SurfelEchoes direct{echoes, surfel, {}};
    return label_pixels(scene, {direct, others, found()}, head, Pose::Identity(), medium);
  }
};

}  // namespace

TEST_F(PixelLabelling, is_by_the_material_with_most_energy_in_the_cell) {
  hear(bin, 0, 0, 0, 1);
  hear(bin, 0, 0.001, 1, 3);
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin), 1);
  EXPECT_NEAR(l.share(ahead, bin), 0.75, 0.002);
  EXPECT_EQ(l.id(ahead, bin), 101U);
  EXPECT_THAT(l.names, testing::ElementsAre("sand", "steel"));
}

// A cell is as wide as beam and pulse are at half their power: what is louder beside it is in the share, not in the
// label.
TEST_F(PixelLabelling, a_cell_is_as_wide_as_beam_and_pulse) {
  const double half_beam = radians(1.5), half_pulse = 0.5 * range_resolution(head.pulse, medium.sound_speed);
  hear(bin, 0, 0.9 * half_beam, 0);
  hear(bin, 0, 1.2 * half_beam, 1, 100);
  PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin), 0);
  EXPECT_LT(l.share(ahead, bin), 0.05);
  EXPECT_EQ(material_image(l)(ahead, bin), PixelLabels::nothing);
  hear(bin + 30, 0.9 * half_pulse, 0, 0);
  hear(bin + 30, 1.2 * half_pulse, 0, 1, 100);
  l = labels();
  EXPECT_EQ(l.material(ahead, bin + 30), 0);
  EXPECT_EQ(l.material(ahead, bin + 31), 1);
}

TEST_F(PixelLabelling, side_lobes_are_not_what_they_leak_from) {
  hear(bin, 0, 0.1, 1, 1e6);
  const PixelLabels l = labels();
  const Contributors all = found();
  EXPECT_GT(all.total[all.at(ahead, bin) / all.per_pixel], 1);  // received by a side lobe, loud enough for any surface
  EXPECT_EQ(l.material(ahead, bin), PixelLabels::nothing);
  EXPECT_EQ(l.share(ahead, bin), 0);
  EXPECT_EQ(l.id(ahead, bin), PixelLabels::no_id);
}

TEST_F(PixelLabelling, surface_that_is_not_seen_is_shadow) {
  hear(bin, 0, 0.1, 1, 1e6);
  hide(bin, 0, 0);
  hear(bin + 20, 0, 0, 0);
  hide(bin + 20, 0, 0.001);
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin), PixelLabels::shadow);  // whatever leaks into it
  EXPECT_EQ(l.share(ahead, bin), 0);
  EXPECT_EQ(l.material(ahead, bin + 2), PixelLabels::nothing);
  EXPECT_EQ(l.material(ahead + 2, bin), PixelLabels::nothing);
  EXPECT_EQ(l.material(ahead, bin + 20), 0);  // some of its surface is seen
}

TEST_F(PixelLabelling, surface_that_faces_away_is_shadow_unless_some_is_seen) {
  hide(bin, 0, 0);
  others[0] = Visibility::turned_away;
  hide(bin + 20, 0, 0);
  EXPECT_EQ(labels().material(ahead, bin), PixelLabels::shadow);
  hide(bin + 20, 0, 0.001);
  others[2] = Visibility::seen;  // by no ray, so without an echo
  EXPECT_EQ(labels().material(ahead, bin + 20), PixelLabels::nothing);
  others[1] = others[2] = Visibility::outside;
  EXPECT_EQ(labels().material(ahead, bin + 20), PixelLabels::nothing);
}

TEST_F(PixelLabelling, hidden_surfels_reach_by_their_radius) {
  hide(bin, 0, 0, std::numbers::pi * 0.03 * 0.03);
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin + 3), PixelLabels::shadow);
  EXPECT_EQ(l.material(ahead, bin + 4), PixelLabels::nothing);
}

// Surfels of a bed that lie a little farther apart than a cell is long: no stripes of nothing between them.
TEST_F(PixelLabelling, gaps_between_surfels_have_no_label_of_their_own) {
  hear(bin, 0, 0, 0, 1, 0.02 * 0.02);
  hear(bin + 2, 0, 0, 0, 1, 0.02 * 0.02);
  surfel.insert(surfel.end(), {surfel[0], surfel[1]});  // two parts of each: a part alone does not reach so far
  for (int i = 0; i < 2; ++i) {
    echoes.delay.push_back(echoes.delay[i]), echoes.u.push_back(0), echoes.v.push_back(0), legs.push_back({});
    echoes.amplitude.push_back(echoes.amplitude[i]);
  }
  PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin + 1), 0);
  EXPECT_EQ(l.id(ahead, bin + 1), 100U);
  hide(bin + 1, 0, 0);
  l = labels();
  EXPECT_EQ(l.material(ahead, bin), 0);
}

TEST_F(PixelLabelling, echoes_by_way_of_a_boundary_are_in_the_total_alone) {
  hear(bin, 0, 0, 0);
  hear(bin, 0, 0, 0, 3);
  const PixelLabels both = labels();
  EXPECT_NEAR(both.share(ahead, bin), 1, 1e-4);
  legs[1] = {0, 1};
  const SurfelEchoes all[] = {{echoes, surfel, legs}};
  const Contributors c = find_contributors(scene, all, head, medium);
  for (auto* column : {&echoes.delay, &echoes.u, &echoes.v}) column->pop_back();
  echoes.amplitude.pop_back(), surfel.pop_back();
  const SurfelEchoes direct{echoes, surfel, {}};
  const PixelLabels l = label_pixels(scene, {direct, others, c}, head, Pose::Identity(), medium);
  EXPECT_NEAR(l.share(ahead, bin), 0.25, 0.002);
}

TEST_F(PixelLabelling, of_a_planar_array_is_by_rows) {
  head.column = head.array;
  const BeamFan row = head.fan;
  head.fan.row_width = radians(3);
  for (const double elevation : {radians(6.0), radians(12.0)})
    for (std::size_t b = 0; b < row.beams(); ++b)
      head.fan.azimuth.push_back(row.azimuth[b]), head.fan.elevation.push_back(elevation);
  hear(bin, 0, 0, 0);
  echoes.v[0] = std::sin(radians(6.5));
  hide(bin, 0, 0);  // at elevation 0
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(ahead, bin), PixelLabels::shadow);
  EXPECT_EQ(l.material(21 + ahead, bin), 0);
  EXPECT_EQ(l.material(42 + ahead, bin), PixelLabels::nothing);
}

TEST_F(PixelLabelling, images_keep_what_has_the_share_asked_for) {
  hear(bin, 0, 0, 1, 0.6);
  hear(bin, 0, 0, 0, 0.4);
  hide(bin + 40, 0, 0);
  const PixelLabels l = labels();
  EXPECT_EQ(material_image(l, 0.5)(ahead, bin), 1);
  EXPECT_EQ(material_image(l, 0.7)(ahead, bin), PixelLabels::nothing);
  EXPECT_EQ(material_image(l, 0.7)(ahead, bin + 40), PixelLabels::shadow);
  EXPECT_EQ(id_image(l, 0.5)(ahead, bin), 100U);
  EXPECT_EQ(id_image(l, 0.7)(ahead, bin), PixelLabels::no_id);
}

TEST_F(PixelLabelling, is_the_same_for_any_number_of_threads) {
  for (int i = 0; i < 200; ++i) hear(20 + (7 * i) % 160, 0.0003 * i, 0.001 * ((37 * i) % 400) - 0.2, i % 2 ? 1 : 0);
  const SurfelEchoes direct{echoes, surfel, {}};
  const Contributors c = found();
  const PixelLabels one = label_pixels(scene, {direct, others, c}, head, Pose::Identity(), medium, 1),
                    three = label_pixels(scene, {direct, others, c}, head, Pose::Identity(), medium, 3);
  EXPECT_TRUE((one.material == three.material && one.share == three.share && one.id == three.id).all());
}

TEST_F(PixelLabelling, refuses_other_extents_and_scenes) {
  hear(bin, 0, 0, 0);
  Contributors c = found();
  const SurfelEchoes direct{echoes, surfel, {}};
  const auto label = [&] { label_pixels(scene, {direct, others, c}, head, Pose::Identity(), medium); };
  head.fan = make_fan(5, radians(40), radians(3), radians(30));
  expect_error(ErrorKind::argument, {"label_pixels", "21 beams x 200 bins", "5 x 200"}, label);
  head.fan = make_fan(21, radians(40), radians(3), radians(30));
  c.total.clear();
  expect_error(ErrorKind::argument, {"total energy of 0 pixels", "4200"}, label);
  c = found();
  others.push_back(Visibility::not_queried);
  expect_error(ErrorKind::argument, {"visibilities have 2 entries", "(1)"}, label);
  others.pop_back();
  surfel[0] = 7;
  expect_error(ErrorKind::argument, {"surfel[0] = 7", "scene has 1"}, label);
}

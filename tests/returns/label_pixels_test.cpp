// What surface a pixel shows, and what is shadow (E125).
#include "returns/label_pixels.hpp"

#include "support/test.hpp"

namespace {

/// Three beams of 2 degrees, ten bins of 0.1 m from 5 m, and a scene before them: surfel 0 at 5.25 m ahead, surfel 1 at
/// 5.65 m ahead, surfel 2 at 5.25 m in the port beam.
class PixelLabelling : public testing::Test {
 protected:
  BeamFan fan{{radians(2.0), 0, radians(-2.0)}, {0, 0, 0}, radians(2.0), radians(20.0)};
  RangeGate gate{5, 6, 0.1};
  Pose head = Pose::Identity();
  SceneCloud scene;
  Contributors found;

  void SetUp() override {
    scene.materials = {Material{}, Material{}};
    scene.materials[0].name = "sand", scene.materials[1].name = "steel";
    add_surfel(scene, {5.25, 0, 0}, {-1, 0, 0}, 1e-4, 0);
    add_surfel(scene, {5.65, 0, 0}, {-1, 0, 0}, 1e-4, 1);
    add_surfel(scene, 5.25 * Eigen::Vector3d(std::cos(radians(2.0)), std::sin(radians(2.0)), 0), {-1, 0, 0}, 1e-4, 1);
    found.beams = 3, found.bins = 10, found.per_pixel = 2;
    found.surfel.assign(60, Contributors::none), found.id.assign(60, Contributors::none);
    found.share.assign(60, 0), found.elevation.assign(60, 0);
    found.material.assign(60, Contributors::no_material), found.path.assign(60, PathKind::direct);
  }
  void contribute(std::size_t beam, std::size_t bin, std::size_t k, std::uint32_t surfel, float share) {
    const std::size_t i = found.at(beam, bin, k);
    found.surfel[i] = surfel, found.id[i] = scene.id[surfel], found.share[i] = share,
    found.material[i] = scene.material[surfel];
  }
  PixelLabels labels() const { return label_pixels(scene, found, {fan, gate, head, 0.05}); }
};

}  // namespace

TEST_F(PixelLabelling, is_by_the_material_with_most_energy_in_the_cell) {
  contribute(1, 2, 0, 0, 0.7F);
  contribute(1, 2, 1, 2, 0.2F);  // in the port beam, a beam width away: in the main lobe still
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(1, 2), 0);
  EXPECT_NEAR(l.share(1, 2), 0.7 / 0.9, 1e-6);
  EXPECT_EQ(l.id(1, 2), scene.id[0]);
  EXPECT_THAT(l.names, testing::ElementsAre("sand", "steel"));
}

TEST_F(PixelLabelling, side_lobes_are_not_what_they_leak_from) {
  contribute(2, 2, 0, 2, 1);  // steel of the port beam, heard by a side lobe to starboard
  contribute(1, 4, 0, 0, 1);  // sand of 5.25 m in a side lobe of the pulse
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(2, 2), PixelLabels::nothing);
  EXPECT_EQ(l.share(2, 2), 0);
  EXPECT_EQ(l.material(1, 4), PixelLabels::nothing);
}

TEST_F(PixelLabelling, surface_that_is_not_heard_is_shadow) {
  contribute(1, 2, 0, 0, 1);
  contribute(1, 6, 0, 0, 1);  // surfel 1 lies there, but what is heard leaks from surfel 0
  const PixelLabels l = labels();
  EXPECT_EQ(l.material(1, 6), PixelLabels::shadow);
  EXPECT_EQ(l.material(0, 2), PixelLabels::shadow);   // surfel 2, unheard
  EXPECT_EQ(l.material(1, 8), PixelLabels::nothing);  // water
  scene.point[1] = Eigen::Vector3f(5.5F, 0, 1.3F);    // 13 degrees up: beyond half of the 20 degrees
  EXPECT_EQ(labels().material(1, 6), PixelLabels::nothing);
}

TEST_F(PixelLabelling, echoes_by_way_of_a_boundary_are_not_surface) {
  contribute(1, 2, 0, 0, 1);
  found.path[found.at(1, 2)] = PathKind::one_bounce;
  EXPECT_EQ(labels().material(1, 2), PixelLabels::shadow);
}

TEST_F(PixelLabelling, images_keep_what_has_the_share_asked_for) {
  contribute(1, 2, 0, 2, 0.6F);
  contribute(1, 2, 1, 0, 0.4F);
  contribute(1, 6, 0, 1, 1);
  const PixelLabels l = labels();
  EXPECT_EQ(material_image(l, 0.5)(1, 2), 1);
  EXPECT_EQ(material_image(l, 0.7)(1, 2), PixelLabels::nothing);
  EXPECT_EQ(material_image(l, 0.7)(1, 6), 1);
  EXPECT_EQ(material_image(l, 0.7)(0, 2), PixelLabels::shadow);
  EXPECT_EQ(instance_image(l, 0.5)(1, 2), scene.id[2]);
  EXPECT_EQ(instance_image(l, 0.7)(1, 2), PixelLabels::no_id);
}

TEST_F(PixelLabelling, refuses_other_extents_and_scenes) {
  fan = BeamFan{{0}, {0}, 0.1, 0.1};
  expect_error(ErrorKind::argument, {"label_pixels", "3 beams x 10 bins", "1 x 10"}, [&] { labels(); });
  fan = BeamFan{{0.1, 0, -0.1}, {0, 0, 0}, 0.1, 0.1};
  found.surfel[0] = 7;
  expect_error(ErrorKind::argument, {"surfel 7 is not in the scene of 3"}, [&] { labels(); });
}

// What `export --to gsf|las|mcap|geotiff` writes of a ball to port of the head, ahead of it and above the bed, read by
// the decoders of tests/formats: every field's unit and sign.
#include "core/geodesy.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/ros_decoder.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/cube.hpp"
#include "support/scenes.hpp"
#include "tool/tool_runner.hpp"

namespace {

// The fan of a head that looks 30 degrees ahead of straight down, turned 20 degrees to port; the ball in beam 44.
constexpr double yaw_deg = 20, pitch_deg = 60, beam_deg = 24, ball_range = 12, ball_radius = 0.3;
const Anchor ball_anchor{54.1, 7.9, 90};  // x east, y north

Pose head_above(const Eigen::Vector3d& ball) {
  Pose pose = pose_from_yaw_pitch_roll({0, 0, 0}, radians(yaw_deg), radians(pitch_deg), 0);
  pose.translation() = ball - ball_range * (pose.linear() * unit_vector({radians(beam_deg), 0}));
  return pose;
}

}  // namespace

class ExportProducts : public ToolTest {
 protected:
  const Pose pose = head_above({3, 4, -15});

  void SetUp() override {
    SceneCloud scene;
    add_sphere(scene, {3, 4, -15}, ball_radius, 4000);
    save_scene(path("ball.ply"), scene);
    const Eigen::Vector3d at = pose.translation();
    std::ostringstream command;
    command.precision(12);
    command << "ping ball.ply --sonar r2sonic-2024 --mount=0,0,0,0,0,0 --set sonar.beams=65 --range 8:14 --split --noise --no-picture -q "
               "--pose="
            << at.x() << ',' << at.y() << ',' << at.z() << ',' << yaw_deg << ',' << pitch_deg << ",0 -o out";
    succeed(command.str());
  }
  std::string read_bytes(const std::string& name) const { return file_bytes(path(name)); }

  /// The strongest point of a LAS file 1.4 of format 6 with 14 extra bytes, by its specification, in the world.
  Eigen::Vector3d strongest_point(const std::string& name, bool is_world = false) const {
    const std::string bytes = read_bytes(name);
    const auto data = decode::Cursor(bytes, 96).unsigned_little(4),
               count = decode::Cursor(bytes, 247).unsigned_little(8);
    decode::Cursor offsets(bytes, 155);
    Eigen::Vector3d offset, best;
    for (int axis = 0; axis < 3; ++axis) offset[axis] = offsets.float64();
    float most_db = -1;
    for (std::uint64_t i = 0; i < count; ++i) {
      decode::Cursor point(bytes, data + 44 * i);
      Eigen::Vector3d at = offset;
      for (int axis = 0; axis < 3; ++axis) at[axis] += 1e-4 * static_cast<double>(point.signed_little(4));
      point.text(18);
      if (const float level = point.float32(); level > most_db) most_db = level, best = at;
    }
    if (is_world) return best;
    GeoPlace place = geo_place_of(UtmPlace{best.x(), best.y()}, {32, true});
    Eigen::Vector3d world = world_from_geo(ball_anchor, place);
    world.z() = best.z();
    return world;
  }

  /// The beam's sounding, somewhat behind the front of the ball.
  static constexpr double least = ball_range - ball_radius, most = least + 0.25;
};

TEST_F(ExportProducts, gsf_has_the_ball_to_port_ahead_and_at_its_depth) {
  succeed("export out --to gsf --anchor 54.1,7.9,90 --start-utc 2026-05-01T08:30:00Z -o ball.gsf -q");
  const decode::GsfContent read = decode::read_gsf(read_bytes("ball.gsf"));
  ASSERT_EQ(read.swaths.size(), 1U);
  const decode::GsfSwath& s = read.swaths[0];
  EXPECT_NEAR(s.time, 1777624200, 1e-6);
  const GeoPlace head = geo_from_world(ball_anchor, pose.translation());
  EXPECT_NEAR(s.latitude_deg, degrees(head.latitude), 0.6e-7);
  EXPECT_NEAR(s.longitude_deg, degrees(head.longitude), 0.6e-7);
  EXPECT_NEAR(s.heading_deg, 70, 0.011);
  EXPECT_NEAR(s.roll_deg, 0, 0.006);
  ASSERT_EQ(s.beams, 65);
  const std::size_t beam = 64 - 44;  // port first
  ASSERT_EQ(s.flags[beam], 0);
  const double c = read.profile.at(0).second, range = 0.5 * c * s.arrays.at(4)[beam];
  EXPECT_GT(range, least);
  EXPECT_LT(range, most);
  const double across = std::sin(radians(24)), ahead = std::cos(radians(24)) * 0.5;
  const double down = std::cos(radians(24)) * std::sqrt(0.75);
  EXPECT_NEAR(s.arrays.at(2)[beam], -range * across, 2e-3);  // negative to port
  EXPECT_NEAR(s.arrays.at(3)[beam], range * ahead, 2e-3);
  EXPECT_NEAR(s.arrays.at(1)[beam], -pose.translation().z() + range * down, 2e-3);
  EXPECT_NEAR(s.arrays.at(5)[beam], degrees(std::acos(down)), 0.006);
  EXPECT_NEAR(s.arrays.at(18)[beam], degrees(std::atan2(ahead, -across)), 0.006);
  EXPECT_GT(s.arrays.at(7)[beam], 80);  // dB re 1 uPa
  EXPECT_GT(s.arrays.at(9)[beam], 2);
  EXPECT_GT(s.arrays.at(19)[beam], 0);
  // Beams beside it hear it by their side lobes, at its range.
  for (std::size_t b = 0; b < 65; ++b)
    if (s.flags[b] == 0) {
      EXPECT_NEAR(0.5 * c * s.arrays.at(4)[b], ball_range, ball_radius + 0.1) << b;
    }
}

TEST_F(ExportProducts, las_and_geotiff_have_it_at_its_place_in_utm) {
  succeed("export out --to las --anchor 54.1,7.9,90 -o ball.las -q");
  succeed("export out --to geotiff --anchor 54.1,7.9,90 --cell 0.25 -o ball.tif -q");
  const Eigen::Vector3d point = strongest_point("ball.las");
  const double range = (point - pose.translation()).norm();
  EXPECT_GT(range, least);
  EXPECT_LT(range, most);
  const Eigen::Vector3d ball = pose * (range * unit_vector({radians(beam_deg), 0}));
  EXPECT_LT((point - ball).norm(), 1e-3);
  EXPECT_EQ(read_bytes("ball.tif").substr(0, 4), std::string("II*\0", 4));
}

TEST_F(ExportProducts, mcap_has_it_in_image_points_and_transforms) {
  succeed("export out --to mcap --start-utc 2026-05-01T08:30:00Z -o ball.mcap -q");
  const decode::McapContent read = decode::read_mcap(read_bytes("ball.mcap"));
  ASSERT_EQ(read.messages.size(), 4U);
  for (const decode::McapMessage& message : read.messages) {
    EXPECT_EQ(message.time, 1777624200000000000U);
    if (message.topic == "/sonar/image") {
      const std::vector<double>& data = message.content.numbers.at("image.data");
      const auto brightest = static_cast<std::size_t>(std::max_element(data.begin(), data.end()) - data.begin());
      const std::string beam = "beam_directions[" + std::to_string(brightest % 65) + "].";
      EXPECT_NEAR(std::atan2(-message.content.one(beam + "y"), message.content.one(beam + "z")), radians(24),
                  radians(2.1));
      const double range = message.content.numbers.at("ranges").at(brightest / 65);
      EXPECT_GT(range, least - 0.02);
      EXPECT_LT(range, most);
    } else if (message.topic == "/tf") {
      EXPECT_NEAR(message.content.one("transforms[0].transform.translation.z"), pose.translation().z(), 1e-9);
    } else if (message.topic == "/sonar/points") {
      EXPECT_GE(message.content.one("width"), 1);
    }
  }
}

TEST_F(ExportProducts, says_how_to_give_what_it_misses) {
  for (const char* to : {"gsf", "las", "geotiff"})
    expect_refused("export out --to " + std::string(to) + " -o product", 2,
                   {"--anchor LAT,LON[,HEADING]", "--utm ZONE"});
  expect_refused("export out --to gsf --anchor 100,0 -o product", 2, {"--anchor", "latitude = 100"});
  expect_refused("export out --to gsf --utm 99N -o product", 2, {"--utm", "1 to 60"});
  expect_refused("export out --to mcap --start-utc yesterday -o product", 2, {"--start-utc 'yesterday'"});
  expect_refused("export none --to mcap -o product", 4, {"none"});
  write("cut.h5", read("out/cube.h5").substr(0, 5000));
  expect_refused("export cut.h5 --to mcap -o product", 3, {"cut.h5"});
}

// A world in UTM: coordinates of the scene are those of the product.
TEST_F(ExportProducts, utm_worlds_keep_their_coordinates) {
  succeed("export out --to las --utm 32N -o ball.las -q");
  const Eigen::Vector3d point = strongest_point("ball.las", true);
  const Eigen::Vector3d ball = pose * ((point - pose.translation()).norm() * unit_vector({radians(beam_deg), 0}));
  EXPECT_LT((point - ball).norm(), 1e-3);
}

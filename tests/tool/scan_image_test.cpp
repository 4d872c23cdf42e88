// SPDX-License-Identifier: BSD-3-Clause
// Sweeps of a scanning head: bent where the vehicle moved, straight once that is compensated.
#include <Eigen/Eigenvalues>

#include "store/mission_file.hpp"
#include "support/test.hpp"
#include "survey/survey_pings.hpp"
#include "tool/image/image.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify::tool;

namespace {

/// A head that turns once in 16 s while it moves at `speed` along x, before a wall at x = 6 m: one loud bin where each
/// beam meets the wall.
ImageRun sweep_before_wall(double speed) {
  constexpr int beams = 200;
  Cube cube;
  cube.sonar = "test";
  for (int k = 0; k < beams; ++k) {
    const double angle = 2 * pi * k / beams, time = 16.0 * k / beams, x = speed * time;
    Ping ping;
    ping.number = k, ping.time = time, ping.scan = ScanDirection{0, angle};
    ping.world_from_head = pose_from_yaw_pitch_roll({x, 0, 0}, angle, 0, 0);
    ping.fan = make_fan(1, radians(2), radians(2), radians(20));
    ping.gate = {0.5, 12, 0.05};
    ping.pressure = ComplexGridF::Zero(1, static_cast<Eigen::Index>(ping.gate.bins()));
    const double range = (6 - x) / std::cos(angle);
    if (range > 0.5 && range < 12) ping.pressure(0, static_cast<Eigen::Index>((range - 0.5) / 0.05)) = 1;
    cube.pings.push_back(ping);
  }
  return {"run", cube};
}

/// Positions of the loud cells, in metres.
std::vector<Eigen::Vector2d> loud_places(const LevelImage& image) {
  std::vector<Eigen::Vector2d> positions;
  for (Eigen::Index b = 0; b < image.level_db.rows(); ++b)
    for (Eigen::Index n = 0; n < image.level_db.cols(); ++n)
      if (image.level_db(b, n) > 0)
        positions.push_back(
            image.gate.centre(static_cast<std::size_t>(n)) *
            Eigen::Rotation2Dd(image.fan.azimuth[static_cast<std::size_t>(b)]).toRotationMatrix().col(0));
  return positions;
}

/// Standard deviation of the positions about the line that fits them best.
double off_the_line(const std::vector<Eigen::Vector2d>& positions) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : positions) mean += p / static_cast<double>(positions.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const auto& p : positions) spread += (p - mean) * (p - mean).transpose() / static_cast<double>(positions.size());
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvalues()[0]);
}

ImageOptions raw() {
  ImageOptions options;
  options.raw = true;
  return options;
}

}  // namespace

TEST(ScanImage, shows_a_wall_straight_once_motion_is_compensated) {
  const double at_rest = off_the_line(loud_places(sweep_of_head(sweep_before_wall(0), raw(), 0)));
  const ImageRun moving = sweep_before_wall(0.15);
  const double bent = off_the_line(loud_places(sweep_of_head(moving, raw(), 0)));
  const std::vector<Eigen::Vector2d> straight = loud_places(sweep_in_world(moving, raw(), 0));
  EXPECT_LT(at_rest, 0.03) << "half a bin";
  EXPECT_GT(bent, 0.3);
  // A sample is a step of 1.8 degrees wide: 0.3 m at the far ends of the wall.
  EXPECT_LT(off_the_line(straight), 0.1);
  double mean = 0;
  for (const auto& p : straight) mean += p.x() / static_cast<double>(straight.size());
  EXPECT_NEAR(mean, 6 - 0.15 * 8, 0.05) << "seen from the middle of the sweep";
}

TEST(ScanImage, compensates_turns_of_the_vehicle) {
  ImageRun turning = sweep_before_wall(0);
  // The vehicle turns to starboard at half the rate of the head, whose own turn is larger by as much.
  for (Ping& ping : turning.cube.pings) ping.scan->angle *= 1.5;
  const Pose middle = turning.cube.pings[100].world_from_head;
  const double yaw = std::atan2(middle(1, 0), middle(0, 0)) - turning.cube.pings[100].scan->angle;
  EXPECT_GT(off_the_line(loud_places(sweep_of_head(turning, raw(), 0))), 0.3);
  std::vector<Eigen::Vector2d> positions = loud_places(sweep_in_world(turning, raw(), 0));
  EXPECT_LT(off_the_line(positions), 0.15);
  const Eigen::Rotation2Dd to_world(yaw);
  for (const auto& p : positions) EXPECT_NEAR((to_world * p).x(), 6, 0.4);
}

TEST(ScanImage, needs_a_scanning_head) {
  ImageRun fixed = sweep_before_wall(0);
  for (Ping& ping : fixed.cube.pings) ping.scan.reset();
  EXPECT_EQ(error_of([&] { sweep_of_head(fixed, raw(), 0); }, ErrorKind::content),
            "run: is not of a scanning head of one beam; draw it with --view fan");
}

namespace {
class Missions : public ToolTest {};
}  // namespace

TEST_F(Missions, that_are_made_can_be_surveyed_and_swept) {
  have("harbour.ply", "make-scene harbour --points 6000");
  const std::string cheap = " --scene harbour.ply --speed 1 --range 1:6 --centre 0,0,-3";
  succeed("make-mission lawnmower -o lines.toml --size 6,4 --spacing 2 --rate 1 --sonar p900-45" + cheap);
  succeed("make-mission orbit -o orbit.toml --radius 3 --rate 1 --sonar p900-45" + cheap);
  succeed("make-mission tunnel -o tunnel.toml --size 2,0 --scene harbour.ply --speed 1 --range 1:6 --centre 0,0,-5");
  succeed("make-mission lawnmower -o sides.toml --size 6,4 --rate 1 --sonar starfish-450" + cheap);
  const std::vector<MissionHead> sides = load_mission(path("sides.toml")).mission.heads;
  ASSERT_EQ(sides.size(), 2U) << "one to port, one to starboard";
  EXPECT_NEAR(sides[0].vehicle_from_head(1, 0), -sides[1].vehicle_from_head(1, 0), 1e-12);
  const Mission lines = load_mission(path("lines.toml")).mission, orbit = load_mission(path("orbit.toml")).mission;
  ASSERT_EQ(lines.legs.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = k % 2 == 0 ? 1 : -1, y = 2.0 * static_cast<double>(k) - 2;
    const auto at = [&](double time) -> Eigen::Vector3d { return pose_at(lines.trajectory, time).translation(); };
    EXPECT_LT((at(lines.legs[k].from + 1e-9) - Eigen::Vector3d(-3 * side, y, -3)).norm(), 0.01) << k;
    EXPECT_LT((at(lines.legs[k].to) - Eigen::Vector3d(3 * side, y, -3)).norm(), 0.01) << k;
  }
  for (const SurveyPing& ping : survey_pings(orbit)) {
    const Pose head = event_of(orbit, ping).world_from_head;
    EXPECT_NEAR(head.translation().head<2>().norm(), 3, 0.02);
    EXPECT_NEAR(head.linear().col(0).head<2>().normalized().dot(head.translation().head<2>() / 3), -1, 0.02);
  }
  write("short.toml", read("tunnel.toml") +
                          "dwell_s = 0.05\n\n[[leg]]\nname = \"once\"\nto_s = 0.5\n[ping]\nscatterers_per_cell = 0\n");
  succeed("survey short.toml -q -o run");
  succeed("merge run -q");
  succeed("image run/sonar --view scan --frame world -o sweep.png --size 300x300");
  EXPECT_TRUE(file_exists(path("sweep.png")));
  expect_refused("image run/sonar --frame world -o x.png", 2, {"--frame goes with --view scan, not fan"});
  expect_refused("make-mission orbit -o orbit.toml --scene x.ply", 4, {"orbit.toml: exists already"});
}

TEST(ScanImage, of_a_profiler_has_the_head_at_the_top) {
  ImageRun run = sweep_before_wall(0);
  EXPECT_FALSE(sweep_of_head(run, raw(), 60).downwards) << "a level head, whatever its turn";
  const Pose down = pose_from_yaw_pitch_roll({0, 0, 0}, radians(30), radians(80), 0);
  for (Ping& ping : run.cube.pings)
    ping.world_from_head = down * Eigen::AngleAxisd(ping.scan->angle, Eigen::Vector3d::UnitZ());
  for (const std::size_t ping : {0, 60}) {
    EXPECT_TRUE(sweep_of_head(run, raw(), ping).downwards);
    EXPECT_TRUE(sweep_in_world(run, raw(), ping).downwards);
  }
}

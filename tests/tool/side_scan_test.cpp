// SPDX-License-Identifier: BSD-3-Clause
// Side-scan lines and swaths: heads mounted as their files say, slant and ground range, shadows of the length they must
// have.
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include "core/units.hpp"
#include "support/test.hpp"
#include "tool/image/image.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify::tool;

namespace {

constexpr double altitude = 5, box_height = 1;

/// A flat bed 5 m below the origin, with a box 1 m high on it to port: 6 m along the way, from 8 to 9 m across.
const std::string bed_with_box = R"(
v -8 -17 -5
v  8 -17 -5
v  8  17 -5
v -8  17 -5
v -3 8 -5
v  3 8 -5
v  3 9 -5
v -3 9 -5
v -3 8 -4
v  3 8 -4
v  3 9 -4
v -3 9 -4
f 1 2 3
f 1 3 4
f 9 10 11
f 9 11 12
f 5 6 10
f 5 10 9
f 8 12 11
f 8 11 7
)";

/// A line along x over the bed, with a head of 0.1 m resolution to each side and a swath.
const std::string line_mission = R"(schema = 1
[survey]
scene = "bed.obj"
[trajectory]
waypoints_m = [[-1.5, 0, 0], [1.5, 0, 0]]
speed_m_s = 1
[[head]]
name = "port"
sonar = "starfish-450"
range = "1:16"
set = ["sonar.bandwidth_hz=7500"]
every_m = 0.4
[[head]]
name = "starboard"
sonar = "starfish-450"
side = "starboard"
range = "1:16"
set = ["sonar.bandwidth_hz=7500"]
every_m = 0.4
[[head]]
name = "swath"
sonar = "em2040"
range = "1:12"
set = ["sonar.beams=21", "sonar.field_of_view_deg=105", "sonar.beam_width_deg=3", "sonar.elevation_width_deg=3", "sonar.range_resolution_m=0.1"]
every_m = 1
)";

/// Mean power of the pings at each range.
Eigen::ArrayXd mean_power(const PingHistory& history) {
  return Eigen::pow(10.0, history.level_db.cast<double>() / 10).colwise().mean().transpose();
}

/// The stretch around `inside` whose level is 8 dB below that of the 2 m from `lit` on.
std::pair<double, double> shadow_around(const PingHistory& history, double inside, double lit) {
  const Eigen::ArrayXd power = mean_power(history);
  const auto bin = [&](double r) {
    return static_cast<Eigen::Index>((r - history.gate.min_range) / history.gate.bin_size);
  };
  const double threshold = power.segment(bin(lit), bin(lit + 2) - bin(lit)).mean() * power_from_db(-8);
  Eigen::Index begin = bin(inside), end = begin;
  while (power[begin - 1] < threshold) --begin;
  while (power[end] < threshold) ++end;
  const auto range = [&](Eigen::Index n) {
    return history.gate.min_range + static_cast<double>(n) * history.gate.bin_size;
  };
  return {range(begin), range(end)};
}

class SideScan : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", bed_with_box);
    write("line.toml", line_mission);
  }
};

/// Strengths of a mosaic's cells by their place.
class LaidImages {
 public:
  explicit LaidImages(const std::string& file) {
    reader_->SetFileName(file.c_str());
    reader_->Update();
  }
  double at(double x, double y) const {
    vtkImageData* image = reader_->GetOutput();
    const double* origin = image->GetOrigin();
    const double cell = image->GetSpacing()[0];
    const int columns = image->GetDimensions()[0] - 1, rows = image->GetDimensions()[1] - 1;
    const int i = static_cast<int>(std::floor((x - origin[0]) / cell)),
              j = static_cast<int>(std::floor((y - origin[1]) / cell));
    if (i < 0 || j < 0 || i >= columns || j >= rows) return std::nan("");
    return image->GetCellData()->GetArray("strength_db")->GetComponent(i + vtkIdType{j} * columns, 0);
  }
  /// Level of the mean strength between two distances to the side, over the middle of the line, and how many cells are empty.
  std::pair<double, int> over(double from, double to) const {
    double sum = 0;
    int cells = 0, empty = 0;
    for (double x = -1.375; x < 1.4; x += 0.25)
      for (double y = from + 0.125; y < to; y += 0.25, ++cells)
        if (const double strength = at(x, y); std::isnan(strength))
          ++empty;
        else
          sum += power_from_db(strength);
    return {db_from_power(sum / (cells - empty)), empty};
  }

 private:
  vtkNew<vtkXMLImageDataReader> reader_;
};

/// Backscattering strength of a bed of the default material.
double lambert_db(double distance) {
  const double sine = altitude / std::hypot(altitude, distance);
  return db_from_power(Material{}.lambert_mu * sine * sine);
}

PingHistory ramp() {
  PingHistory history;
  history.gate = {1, 11, 0.5};
  history.number = {0, 1};
  history.time = {0, 1};
  history.level_db.resize(2, 20);
  for (Eigen::Index n = 0; n < 20; ++n) history.level_db.col(n).setConstant(static_cast<float>(n));
  return history;
}

}  // namespace

TEST_F(SideScan, shadows_are_as_long_as_height_times_range_over_altitude_less_height) {
  succeed("survey line.toml -q -o run");
  succeed("merge -q run");
  const ImageRun port = read_image_run(path("run/port"), "");
  ImageOptions options;
  options.view = "waterfall";
  constexpr double cell = 0.1;

  // In slant range the shadow begins where the far edge of the box's top is, at 9 m across and 4 m down.
  const double edge = std::hypot(9, altitude - box_height);
  const auto [begin, end] = shadow_around(beam_history(port, options), 11, 13);
  EXPECT_NEAR(begin, edge, cell);
  EXPECT_NEAR(end - begin, box_height * edge / (altitude - box_height), cell);

  // On the ground it ends where the line over that edge meets the bottom.
  for (const bool by_pose : {false, true}) {
    ImageOptions ground = options;
    (by_pose ? ground.bottom : ground.altitude) = by_pose ? "-5" : "5";
    const auto shadow = shadow_around(on_flat_bottom(beam_history(port, options), altitudes_of(port, ground)), 10, 12);
    EXPECT_NEAR(shadow.second, 9 * altitude / (altitude - box_height), cell);
  }

  // Starboard sees the bed alone.
  const Eigen::ArrayXd other = mean_power(beam_history(read_image_run(path("run/starboard"), ""), options));
  EXPECT_GT(other.segment(180, 60).minCoeff(), other.segment(180, 60).mean() * power_from_db(-8));

  // The swath lies across the way and straight down: beams meet the bed at altitude / cos(azimuth).
  const ImageRun swath = read_image_run(path("run/swath"), "");
  const Ping& ping = swath.cube.pings[0];
  EXPECT_LT((ping.world_from_head.linear().col(0) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  for (Eigen::Index b = 3; b < 18; ++b) {
    Eigen::ArrayXf power = Eigen::ArrayXf::Zero(ping.pressure.cols());
    for (const Ping& p : swath.cube.pings) power += p.pressure.row(b).abs2().transpose();
    Eigen::Index loudest = 0;
    power.maxCoeff(&loudest);
    const double expected = altitude / std::cos(ping.fan.azimuth[static_cast<std::size_t>(b)]);
    EXPECT_NEAR(ping.gate.centre(static_cast<std::size_t>(loudest)), expected, 0.06 * expected) << b;
  }

  succeed("image run/port --starboard run/starboard --view waterfall --altitude 5 -o ground.png --size 900x500");
  succeed("image run/port --starboard run/starboard --view waterfall -o slant.png --size 900x500");
  EXPECT_TRUE(file_exists(path("ground.png")) && file_exists(path("slant.png")));
  // The folder of the survey gives both sides as one picture, and one of the swath.
  succeed("image run --view waterfall --altitude 5 -o all.png --size 900x500");
  EXPECT_EQ(read("all-sides.png"), read("ground.png"));
  succeed("image run --head swath --view waterfall --altitude 5 -o swath.png --size 900x500");
  EXPECT_EQ(read("all-swath.png"), read("swath.png"));

  expect_refused("image run/port --altitude 5 -o x.png", 2, {"--altitude goes with --view waterfall, not fan"});
  expect_refused("image run/port --view waterfall --bottom 1 -o x.png", 2,
                 {"--bottom = 1 m puts the head of ping 0 -1 m above the bottom, must be > 0"});
  expect_refused("image run/port --view waterfall --altitude 30 -o x.png", 2, {"must be below the max range of 16 m"});
  expect_refused("image run/port --starboard run/swath --view waterfall -o x.png", 3,
                 {"port has 8 pings of 1 to 16 m"});
}

TEST_F(SideScan, mosaic_lays_the_images_on_the_bed_without_holes) {
  succeed("survey line.toml -q -o run");
  for (const std::string bed : {"", " --bottom -5"}) {
    succeed("merge -q run --mosaic 0.25" + bed);
    const LaidImages mosaic(path("run/mosaic.vti"));
    // About the axis of the beams, which look down by 30 degrees; speckle is a part of a dB, and both ways through the
    // pattern of 2 degrees hear less than one of its width.
    for (const auto& [from, to] : {std::pair(-10.0, -7.0), std::pair(-14.0, -11.0)}) {
      const auto [strength, empty] = mosaic.over(from, to);
      EXPECT_EQ(empty, 0) << bed << from;
      EXPECT_NEAR(strength, lambert_db((from + to) / 2), 1.5) << bed << from;
    }
    EXPECT_EQ(mosaic.over(-14, 14).second, 0) << bed << ": the swath closes the gap between the sides";
    const auto [shadow, no] = mosaic.over(9.75, 10.75);
    EXPECT_LT(shadow, mosaic.over(12, 13).first - 20) << bed;
    EXPECT_EQ(no, 0);
  }
  EXPECT_THAT(read("run/mosaic.pgw"), testing::StartsWith("0.25\n0\n0\n-0.25\n"));
  const std::string mean = read("run/mosaic.vti");
  succeed("merge -q run --mosaic 0.25 --bottom -5 --mosaic-by best");
  EXPECT_TRUE(read("run/mosaic.vti") != mean);
  EXPECT_EQ(LaidImages(path("run/mosaic.vti")).over(-14, 14).second, 0);
  expect_refused("merge run --bottom -5", 2, {"--bottom goes with --mosaic"});
  expect_refused("merge run --mosaic 0.25 --bottom deep", 2, {"--bottom"});
}

TEST(SideScanHistory, on_a_flat_bottom_takes_each_sample_to_its_ground_range) {
  const PingHistory ground = on_flat_bottom(ramp(), {3, 6});
  EXPECT_EQ(ground.gate.min_range, 0);
  EXPECT_NEAR(ground.gate.max_range, std::sqrt(11 * 11 - 3 * 3), 1e-12);
  // Ground 4.25 m lies 5.2 m away 3 m up, 7.35 m 6 m up; ground 9.75 m is out of reach from there.
  EXPECT_EQ(ground.level_db(0, 8), 8);
  EXPECT_EQ(ground.level_db(1, 8), 12);
  EXPECT_EQ(ground.level_db(0, 0), 4) << "the water above is left out";
  EXPECT_EQ(ground.level_db(1, 19), -200);
}

TEST(SideScanHistory, has_port_to_the_left_and_silence_before_the_first_range) {
  PingHistory starboard = ramp();
  starboard.level_db += 100;
  const PingHistory both = side_by_side(ramp(), starboard);
  ASSERT_EQ(both.level_db.cols(), 44);
  EXPECT_EQ(both.gate.min_range, -11);
  EXPECT_EQ(both.level_db(0, 0), 19);
  EXPECT_EQ(both.level_db(0, 19), 0);
  EXPECT_EQ(both.level_db(1, 21), -200);
  EXPECT_EQ(both.level_db(1, 24), 100);
  EXPECT_EQ(both.level_db(1, 43), 119);
}

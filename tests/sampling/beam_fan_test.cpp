// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/beam_fan.hpp"

#include "sampling/cast_rays_internal.hpp"
#include "sampling_scenes.hpp"
#include "support/test.hpp"

TEST(BeamFan, spreads_beams_evenly_inside_the_field_of_view) {
  const BeamFan fan = make_fan(4, 0.8, 0.1, 0.3, -0.2);
  EXPECT_THAT(fan.azimuth, testing::Pointwise(testing::DoubleNear(1e-12), {-0.3, -0.1, 0.1, 0.3}));
  EXPECT_THAT(fan.elevation, testing::Each(-0.2));
  EXPECT_EQ(make_fan(1, 2, 0.1, 0.3).azimuth, std::vector<double>{0});
}

TEST(BeamFan, says_what_is_wrong_with_it) {
  const auto message = [](const std::function<void(BeamFan&)>& damage) {
    BeamFan fan = make_fan(3, 0.8, 0.1, 0.3);
    damage(fan);
    return error_of([&] { require_valid(fan, "someone"); });
  };
  EXPECT_EQ(message([](BeamFan&) {}), "no error");
  EXPECT_THAT(message([](BeamFan& f) { f.azimuth.clear(); }), HasSubstr("someone: fan has no beams"));
  EXPECT_THAT(message([](BeamFan& f) { f.elevation.pop_back(); }), HasSubstr("fan.elevation has 2 entries"));
  EXPECT_THAT(message([](BeamFan& f) { f.azimuth[1] = 3.2; }), HasSubstr("fan.azimuth[1] = 3.2 rad"));
  for (const double wrong : {3.15, -4.0, HUGE_VAL, std::nan("")})
    EXPECT_THAT(message([&](BeamFan& f) { f.azimuth[1] = wrong; }), HasSubstr("fan.azimuth[1] = "));
  EXPECT_THAT(message([](BeamFan& f) { f.elevation[2] = -1.6; }), HasSubstr("fan.elevation[2] = -1.6 rad"));
  EXPECT_THAT(message([](BeamFan& f) { f.beam_width = 0; }), HasSubstr("fan.beam_width = 0 rad, must be > 0"));
  EXPECT_THAT(message([](BeamFan& f) { f.elevation_width = -1; }), HasSubstr("fan.elevation_width = -1 rad"));
  EXPECT_THAT(error_of([] { make_fan(0, 1, 0.1, 0.1); }), HasSubstr("beams = 0"));
  EXPECT_THAT(error_of([] { make_fan(3, 7, 0.1, 0.1); }), HasSubstr("field_of_view = 7 rad"));
}

TEST(Sector, is_the_fan_and_a_main_lobe_on_either_side) {
  const Sector s = insonified_sector(make_fan(4, 0.8, 0.1, 0.3, -0.2), 0.25);
  const double edge = std::asin(std::cos(0.2) * std::sin(0.3) + 0.15);
  EXPECT_NEAR(s.min_azimuth, -edge, 1e-12);
  EXPECT_NEAR(s.max_azimuth, edge, 1e-12);
  EXPECT_NEAR(s.min_elevation, -0.45, 1e-12);
  EXPECT_NEAR(s.max_elevation, 0.05, 1e-12);
  EXPECT_NEAR(insonified_sector(make_fan(4, 0.8, 0.1, 0.3), 0.25, 0.7).max_azimuth, std::asin(std::sin(0.3) + 0.7),
              1e-12);
  EXPECT_NEAR(insonified_sector(make_fan(4, 0.8, 0.1, 0.3), 0.25, 0.8).max_azimuth, pi / 2, 1e-12);
}

TEST(Sector, of_a_fan_that_looks_astern_crosses_pi) {
  BeamFan fan{{3.0, 3.1, -3.1, -3.0}, {0, 0, 0, 0}, 0.05, 0.3};
  const Sector s = insonified_sector(fan, 0.3);
  EXPECT_NEAR(s.min_azimuth, pi - std::asin(std::sin(3.0) + 0.075), 1e-12);
  EXPECT_NEAR(s.max_azimuth, pi + std::asin(std::sin(3.0) + 0.075), 1e-12);
}

// Compares with the rule itself: u within the beams' and a margin, ahead or astern, and an elevation.
TEST(Sector, holds_what_its_beams_receive) {
  const BeamFan ahead = make_fan(64, radians(130), radians(1), radians(20)),
                round = make_fan(64, radians(200), 0.02, 0.3);
  const SectorBounds narrow(insonified_sector(ahead, 0.6)), wide(insonified_sector(round, 0.6));
  const double edge = std::sin(ahead.azimuth.back()) + 1.5 * ahead.beam_width;
  const double astern = std::sin(round.azimuth.back()) - 1.5 * round.beam_width;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector3d p(normal(random), normal(random), normal(random));
    const double u = p.y() / p.norm();
    const bool up = std::abs(std::asin(p.z() / p.norm())) <= 0.6;
    ASSERT_EQ(narrow.holds(p), up && p.x() >= 0 && std::abs(u) <= edge) << p.transpose();
    ASSERT_EQ(wide.holds(p), up && (p.x() >= 0 || std::abs(u) >= astern)) << p.transpose();
    const Eigen::Vector3d beside =
        p + 0.3 * Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    for (const SectorBounds* bounds : {&narrow, &wide})
      ASSERT_TRUE(!bounds->holds(p) || bounds->holds(beside, 0.3001)) << p.transpose();
    const auto [low, high] = azimuths_of(insonified_sector(ahead, 0.6));
    const double azimuth = std::atan2(p.y(), p.x());
    ASSERT_TRUE(!narrow.holds(p) || (azimuth >= low && azimuth <= high));
  }
}

TEST(Cone, holds_the_direction_it_was_made_from) {
  for (const double cone : {-2.5, -1.2, 0.0, 0.7, 1.5, 2.9})
    for (const double turn : {-1.4, 0.0, 0.9}) {
      const Eigen::Vector3d p = unit_vector(direction_in_cone(cone, turn));
      EXPECT_NEAR(cone_azimuth(p), cone, 1e-9);
      EXPECT_NEAR(p.y(), std::sin(cone), 1e-12);
      const auto [low, high] = turns_between(cone, -1.5, direction_of(p).elevation);
      EXPECT_NEAR(high, turn, 1e-6);
      EXPECT_LE(low, high);
    }
}

TEST(Sector, of_a_full_circle_is_the_circle) {
  const Sector s = insonified_sector(make_fan(360, 2 * pi, radians(2), 0.3), 2);
  EXPECT_NEAR(s.max_azimuth - s.min_azimuth, 2 * pi, 1e-12);
  EXPECT_NEAR(s.max_elevation, pi / 2, 1e-12);
}

TEST(BeamCells, tile_the_sector) {
  const BeamFan irregular{{0.3, -0.2, 0.25, 0.0}, {0, 0, 0, 0}, 0.1, 0.3};
  for (const BeamFan& fan :
       {make_fan(5, 1, 0.1, 0.3), irregular, make_fan(1, 1, 0.1, 0.3), make_fan(36, 2 * pi, 0.2, 0.3)}) {
    const Sector sector = insonified_sector(fan, 0.3);
    double sum = 0;
    const auto shares = beam_cells(fan, sector);
    for (std::size_t b = 0; b < fan.beams(); ++b) {
      sum += shares[b].max_azimuth - shares[b].min_azimuth;
      const double off = std::remainder(fan.azimuth[b] - (shares[b].min_azimuth + shares[b].max_azimuth) / 2, 2 * pi);
      EXPECT_LE(std::abs(off), (shares[b].max_azimuth - shares[b].min_azimuth) / 2 + 1e-12);
    }
    EXPECT_NEAR(sum, sector.max_azimuth - sector.min_azimuth, 1e-12);
  }
}

TEST(BeamCells, of_beams_in_a_column_share_its_elevations) {
  const BeamFan grid{{0, 0, 0.1, 0.1}, {-0.1, 0.1, -0.1, 0.1}, 0.1, 0.2};
  const auto shares = beam_cells(grid, insonified_sector(grid, 0.2));
  EXPECT_NEAR(shares[0].min_elevation, -0.3, 1e-12);
  EXPECT_NEAR(shares[0].max_elevation, 0.0, 1e-12);
  EXPECT_NEAR(shares[1].max_elevation, 0.3, 1e-12);
  EXPECT_NEAR(shares[3].min_azimuth, cone_azimuth(unit_vector({0.05, 0.1})), 1e-12);
}

// Staggered rows: every direction of the sector still belongs to exactly one beam.
TEST(BeamCells, of_staggered_rows_and_of_tables_tile_the_whole_sector) {
  BeamFan staggered{{}, {}, 0.02, 0.02}, table = staggered;
  for (int b = 0; b < 40; ++b) {
    staggered.azimuth.push_back(0.01 * b), staggered.elevation.push_back(b % 2 ? 0.1 : -0.1);
    table.azimuth.push_back(0.3 * std::sin(1.7 * b)), table.elevation.push_back(0.2 * std::cos(2.9 * b));
  }
  for (const BeamFan& fan : {staggered, table}) {
    const Sector sector = insonified_sector(fan, 0.05);
    double area = 0;
    for (const BeamCell& share : beam_cells(fan, sector))
      area += (share.max_azimuth - share.min_azimuth) * (share.max_elevation - share.min_elevation);
    EXPECT_NEAR(area, (sector.max_azimuth - sector.min_azimuth) * (sector.max_elevation - sector.min_elevation), 1e-12);
  }
}

TEST(Sector, of_several_rows_reaches_beyond_the_lowest_and_the_highest) {
  const BeamFan rows{{0, 0.2, 0}, {-0.3, 0.1, 0.2}, 0.1, 0.2};
  const Sector s = insonified_sector(rows, 0.05);
  EXPECT_DOUBLE_EQ(s.min_elevation, -0.35);
  EXPECT_DOUBLE_EQ(s.max_elevation, 0.25);
}

TEST(MiddleBeam, looks_along_the_axis_of_a_fan_of_any_order_and_of_many_rows) {
  EXPECT_EQ(middle_beam(make_fan(8, 1, 0.1, 0.2)), 4U);
  EXPECT_EQ(middle_beam(make_fan(1, 0, 0.1, 0.2)), 0U);
  BeamFan fan{{}, {}, 0.1, 0.2, 0.1};
  for (const double elevation : {0.3, -0.3, 0.0})
    for (const double azimuth : {0.0, 0.4, -0.4}) {
      fan.azimuth.push_back(azimuth);
      fan.elevation.push_back(elevation);
    }
  EXPECT_EQ(middle_beam(fan), 6U);
}

TEST(FanRows, gather_beams_of_one_elevation_by_ascending_elevation) {
  const BeamFan fan{{0, 0.1, 0.2, 0.3, 0.4}, {0.5, -0.1, 0.5, -0.1, 0.2}, 0.1, 0.2};
  const std::vector<FanRow> rows = fan_rows(fan);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].elevation, -0.1);
  EXPECT_EQ(rows[0].beams, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(rows[1].beams, (std::vector<std::size_t>{4}));
  EXPECT_EQ(rows[2].beams, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(fan_rows(make_fan(7, 1, 0.1, 0.2, 0.3)).size(), 1U);
}

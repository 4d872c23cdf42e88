// SPDX-License-Identifier: BSD-3-Clause
#include "returns/image_mosaic.hpp"

#include "core/units.hpp"
#include "support/test.hpp"

namespace {

constexpr double head_altitude = 4, bin_length = 0.05;

/// Returns a ping from 4 m above the origin with the given intensity [Pa^2] over range.
Ping even_ping(const Pose& head, const BeamFan& fan, const std::function<double(double range)>& intensity) {
  Ping ping;
  ping.world_from_head = head;
  ping.fan = fan;
  ping.gate = {1, 12, bin_length};
  ping.pressure.resize(static_cast<Eigen::Index>(fan.beams()), static_cast<Eigen::Index>(ping.gate.bins()));
  for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
    ping.pressure.col(n).setConstant(
        static_cast<float>(std::sqrt(intensity(ping.gate.centre(static_cast<std::size_t>(n))))));
  return ping;
}

/// Returns a head that looks to port, tilted by 30 degrees, on a track along x.
Pose mosaic_head(double x = 0) { return pose_from_yaw_pitch_roll({x, 0, head_altitude}, pi / 2, radians(30), 0); }
BeamFan side_beam() { return make_fan(1, 0, radians(2), radians(60)); }

const MosaicSource side_scan_source{200, 0.1, bin_length};

/// Returns the value of the cell at a position; NaN where the map does not reach.
double strength_at(const MosaicMap& map, double x, double y) {
  const auto i = static_cast<Eigen::Index>(std::floor((x - map.x) / map.cell));
  const auto j = static_cast<Eigen::Index>(std::floor((y - map.y) / map.cell));
  const bool inside = i >= 0 && j >= 0 && i < map.strength_db.rows() && j < map.strength_db.cols();
  return inside ? static_cast<double>(map.strength_db(i, j)) : std::nan("");
}

}  // namespace

TEST(ImageMosaic, a_sample_lies_where_the_bed_has_its_range) {
  // One loud range of 8 m; on a bed 4 m below it is at sqrt(48) m, on one 2 m below at sqrt(60) m.
  const Ping ping =
      even_ping(mosaic_head(), side_beam(), [](double r) { return std::abs(r - 8) < 0.15 ? 1e-2 : 1e-8; });
  for (const double bed : {0.0, 2.0}) {
    ImageMosaic mosaic(0.05, MosaicRule::mean);
    mosaic.add(ping, side_scan_source, {0, 0, 0}, flat_bed(bed));
    const MosaicMap map = mosaic.map();
    const double loud = std::sqrt(64 - std::pow(head_altitude - bed, 2));
    EXPECT_GT(strength_at(map, 0, loud), strength_at(map, 0, loud - 0.4) + 40) << bed;
    EXPECT_GT(strength_at(map, 0, loud), strength_at(map, 0, loud + 0.4) + 40) << bed;
    EXPECT_TRUE(std::isnan(strength_at(map, 0, -loud))) << "starboard is not heard";
    EXPECT_TRUE(std::isnan(strength_at(map, 1, loud))) << "nor what is beside the beam";
  }
}

TEST(ImageMosaic, gives_the_strength_of_the_bed_per_area_of_the_resolution_cell) {
  // The sonar equation gives the intensity of a strength of -20 dB per square metre, everywhere.
  constexpr double strength_db = -20, equivalent = 1.0644670194312262;
  const double width = equivalent * radians(2), dr = equivalent * bin_length;
  const auto intensity = [&](double r) {
    const double sine = std::sqrt(std::max(0.0, 1 - std::pow(head_altitude / r, 2)));
    const double area = std::min(dr / sine, 2 * std::sqrt(2 * r * dr)) * r * width;
    const double level = 200 + strength_db - 40 * std::log10(r) - 2 * 0.1 * r + 10 * std::log10(area);
    return 2 * micropascal * micropascal * power_from_db(level);
  };
  ImageMosaic mosaic(0.1, MosaicRule::mean);
  mosaic.add(even_ping(mosaic_head(), side_beam(), intensity), side_scan_source, {0, 0, 0}, flat_bed(0));
  const MosaicMap map = mosaic.map();
  for (const double y : {2.05, 4.05, 8.05, 11.05}) EXPECT_NEAR(strength_at(map, 0, y), strength_db, 0.1) << y;
}

// Received through a pattern the bed has the same strength; where the pattern is below -20 dB it has none.
TEST(ImageMosaic, takes_the_elevation_pattern_out_of_the_levels) {
  constexpr double tilt = radians(30), width = radians(40);
  const auto mosaic_of = [&](ElevationShape shape, double compensated_width) {
    // The response at the elevation of the bed at range r, for a head 4 m up that looks 30 degrees down.
    const auto intensity = [&](double r) {
      const double elevation = -std::asin(std::min(1.0, head_altitude / r)) + tilt;
      const double sine = std::sqrt(std::max(1e-12, 1 - std::pow(head_altitude / r, 2)));
      constexpr double equivalent = 1.0644670194312262;
      const double dr = equivalent * bin_length;
      const double area = std::min(dr / sine, 2 * std::sqrt(2 * r * dr)) * r * equivalent * radians(2);
      const double level = 200 - 20 - 40 * std::log10(r) - 2 * 0.1 * r + 10 * std::log10(area);
      return 2 * micropascal * micropascal * power_from_db(level) *
             std::pow(elevation_response(shape, width, elevation), 2);
    };
    MosaicSource source = side_scan_source;
    source.elevation_shape = shape;
    source.elevation_width = compensated_width;
    ImageMosaic mosaic(0.1, MosaicRule::mean);
    mosaic.add(even_ping(mosaic_head(), side_beam(), intensity), source, {0, 0, 0}, flat_bed(0));
    return mosaic.map();
  };
  for (const ElevationShape shape : {ElevationShape::gaussian, ElevationShape::line}) {
    const MosaicMap compensated = mosaic_of(shape, width), plain = mosaic_of(shape, 0);
    // 27 to 63 degrees down: up to 33 degrees off the axis, 33 dB down through a Gaussian of 40 degrees at most.
    for (const double y : {3.05, 5.05, 7.05, 11.05}) EXPECT_NEAR(strength_at(compensated, 0, y), -20, 0.4) << y;
    EXPECT_LT(strength_at(plain, 0, 3.05), -22);
    EXPECT_NEAR(strength_at(plain, 0, 7.05), -20, 0.5) << "on the axis";
  }
  // A sector of 40 degrees ends 50 degrees down, 3.36 m across.
  const MosaicMap sector = mosaic_of(ElevationShape::sector, width);
  EXPECT_TRUE(std::isnan(strength_at(sector, 0, 3.15)));
  EXPECT_NEAR(strength_at(sector, 0, 3.75), -20, 0.4);
}

TEST(ImageMosaic, a_ping_stands_for_the_strip_half_way_to_its_neighbours) {
  const auto beam_azimuth = [](const Eigen::Vector3d& strip) {
    ImageMosaic mosaic(0.1, MosaicRule::mean);
    mosaic.add(even_ping(mosaic_head(), side_beam(), [](double) { return 1e-4; }), side_scan_source, strip,
               flat_bed(0));
    const MosaicMap map = mosaic.map();
    int cells = 0;
    for (double x = -1.95; x < 2; x += 0.1) cells += std::isfinite(strength_at(map, x, 3.05));
    return cells;
  };
  // Two degrees at 5 m are 0.17 m.
  EXPECT_NEAR(beam_azimuth({0, 0, 0}), 2, 1);
  EXPECT_NEAR(beam_azimuth({0.5, 0, 0}), 12, 1);
  // A head that looks along its way sweeps none.
  EXPECT_NEAR(beam_azimuth({0, 0.5, 0}), 2, 1);
}

TEST(ImageMosaic, takes_the_mean_of_all_pings_or_the_ping_with_the_narrowest_beam) {
  const auto map_of = [](MosaicRule rule) {
    ImageMosaic mosaic(0.2, rule);
    for (const auto& [altitude, intensity] : {std::pair(4.0, 1e-4), std::pair(2.0, 1e-8)}) {
      const double power = intensity;
      const Pose head = pose_from_yaw_pitch_roll({0, 0, altitude}, pi / 2, radians(30), 0);
      mosaic.add(even_ping(head, side_beam(), [&](double) { return power; }), side_scan_source, {0.3, 0, 0},
                 flat_bed(0), 3);
    }
    return mosaic.map();
  };
  const double mean = strength_at(map_of(MosaicRule::mean), 0, 5.1),
               best = strength_at(map_of(MosaicRule::best), 0, 5.1);
  EXPECT_GT(mean, best + 20) << "the nearer ping is fainter";
  EXPECT_TRUE(std::isfinite(best));
}

TEST(ImageMosaic, of_a_swath_is_as_wide_as_its_outermost_beams) {
  const BeamFan fan = make_fan(101, radians(101), radians(1.5), radians(1.5));
  const Pose down = pose_from_yaw_pitch_roll({0, 0, head_altitude}, 0, pi / 2, 0);
  ImageMosaic mosaic(0.05, MosaicRule::mean);
  mosaic.add(even_ping(down, fan, [](double) { return 1e-4; }), side_scan_source, {0.2, 0, 0}, flat_bed(0));
  const MosaicMap map = mosaic.map();
  // Beams at +-50 degrees, which reach half a beam width further.
  const double edge = head_altitude * std::tan(radians(50) + radians(0.75) / std::cos(radians(50)));
  EXPECT_NEAR(map.y, -edge, 0.06);
  EXPECT_NEAR(map.y + static_cast<double>(map.strength_db.cols()) * map.cell, edge, 0.06);
  // Ranges do not tell elevations apart, so that the pattern along the way stays in the samples.
  MosaicSource narrow = side_scan_source;
  narrow.elevation_width = radians(1.5);
  ImageMosaic with_pattern(0.05, MosaicRule::mean);
  with_pattern.add(even_ping(down, fan, [](double) { return 1e-4; }), narrow, {0.2, 0, 0}, flat_bed(0));
  EXPECT_EQ(strength_at(with_pattern.map(), 0.03, 2.03), strength_at(map, 0.03, 2.03));
  int holes = 0;
  for (double y = -edge + 0.1; y < edge - 0.1; y += 0.05)
    for (const double x : {-0.17, 0.03, 0.17}) holes += std::isnan(strength_at(map, x, y));
  EXPECT_EQ(holes, 0);
}

TEST(ImageMosaic, refuses_what_cannot_be) {
  EXPECT_THAT(error_of([] { ImageMosaic(0, MosaicRule::mean); }), HasSubstr("cell = 0 m"));
  ImageMosaic fine(1e-4, MosaicRule::mean);
  const Ping ping = even_ping(mosaic_head(), side_beam(), [](double) { return 1.0; });
  EXPECT_THAT(error_of(
                  [&] {
                    fine.add(ping, side_scan_source, {0, 0, 0}, flat_bed(0));
                  },
                  ErrorKind::content),
              HasSubstr("more than 2^26 cells for ping 0"));
  EXPECT_THAT(error_of([] { ImageMosaic(1, MosaicRule::mean).map(); }, ErrorKind::content), HasSubstr("no ping"));
}

TEST(BedSurface, is_the_mean_of_the_points_and_goes_on_between_them) {
  BedPoints points({0, 0}, {7.5, 3.5}, 1);
  for (const double z : {-4.0, -6.0}) points.add({0.5, 0.5, z});
  points.add({7.5, 3.5, -9});
  const BedSurface bed = points.surface();
  EXPECT_EQ(bed.at(0.5, 0.5), -5);
  EXPECT_EQ(bed.at(-10, -10), -5) << "beyond the edge as at it";
  EXPECT_EQ(bed.at(7.5, 3.5), -9);
  for (double x = 0.5; x < 7.5; x += 0.25) {
    EXPECT_LE(bed.at(x, 2), -5);
    EXPECT_GE(bed.at(x, 2), -9);
    EXPECT_LE(std::abs(bed.at(x + 0.25, 2) - bed.at(x, 2)), 1.01) << "without steps";
  }
  EXPECT_EQ(flat_bed(-3).at(100, 7), -3);
  EXPECT_THAT(error_of([] { BedPoints({0, 0}, {1, 1}, 1).surface(); }, ErrorKind::content), HasSubstr("no points"));
  EXPECT_THAT(error_of([] { BedPoints({0, 0}, {1e6, 1e6}, 1); }), HasSubstr("at most 2^26"));
}

// SPDX-License-Identifier: BSD-3-Clause
#include "core/geodesy.hpp"

#include "core/random.hpp"
#include "support/errors.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;
using testing::HasSubstr;

namespace {

/// Returns the length of the meridian from the equator [m], by Simpson's rule over its radius of curvature.
double meridian_arc(double latitude) {
  constexpr int steps = 2000;
  constexpr double e2 = wgs84_flattening * (2 - wgs84_flattening);
  const auto radius = [](double p) {
    return wgs84_semi_major_axis * (1 - e2) / std::pow(1 - e2 * std::sin(p) * std::sin(p), 1.5);
  };
  double sum = 0;
  for (int k = 0; k <= steps; ++k) sum += radius(latitude * k / steps) * (k == 0 || k == steps ? 1 : k % 2 ? 4 : 2);
  return sum * latitude / steps / 3;
}

constexpr UtmZone zone_32n{32, true};

}  // namespace

TEST(Geodesy, earth_centred_coordinates_of_known_places) {
  // On the equator, at the pole (semi-minor axis of the definition of WGS 84), and 1000 m above it.
  EXPECT_LT((ecef_of({0, 0, 0}) - Vector3d(6378137, 0, 0)).norm(), 1e-9);
  EXPECT_LT((ecef_of({0, pi / 2, 10}) - Vector3d(0, 6378147, 0)).norm(), 1e-9);
  EXPECT_LT((ecef_of({pi / 2, 0, 1000}) - Vector3d(0, 0, 6356752.314245 + 1000)).norm(), 1e-6);
  for (const double latitude : {-89.99, -37.0, 0.0, 12.5, 54.1, 89.0})
    for (const double height : {-11000.0, 0.0, 9000.0}) {
      const GeoPosition back = geo_position_of(ecef_of({radians(latitude), radians(-122), height}));
      EXPECT_NEAR(degrees(back.latitude), latitude, 1e-13);
      EXPECT_NEAR(degrees(back.longitude), -122, 1e-13);
      EXPECT_NEAR(back.height, height, 1e-8);
    }
}

TEST(Geodesy, the_world_lies_along_the_anchors_heading) {
  // x axis 30 degrees east of north: 100 m ahead are 86.6 m north and 50 m east; y is to the left of it.
  const Anchor anchor{54.1, 7.9, 30};
  const GeoPosition ahead = geo_from_world(anchor, {100, 0, 0}), port = geo_from_world(anchor, {0, 100, 0});
  const double m_per_deg_north = (meridian_arc(radians(54.6)) - meridian_arc(radians(53.6)));
  const double m_per_deg_east = Vector3d(ecef_of({radians(54.1), radians(7.9), 0})).head<2>().norm() * radians(1);
  const double long_leg = 50 * std::sqrt(3.0), short_leg = 50;
  EXPECT_NEAR((degrees(ahead.latitude) - 54.1) * m_per_deg_north, long_leg, 2e-3);
  EXPECT_NEAR((degrees(ahead.longitude) - 7.9) * m_per_deg_east, short_leg, 2e-3);
  EXPECT_NEAR((degrees(port.latitude) - 54.1) * m_per_deg_north, short_leg, 2e-3);
  EXPECT_NEAR((degrees(port.longitude) - 7.9) * m_per_deg_east, -long_leg, 2e-3);
  EXPECT_NEAR(geo_from_world(anchor, {0, 0, -20}).height, -20, 1e-9);
  // A tangent plane leaves the ellipsoid as d^2 / 2R.
  EXPECT_NEAR(geo_from_world(anchor, {1000, 0, 0}).height, 1e6 / (2 * 6.38e6), 3e-4);
  EXPECT_NEAR(degrees(heading_of({{}, anchor}, {3, 4, -5}, {0, -1, 0})), 120, 1e-4);
  for (const Vector3d& p : {Vector3d(1, 2, 3), Vector3d(-5000, 800, -60), Vector3d(20000, 20000, 0)})
    EXPECT_LT((world_from_geo(anchor, geo_from_world(anchor, p)) - p).norm(), 2e-8);
}

TEST(Geodesy, worlds_far_from_their_anchor_and_heights_beyond_mountains_are_refused) {
  const Georeference anchored{{}, {54.1, 7.9, 30}}, zone{zone_32n};
  EXPECT_NO_THROW(require_plausible(anchored, {70e3, 70e3, -20}, "--anchor"));
  EXPECT_THAT(error_of([&] {
                require_plausible(anchored, {71e3, 71e3, -20}, "--anchor");
              }),
              HasSubstr("100 km from its origin"));
  EXPECT_NO_THROW(require_plausible(zone, {500000, 6e6, 8999}, "--utm"));
  EXPECT_NO_THROW(require_plausible(zone, {500000, 6e6, -10900}, "--utm"));
  EXPECT_THAT(error_of([&] {
                require_plausible(zone, {500000, 6e6, 9001}, "--utm");
              }),
              HasSubstr("--utm: a height of 9001 m, must be at most 9000 m"));
  EXPECT_EQ(utm_zone_with(32632), zone_32n);
  EXPECT_EQ(utm_zone_with(32719), (UtmZone{19, false}));
  for (const int other : {0, 25832, 32600, 32661, 32761, 4326}) EXPECT_FALSE(utm_zone_with(other)) << other;
}

TEST(Geodesy, the_middle_of_a_zone_is_a_scaled_meridian) {
  for (const double latitude : {-80.0, -1.0, 0.0, 33.0, 54.1, 84.0}) {
    const UtmPosition north = utm_position_of({radians(latitude), radians(9), 0}, zone_32n);
    EXPECT_NEAR(north.easting, 500000, 1e-8);
    EXPECT_NEAR(north.northing, 0.9996 * meridian_arc(radians(latitude)), 1e-6);
    EXPECT_NEAR(utm_position_of({radians(latitude), radians(9), 0}, {32, false}).northing - north.northing, 1e7, 1e-6);
  }
}

TEST(Geodesy, the_projection_is_conformal) {
  // With the scaled meridian this determines the projection: a step north and a step east stay at right angles and are
  // scaled alike, everywhere.
  for (const double latitude : {-60.0, 10.0, 54.0})
    for (const double longitude : {6.0, 7.3, 12.0, 25.0}) {
      const GeoPosition at{radians(latitude), radians(longitude), 0};
      const double step = 1e-5;
      const auto difference = [&](double dp, double dl) {
        const UtmPosition a = utm_position_of({at.latitude + dp, at.longitude + dl, 0}, zone_32n);
        const UtmPosition b = utm_position_of({at.latitude - dp, at.longitude - dl, 0}, zone_32n);
        const double ground =
            (ecef_of({at.latitude + dp, at.longitude + dl, 0}) - ecef_of({at.latitude - dp, at.longitude - dl, 0}))
                .norm();
        return Eigen::Vector2d((a.easting - b.easting) / ground, (a.northing - b.northing) / ground);
      };
      const Eigen::Vector2d north = difference(step, 0), east = difference(0, step / std::cos(at.latitude));
      EXPECT_NEAR(north.x(), -east.y(), 1e-8) << latitude << ' ' << longitude;
      EXPECT_NEAR(north.y(), east.x(), 1e-8) << latitude << ' ' << longitude;
    }
}

TEST(Geodesy, a_published_place_in_its_zone) {
  // The CN Tower of Toronto: 43 38' 33.24" N, 79 23' 13.7" W is 630 084 m E, 4 833 438 m N of zone 17 (whole metres).
  const GeoPosition tower{radians(43 + 38 / 60.0 + 33.24 / 3600), -radians(79 + 23 / 60.0 + 13.7 / 3600), 0};
  EXPECT_EQ(utm_zone_of(tower), (UtmZone{17, true}));
  EXPECT_EQ(epsg_code(utm_zone_of(tower)), 32617);
  const UtmPosition utm = utm_position_of(tower, {17, true});
  EXPECT_NEAR(utm.easting, 630084, 1);
  EXPECT_NEAR(utm.northing, 4833438, 1);
}

TEST(Geodesy, utm_and_back) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto [a, b, unused, none] = random_uniform(7, RandomStage::noise, {i, 0, 0});
    const UtmZone zone{19, i % 2 == 0};
    const GeoPosition position{radians(-80 + 164 * a), radians(-69 + 20 * (2 * b - 1)), 0};
    const GeoPosition back = geo_position_of(utm_position_of(position, zone), zone);
    EXPECT_NEAR(back.latitude, position.latitude, 1e-13);
    EXPECT_NEAR(back.longitude, position.longitude, 1e-13);
  }
  EXPECT_EQ(utm_zone_of({0, pi, 0}).number, 1);
  EXPECT_EQ(utm_zone_of({-0.1, -pi, 0}), (UtmZone{1, false}));
}

TEST(Geodesy, convergence_turns_the_headings_of_a_zone) {
  // East of its middle grid north lies east of true north by atan(tan(longitude from the middle) sin(latitude)).
  const UtmPosition position = utm_position_of({radians(54), radians(12), 0}, zone_32n);
  const double gamma = std::atan(std::tan(radians(3)) * std::sin(radians(54)));
  EXPECT_NEAR(heading_of({zone_32n, {}}, {position.easting, position.northing, -5}, {0, 1, 0}), gamma, 2e-6);
}

TEST(Geodesy, refuses_what_is_no_place) {
  EXPECT_EQ(parse_anchor("54.1, 7.9", "--anchor").longitude_deg, 7.9);
  EXPECT_EQ(parse_anchor("54.1,7.9,30", "--anchor").heading_deg, 30);
  for (const char* text : {"", "54.1", "54.1,", "a,b", "1,2,3,4", "1;2"})
    EXPECT_THAT(error_of([&] { parse_anchor(text, "--anchor"); }), HasSubstr("must be LAT,LON[,HEADING] in degrees"));
  EXPECT_EQ(error_of([] { parse_anchor("91,0", "--anchor"); }),
            "--anchor: latitude = 91 deg, must be within -90 and 90");
  EXPECT_EQ(parse_utm_zone("32N", "--utm"), zone_32n);
  EXPECT_EQ(parse_utm_zone("19s", "--utm"), (UtmZone{19, false}));
  for (const char* text : {"", "N", "0N", "61S", "32", "32A", "N32"})
    EXPECT_THAT(error_of([&] { parse_utm_zone(text, "--utm"); }),
                HasSubstr("must be a number from 1 to 60 and N or S"));
  EXPECT_THAT(error_of([] { parse_utm_zone("12T", "--utm"); }), HasSubstr("T is a band of MGRS"));
  EXPECT_THAT(error_of([] { parse_utm_zone("12T", "--utm"); }), HasSubstr("zone 12N"));
  EXPECT_THAT(error_of([] { parse_utm_zone("19k", "--utm"); }), HasSubstr("zone 19S"));
  EXPECT_THAT(error_of([] { utm_position_of({0.5, 2.0, 0}, zone_32n); }), HasSubstr("must be within 60 deg"));
}

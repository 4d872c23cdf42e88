#include "core/geodesy.hpp"

#include "core/units.hpp"
#include "support/test.hpp"

namespace {

constexpr double equator = 6378137, flattened = 1 / 298.257223563, e2 = flattened * (2 - flattened);

/// Geocentric place, by the textbook's formula.
Eigen::Vector3d geocentric(const GeodeticPlace& p) {
  const double lat = radians(p.latitude_deg), lon = radians(p.longitude_deg);
  const double n = equator / std::sqrt(1 - e2 * std::pow(std::sin(lat), 2));
  return {(n + p.height) * std::cos(lat) * std::cos(lon), (n + p.height) * std::cos(lat) * std::sin(lon),
          ((1 - e2) * n + p.height) * std::sin(lat)};
}

const Anchor somewhere{53.5, 8.25, 30};

}  // namespace

TEST(Geodesy, the_origin_is_the_anchor) {
  for (const double latitude : {-90.0, -45.0, 0.0, 53.5, 89.999, 90.0}) {
    const GeodeticPlace p = geodetic_of({latitude, 8.25, 77}, {0, 0, 0});
    EXPECT_NEAR(p.latitude_deg, latitude, 1e-12);
    EXPECT_NEAR(p.longitude_deg, 8.25, 1e-12);
    EXPECT_NEAR(p.height, 0, 1e-8);
  }
  EXPECT_NEAR(geodetic_of(somewhere, {0, 0, -42}).height, -42, 1e-8);
}

// Distances between any two places are those in the world: the projection is rigid.
TEST(Geodesy, keeps_all_distances) {
  const std::vector<Eigen::Vector3d> places = {
      {0, 0, 0}, {1000, 0, -20}, {0, 3000, 5}, {-2e5, 1e5, -4000}, {3e6, -2e6, 1e5}};
  for (const auto& p : places)
    for (const auto& q : places)
      EXPECT_NEAR((geocentric(geodetic_of(somewhere, p)) - geocentric(geodetic_of(somewhere, q))).norm(),
                  (p - q).norm(), 1e-7);
}

// A metre along the meridian and across it is one over the radii of curvature.
TEST(Geodesy, x_points_along_the_heading_and_y_to_its_left) {
  const double lat = radians(53.5), n = equator / std::sqrt(1 - e2 * std::pow(std::sin(lat), 2));
  const double m = equator * (1 - e2) / std::pow(1 - e2 * std::pow(std::sin(lat), 2), 1.5);
  const auto moved = [](double heading, const Eigen::Vector3d& to) {
    const GeodeticPlace p = geodetic_of({53.5, 8.25, heading}, to);
    return std::pair(radians(p.latitude_deg - 53.5), radians(p.longitude_deg - 8.25));
  };
  const auto [north, none] = moved(0, {1, 0, 0});
  EXPECT_NEAR(north * m, 1, 1e-6);
  EXPECT_NEAR(none, 0, 1e-14);
  const auto [still, west] = moved(0, {0, 1, 0});
  EXPECT_NEAR(west * n * std::cos(lat), -1, 1e-6);
  EXPECT_NEAR(still * m, 0, 1e-6);
  const auto [up, east] = moved(90, {1, 0, 0});
  EXPECT_NEAR(east * n * std::cos(lat), 1, 1e-6);
  EXPECT_NEAR(up * m, 0, 1e-6);
}

TEST(Geodesy, longitudes_go_on_across_the_date_line_and_the_pole) {
  EXPECT_LT(geodetic_of({10, 179.9999, 90}, {1000, 0, 0}).longitude_deg, -179.9);
  const GeodeticPlace beyond = geodetic_of({89.999, 8, 0}, {1000, 0, 0});
  EXPECT_NEAR(beyond.longitude_deg, -172, 1e-9);
  EXPECT_THAT(error_of([] { geodetic_of({91, 0, 0}, {0, 0, 0}); }), HasSubstr("latitude 91"));
}

TEST(Utc, goes_on_over_days_and_years) {
  EXPECT_EQ(utc_after("2026-05-01T08:30:00Z", 0), "2026-05-01T08:30:00.000Z");
  EXPECT_EQ(utc_after("2026-12-31T23:59:59.5Z", 0.75), "2027-01-01T00:00:00.250Z");
  EXPECT_EQ(utc_after("2024-02-28T12:00:00Z", 86400), "2024-02-29T12:00:00.000Z");
  EXPECT_EQ(utc_after("2026-03-01T00:00:00Z", -0.001), "2026-02-28T23:59:59.999Z");
  for (const char* bad :
       {"2026-13-01T00:00:00Z", "2026-02-30T00:00:00Z", "2026-05-01T24:00:00Z", "2026-05-01", "2026-05-01T08:30:00"})
    EXPECT_THAT(error_of([&] { utc_after(bad, 0); }), HasSubstr(bad));
}

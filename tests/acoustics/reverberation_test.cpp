// SPDX-License-Identifier: BSD-3-Clause
// Tests places and times of reverberation of every kind, and refusals.
#include "acoustics/reverberation_bench.hpp"

namespace insonify::reverberation_tests {

bool equal(const Echoes& a, const Echoes& b) {
  return a.delay == b.delay && a.u == b.u && a.v == b.v && a.amplitude == b.amplitude;
}

TEST(Reverberation, of_water_and_surface_is_new_in_every_ping) {
  const RangeGate gate{9, 9.2, 0.01};
  const auto volume = [&](std::int64_t ping) {
    return volume_echoes(environment(), fan_of(10), gate, transmission(1, 0.3), {.ping = ping});
  };
  const auto surface = [&](std::int64_t ping) {
    return surface_echoes(environment(), at(0, 0, -2), fan_of(10), gate, transmission(), {.ping = ping});
  };
  EXPECT_TRUE(equal(volume(3), volume(3)));
  EXPECT_TRUE(equal(surface(3), surface(3)));
  std::complex<double> volumes = 0, surfaces = 0;
  double volume_power = 0, surface_power = 0;
  const Echoes v1 = volume(1), v2 = volume(2), s1 = surface(1), s2 = surface(2);
  for (std::size_t i = 0; i < v1.size(); ++i) {
    volumes += v1.amplitude[i] * std::conj(v2.amplitude[i]);
    volume_power += std::norm(v1.amplitude[i]);
  }
  for (std::size_t i = 0; i < std::min(s1.size(), s2.size()); ++i) {
    surfaces += s1.amplitude[i] * std::conj(s2.amplitude[i]);
    surface_power += std::norm(s1.amplitude[i]);
  }
  EXPECT_LT(std::abs(volumes) / volume_power, 0.1);
  EXPECT_LT(std::abs(surfaces) / surface_power, 0.1);
}

TEST(Reverberation, of_the_bottom_stays_while_the_head_does) {
  const RangeGate gate{9, 9.2, 0.01};
  const auto bottom = [&](const Pose& pose, std::int64_t ping) {
    return bottom_echoes(environment(), pose, fan_of(40), gate, transmission(), {.ping = ping});
  };
  const Echoes first = bottom(at(1, 2, -7), 1);
  EXPECT_TRUE(equal(first, bottom(at(1, 2, -7), 2)));

  // Turned by 10 of 42 degrees, three quarters of the cells are the same, in other directions.
  std::map<double, std::complex<double>> by_delay;
  for (std::size_t i = 0; i < first.size(); ++i) by_delay[first.delay[i]] = first.amplitude[i];
  const auto shared_with = [&](const Echoes& e) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
      const auto same = by_delay.find(e.delay[i]);
      if (same != by_delay.end()) shared += std::abs(same->second - e.amplitude[i]) < 1e-9 * std::abs(e.amplitude[i]);
    }
    return static_cast<double>(shared) / static_cast<double>(e.size());
  };
  EXPECT_NEAR(shared_with(bottom(at(1, 2, -7, 10), 1)), 32.0 / 42, 0.05);
  EXPECT_EQ(shared_with(bottom(at(1.5, 2, -7), 1)), 0);
}

TEST(Reverberation, of_a_part_of_the_gate_is_that_part) {
  const auto cells = [](const RangeGate& gate) {
    std::map<double, std::complex<double>> found;
    const Echoes e = surface_echoes(environment(), at(0, 0, -2), fan_of(10), gate, transmission());
    for (std::size_t i = 0; i < e.size(); ++i)
      if (std::abs(750 * e.delay[i] - 10) < 0.1) found[e.delay[i]] = e.amplitude[i];
    return found;
  };
  EXPECT_GT(cells({9, 11, 0.01}).size(), 100u);
  EXPECT_EQ(cells({9, 11, 0.01}), cells({9.7, 20, 0.02}));
}

TEST(Reverberation, fills_the_sector_of_the_fan_and_no_more) {
  for (const double pitch : {0.0, 25.0}) {
    const Echoes e = surface_echoes(environment(), at(0, 0, -2, 0, -pitch), fan_of(40), {9, 9.5, 0.01}, transmission());
    double least = 10, most = -10;
    for (std::size_t i = 0; i < e.size(); ++i) {
      least = std::min(least, std::asin(e.u[i]));
      most = std::max(most, std::asin(e.u[i]));
    }
    // Half the field of view, less half a beam, 1.5 beam widths of u and a cell.
    EXPECT_NEAR(degrees(most), 21.4, 0.6) << pitch;
    EXPECT_NEAR(degrees(least), -21.4, 0.6) << pitch;
  }
}

TEST(Reverberation, does_not_depend_on_the_thread_count) {
  const RangeGate gate{5, 9, 0.01};
  Transmission sent = transmission(1, radians(20));
  Echoes first[3];
  for (const int threads : {1, 2, 7}) {
    sent.echo_options.threads = threads;
    const Echoes now[] = {volume_echoes(environment(), fan_of(10), gate, sent),
                          surface_echoes(environment(), at(0, 0, -2), fan_of(10), gate, sent),
                          bottom_echoes(environment(), at(0, 0, -7, 0, 20), fan_of(10), gate, sent)};
    for (int k = 0; k < 3; ++k) {
      if (threads == 1) first[k] = now[k];
      EXPECT_GT(now[k].size(), 1000u);
      EXPECT_TRUE(equal(now[k], first[k])) << k << " " << threads;
    }
  }
}

TEST(Reverberation, refuses_missing_boundaries) {
  const RangeGate gate{5, 9, 0.01};
  const BeamFan fan = fan_of(10);
  EXPECT_EQ(error_of([&] { volume_echoes({}, fan, gate, transmission()); }),
            "volume_echoes: environment has no volume_scattering_db");
  EXPECT_EQ(error_of([&] { surface_echoes({}, at(0, 0, -2), fan, gate, transmission()); }),
            "surface_echoes: environment has no surface.scattering_strength_db");
  EXPECT_EQ(error_of([&] { bottom_echoes({}, at(0, 0, -2), fan, gate, transmission()); }),
            "bottom_echoes: environment has no bottom.lambert_mu");
  EXPECT_EQ(error_of([&] { surface_echoes(environment(), at(0, 0, 1), fan, gate, transmission()); }),
            "surface_echoes: the head stands at height 1 m, must be below surface.height = 0 m");
  EXPECT_EQ(error_of([&] { bottom_echoes(environment(), at(0, 0, -11), fan, gate, transmission()); }),
            "bottom_echoes: the head stands at height -11 m, must be above bottom.height = -10 m");
  EXPECT_THAT(error_of([&] { volume_echoes(environment(), fan, gate, transmission(), {.cells_per_resolution = 0}); }),
              HasSubstr("options.cells_per_resolution = 0, must be finite and > 0"));
  EXPECT_THAT(error_of([&] {
                volume_echoes(environment(), fan, {1, 1e6, 1}, transmission());
              }),
              HasSubstr("must be at most 2^27; lower cells_per_resolution or max_range"));
}

TEST(Reverberation, is_silent_where_the_gate_ends_before_the_boundary) {
  EXPECT_EQ(bottom_echoes(environment(), at(0, 0, -2), fan_of(10), {1, 7, 0.01}, transmission()).size(), 0u);
  EXPECT_EQ(surface_echoes(environment(), at(0, 0, -9), fan_of(10), {1, 7, 0.01}, transmission()).size(), 0u);
}

// Independent evaluation of the published formula: wind 10 and 20 knots.
TEST(ChapmanHarris, gives_the_checked_values) {
  const double knot = 1852.0 / 3600;
  EXPECT_NEAR(chapman_harris_strength_db(1000, 10 * knot, radians(10)), -58.65, 0.006);
  EXPECT_NEAR(chapman_harris_strength_db(1000, 10 * knot, radians(30)), -41.44, 0.006);
  EXPECT_NEAR(chapman_harris_strength_db(4000, 10 * knot, radians(10)), -49.67, 0.006);
  EXPECT_NEAR(chapman_harris_strength_db(1000, 20 * knot, radians(30)), -34.04, 0.006);
}

TEST(ChapmanHarris, refuses_values_without_a_meaning) {
  EXPECT_EQ(error_of([] { chapman_harris_strength_db(0, 5, 0.2); }),
            "chapman_harris_strength_db: frequency = 0 Hz, must be finite and > 0");
  EXPECT_EQ(error_of([] { chapman_harris_strength_db(1000, 0, 0.2); }),
            "chapman_harris_strength_db: wind_speed = 0 m/s, must be finite and > 0");
  EXPECT_EQ(error_of([] { chapman_harris_strength_db(1000, 5, 0); }),
            "chapman_harris_strength_db: grazing = 0 rad, must be > 0 and at most pi/2");
}

}  // namespace insonify::reverberation_tests

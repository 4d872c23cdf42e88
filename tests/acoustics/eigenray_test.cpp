// SPDX-License-Identifier: BSD-3-Clause
// Compares rays from one depth to another through a profile with closed forms and a march.
#include "acoustics/profiles.hpp"

namespace insonify::bent {

// Returns the time of the arc between two points of water with c = c1 + g (z - z1), from its closed form.
double one_gradient_time(double c1, double c2, double g, double dx, double dz) {
  const long double gl = g, y = gl * gl * (static_cast<long double>(dx) * dx + static_cast<long double>(dz) * dz) /
                                (2.0L * c1 * c2);
  return static_cast<double>(std::log1p(y + std::sqrt(y * (2 + y))) / gl);  // acosh(1 + y)
}

/// State of a ray.
struct RayState {
  double x = 0, z = 0, slope = 0;  ///< slope [rad], positive down
  double time = 0;
};

double gradient_at(const SoundSpeedProfile& p, double z) {
  const double h = 1e-5;
  return (sound_speed_at(p, z + h) - sound_speed_at(p, z - h)) / (2 * h);
}

// Integrates dx = cos ds, dz = sin ds, dslope = -cos(slope) c'/c ds, by Runge and Kutta with fixed steps, until
// x = `end`. Steps that straddle a kink of the profile are of second order: they are kept small.
RayState march(const SoundSpeedProfile& p, double z, double slope, double end, int steps) {
  RayState s{0, z, slope, 0};
  const double h = end / steps;
  const auto rate = [&](const RayState& r) {  // per metre of x
    const double c = sound_speed_at(p, r.z);
    return RayState{1, std::tan(r.slope), -gradient_at(p, r.z) / c, 1 / (c * std::cos(r.slope))};
  };
  const auto moved = [](const RayState& r, const RayState& k, double by) {
    return RayState{r.x + by * k.x, r.z + by * k.z, r.slope + by * k.slope, r.time + by * k.time};
  };
  for (int i = 0; i < steps; ++i) {
    const RayState k1 = rate(s), k2 = rate(moved(s, k1, h / 2)), k3 = rate(moved(s, k2, h / 2)),
                   k4 = rate(moved(s, k3, h));
    for (const auto& [k, w] : {std::pair{k1, 1.0}, {k2, 2.0}, {k3, 2.0}, {k4, 1.0}}) s = moved(s, k, h * w / 6);
  }
  return s;
}

std::string refusal(const SoundSpeedProfile& p, double from, double to, double horizontal) {
  return error_with_kind([&] { find_eigenray(p, from, to, horizontal); });
}

const SoundSpeedProfile one_gradient{{-1e4, 1e4}, {1300, 1700}};  // 0.02 /s

TEST(FindEigenray, is_the_straight_line_where_sound_speed_is_the_same) {
  for (const SoundSpeedProfile& p : {SoundSpeedProfile{{7}, {1500}}, SoundSpeedProfile{{0, 5, 9}, {1500, 1500, 1500}}})
    for (const auto& [from, to, x] :
         {std::array{2.0, 11.0, 30.0}, {2.0, 2.0, 30.0}, {5.0, 5.0, 1.0}, {11.0, -2.0, 1e-3}, {6.0, 6.5, 1e5}}) {
      const Eigenray ray = find_eigenray(p, from, to, x);
      EXPECT_NEAR(ray.travel_time, std::hypot(x, to - from) / 1500, 1e-15 * std::hypot(x, to - from) / 1500 * 2);
      EXPECT_NEAR(ray.elevation, std::atan2(from - to, x), 1e-14);
    }
}

TEST(FindEigenray, follows_the_closed_form_of_one_gradient) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const double from = 200 * unit(random), to = 200 * unit(random), x = std::pow(10, 4 * unit(random) - 1);
    const double c1 = sound_speed_at(one_gradient, from), c2 = sound_speed_at(one_gradient, to);
    const double expected = one_gradient_time(c1, c2, 0.02, x, to - from);
    EXPECT_NEAR(find_eigenray(one_gradient, from, to, x).travel_time / expected, 1, 1e-12)
        << from << " " << to << " " << x;
  }
}

// Layers of one gradient leave arcs of one circle: crossed partly, turning above or below either end.
TEST(FindEigenray, does_not_depend_on_the_layers_that_one_gradient_is_cut_into) {
  SoundSpeedProfile cut;
  for (int i = 0; i <= 400; ++i) {
    cut.depth.push_back(-100 + 1.0 * i);
    cut.sound_speed.push_back(1400 + 0.5 * i);
  }
  const SoundSpeedProfile whole{{-100, 300}, {1400, 1600}};
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 500; ++i) {
    const double from = 50 + 100 * unit(random), to = i % 5 == 0 ? from : 50 + 100 * unit(random);
    const double x = std::pow(10, 3 * unit(random) - 0.5);
    const Eigenray a = find_eigenray(whole, from, to, x), b = find_eigenray(cut, from, to, x);
    EXPECT_NEAR(b.travel_time / a.travel_time, 1, 1e-12) << from << " " << to << " " << x;
    EXPECT_NEAR(b.elevation, a.elevation, 1e-8) << from << " " << to << " " << x;
  }
}

// In c = c1 + g z the first slope is that of the circle through both points: at one depth, tan = g x / 2c.
TEST(FindEigenray, leaves_along_the_circle) {
  EXPECT_NEAR(find_eigenray(one_gradient, 30, 30, 100).elevation,
              -std::atan(0.02 * 100 / (2 * sound_speed_at(one_gradient, 30))), 1e-15);
  const SoundSpeedProfile slower{{-1e4, 1e4}, {1700, 1300}};
  EXPECT_NEAR(find_eigenray(slower, 30, 30, 100).elevation, std::atan(0.02 * 100 / (2 * sound_speed_at(slower, 30))),
              1e-15);
}

TEST(FindEigenray, ends_where_a_marched_ray_ends_and_takes_its_time) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 60; ++i) {
    const SoundSpeedProfile p = i < 20 ? layers : random_profile(random, 8, i < 40 ? 0.3 : 3);
    const double from = p.depth.back() * unit(random), to = p.depth.back() * unit(random), x = 5 + 60 * unit(random);
    if (refusal(p, from, to, x) != "no error") continue;
    const Eigenray ray = find_eigenray(p, from, to, x);
    if (std::abs(ray.elevation) > 1.4) continue;  // the march steps in x
    const RayState end = march(p, from, -ray.elevation, x, 20000);
    EXPECT_NEAR(end.z, to, 1e-3 * (1 + std::abs(std::tan(ray.elevation)))) << i;
    EXPECT_NEAR((end.time + (to - end.z) * std::sin(end.slope) / sound_speed_at(p, to)) / ray.travel_time, 1, 1e-7)
        << i;
  }
}

TEST(FindEigenray, takes_the_same_time_back) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  int lit = 0;
  for (int i = 0; i < 300; ++i) {
    const SoundSpeedProfile p = random_profile(random, 10, 1);
    const double a = 60 * unit(random) - 5, b = 60 * unit(random) - 5, x = 100 * unit(random);
    if (refusal(p, a, b, x) != "no error") continue;
    ++lit;
    EXPECT_EQ(find_eigenray(p, a, b, x).travel_time, find_eigenray(p, b, a, x).travel_time);
  }
  EXPECT_GT(lit, 200);
}

// Fermat: no path is faster than the first ray; a direct ray is not slower than the chord.
TEST(FindEigenray, is_not_slower_than_the_straight_line_and_not_faster_than_the_fastest_water) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    const SoundSpeedProfile p = random_profile(random, 6, 2);
    const double a = 5, b = 25 + 10 * unit(random), x = 20 * unit(random);
    double straight = 0;
    for (int k = 0; k < 20000; ++k)
      straight += std::hypot(x, b - a) / 20000 / sound_speed_at(p, a + (k + 0.5) / 20000 * (b - a));
    const double time = find_eigenray(p, a, b, x).travel_time;
    EXPECT_LE(time, straight * (1 + 1e-9));
    EXPECT_GE(time, std::hypot(x, b - a) / *std::max_element(p.sound_speed.begin(), p.sound_speed.end()) * (1 - 1e-15));
  }
}

TEST(FindEigenray, runs_straight_up_and_down) {
  // Two layers: 1/g ln(c2/c1) each.
  const SoundSpeedProfile p{{0, 10, 30}, {1500, 1490, 1500}};
  const double down = std::log(1500.0 / 1490) / 1 + std::log(1500.0 / 1490) / 0.5;
  EXPECT_NEAR(find_eigenray(p, 0, 30, 0).travel_time, down, 1e-15);
  EXPECT_NEAR(find_eigenray(p, 30, 0, 0).travel_time, down, 1e-15);
  EXPECT_EQ(find_eigenray(p, 0, 30, 0).elevation, -pi / 2);
  EXPECT_EQ(find_eigenray(p, 30, 0, 0).elevation, pi / 2);
  EXPECT_NEAR(find_eigenray(p, 2, 30, 1e-9).travel_time, find_eigenray(p, 2, 30, 0).travel_time, 1e-17);
  EXPECT_NEAR(find_eigenray(p, 2, 30, 1e-200).elevation, -pi / 2, 1e-15);
  EXPECT_EQ(find_eigenray(p, 7, 7, 0).travel_time, 0);
  EXPECT_EQ(find_eigenray(p, 7, 7, 0).elevation, 0);
}

// On the axis of a symmetric duct the way above and that below are equally fast: the arc of one gradient.
TEST(FindEigenray, turns_in_a_duct) {
  const Eigenray axis = find_eigenray(duct, 20, 20, 100);
  EXPECT_NEAR(axis.travel_time / one_gradient_time(1480, 1480, 2, 100, 0), 1, 1e-12);
  EXPECT_NEAR(std::abs(axis.elevation), std::atan(2 * 100 / (2 * 1480.0)), 1e-12);
  // Half a cycle of the steepest ray trapped in the duct is 2 sqrt(1520^2 - 1480^2) / 2 = 346.4 m: beyond that, several
  // turns.
  const double half_cycle = 2 * std::sqrt(1520.0 * 1520 - 1480.0 * 1480) / 2;
  const Eigenray twice = find_eigenray(duct, 20, 20, 1.5 * half_cycle);
  EXPECT_NEAR(twice.travel_time / (2 * one_gradient_time(1480, 1480, 2, 0.75 * half_cycle, 0)), 1, 1e-12);
}

// Above a maximum of sound speed rays bend up, below it down: between them nothing but diffraction arrives.
TEST(FindEigenray, finds_no_ray_into_a_shadow_zone) {
  const SoundSpeedProfile split{{0, 20, 40}, {1480, 1520, 1480}};
  EXPECT_EQ(refusal(split, 15, 25, 20), "no error");
  // From 5 m above the maximum to 5 m below it, R = c/g = 760 m: at most 2 sqrt(2 R 5) = 174 m.
  EXPECT_EQ(refusal(split, 15, 25, 170), "no error");
  EXPECT_EQ(
      refusal(split, 15, 25, 180),
      "content: find_eigenray: no ray joins depths 15 m and 25 m over 180 m: a shadow zone of the sound speed profile");
}

TEST(FindEigenray, has_no_gap_where_a_ray_comes_to_turn_or_to_reach_another_layer) {
  for (const double x : {30.0, 100.0}) {
    double before = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double to = 12 + 16.0 * i / 4000;
      const double time = find_eigenray(duct, 19, to, x).travel_time;
      EXPECT_NEAR(time, i > 0 ? before : time, 1.1 * 16.0 / 4000 / 1480) << to;
      before = time;
    }
  }
}

TEST(FindEigenray, handles_very_large_and_very_small_gradients) {
  const SoundSpeedProfile wall{{10, 10.01}, {1320, 1680}};  // 36000 /s
  for (const auto& [from, to, x] :
       {std::array{9.0, 11.0, 5.0}, {10.004, 10.006, 1e-3}, {10.005, 20.0, 3.0}, {9.0, 9.0, 0.5}}) {
    const Eigenray ray = find_eigenray(wall, from, to, x);
    EXPECT_GT(ray.travel_time, std::hypot(x, to - from) / 1680 * (1 - 1e-12));
    EXPECT_LT(ray.travel_time, std::hypot(x, to - from) / 1320 * (1 + 1e-12));
  }
  const SoundSpeedProfile nearly{{0, 100}, {1500, 1500 + 3e-13}};
  EXPECT_NEAR(find_eigenray(nearly, 3, 50, 40).travel_time, std::hypot(40, 47) / 1500, 1e-15);
  EXPECT_NEAR(find_eigenray(nearly, 30, 30, 40).travel_time, 40.0 / 1500, 1e-15);
}

TEST(FindEigenray, is_refused_with_value_and_rule) {
  EXPECT_EQ(refusal(duct, NAN, 1, 1), "argument: find_eigenray: depths nan m and 1 m, must be finite");
  EXPECT_EQ(refusal(duct, 1, 1, -1), "argument: find_eigenray: horizontal = -1 m, must be finite and >= 0");
  EXPECT_EQ(refusal({}, 1, 1, 1), "argument: find_eigenray: sound speed profile has no entry, must have one at least");
}

}  // namespace insonify::bent

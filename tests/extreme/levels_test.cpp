// Levels at the limits of what numbers can hold.
#include "acoustics/direct_echoes.hpp"
#include "extreme_cases.hpp"

using namespace insonify::extreme;

namespace {

SonarSpec loud_sonar(double source_level_db) {
  SonarSpec s = small_sonar();
  s.source_level_db = source_level_db;
  return s;
}

}  // namespace

// 2 alpha r of 80, 200 and 900 Np: beyond single, then beyond double precision.
TEST(ExtremeLevels, n17_absorption_beyond_double_precision_is_silence) {
  const SonarHead head = single_beam(pulse_900k, 9, 11);
  for (const double alpha : {4.0, 10.0, 45.0, 1e300}) {
    const Medium medium{1500, {alpha, 0, 0}};
    const Echoes echoes = echoes_of(targets_at({10}), pulse_900k, medium);
    for (const ComplexGrid& p :
         {synthesize_direct(echoes, head, medium), synthesize_gridded(echoes, head, medium, {1e-12})}) {
      EXPECT_TRUE(p.isFinite().all()) << alpha;
      const double expected = std::abs(echoes.amplitude[0]) * std::exp(-2 * alpha * 10);
      EXPECT_NEAR(p.abs().maxCoeff(), expected, 1e-9 * expected) << alpha;
    }
  }
  SonarSpec s = small_sonar();
  s.centre_frequency = 1e9;
  const SimulatedPing p = ping_of(plate(5, 1, 5), {}, s);
  EXPECT_TRUE(all_finite(p));
  EXPECT_GT(p.report.sampling.scatterers, 0U);
  EXPECT_EQ(p.ping.pressure.abs().maxCoeff(), 0);
  EXPECT_EQ(p.soundings.size(), 0U);
}

// Slope and curvature make exp(b^2 / 4a) overflow where exp(-2 a0 r) underflows: together they are a number.
TEST(ExtremeLevels, n17_absorption_that_varies_over_the_band_stays_finite_however_large) {
  const Pulse wide{1e6, 0.9e6, 220};
  for (const double a0 : {0.03, 1.0, 10.0, 100.0}) {
    const Absorption square_law{a0, 2 * a0 / 1e6, a0 / 1e12};  // alpha proportional to f^2
    const EchoEnvelope e = echo_envelope(wide, square_law, 100);
    for (const double t : {-1e-6, 0.0, 1e-7})
      EXPECT_TRUE(std::isfinite(std::abs(e.at(t)))) << a0 << " Np/m, " << t << " s";
    // Least attenuated is the lowest frequency: the level falls far less than at the centre frequency.
    EXPECT_LT(std::abs(e.at(0)), 1) << a0;
    EXPECT_GT(std::abs(e.at(0)), std::exp(-2 * a0 * 100)) << a0;
  }
}

TEST(ExtremeLevels, n19_absorption_that_would_amplify_is_refused) {
  const SonarHead head = single_beam(pulse_900k, 9, 11);
  const Echoes echoes = echoes_of(targets_at({10}), pulse_900k, clear_water());
  for (const auto synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum})
    expect_error(ErrorKind::argument, {"absorption = -1 dB/m", "must be >= 0"}, [&] {
      synthesize(echoes, head, {1500, {-nepers_per_db, 0, 0}}, {});
    });
  // A slope that makes part of the band grow faster than the rest is lost.
  expect_error(ErrorKind::argument, {"absorption", "growing"}, [] {
    echo_envelope({1e6, 0.9e6, 220}, {10, 2e-5, 0}, 100);
  });
  expect_error(ErrorKind::argument, {"absorption", "growing"}, [] {
    echo_envelope({1e6, 0.9e6, 220}, {0, 0, -1e-13}, 100);
  });
}

TEST(ExtremeLevels, n19_materials_that_would_amplify_or_are_no_number_are_refused) {
  Scatterers s = targets_at({5});
  s.cos_incidence = {1};
  s.projected_area = {0.01F};
  s.material = {0};
  s.id = {0};
  s.surfel = {0};
  for (const double mu : {-0.1, not_a_number, infinity}) {
    const std::vector<Material> materials{{"odd", mu}};
    expect_error(ErrorKind::argument, {"lambert_mu", "'odd'", ">= 0"},
                 [&] { direct_echoes(s, materials, pulse_900k, clear_water()); });
    SceneCloud scene = plate(5, 1, 3);
    scene.materials = materials;
    expect_error(ErrorKind::content, {"lambert_mu", "'odd'", ">= 0"}, [&] { ping_of(scene); });
  }
  for (const double sigma : {-1.0, not_a_number, infinity})
    expect_error(ErrorKind::argument, {"sigma[0]", "m^2", ">= 0"},
                 [&] { echoes_of(targets_at({5}), pulse_900k, clear_water(), sigma); });
}

TEST(ExtremeLevels, n32_echoes_below_the_smallest_numbers_change_nothing) {
  const SonarHead head = small_head();
  Echoes echoes = echoes_of(targets_at({5}, 0.1), head.pulse, clear_water());
  const SynthesisOptions fine{.tolerance = 1e-12};
  const ComplexGrid alone = synthesize_gridded(echoes, head, clear_water(), fine);
  const ComplexGrid exact = synthesize_direct(echoes, head, clear_water());
  for (int i = 0; i < 300; ++i) {  // amplitudes from 1e-290 Pa down to 0 through the denormals
    echoes.delay.push_back(2 * (2 + 0.03 * i) / 1500);
    echoes.u.push_back(0.001 * i);
    echoes.v.push_back(0);
    echoes.amplitude.push_back(std::pow(10.0, -290 - 0.12 * i));
  }
  const ComplexGrid together = synthesize_gridded(echoes, head, clear_water(), fine);
  EXPECT_TRUE(together.isFinite().all());
  EXPECT_LT(relative_l2(together, alone), 1e-12);
  EXPECT_LT(relative_l2(synthesize_direct(echoes, head, clear_water()), exact), 1e-30);
}

// Two targets 300 dB apart; the weak one keeps its own accuracy.
TEST(ExtremeLevels, n33_weak_echo_keeps_its_accuracy_beside_one_300_db_louder) {
  const SonarHead head = small_head();
  const Scatterers targets = targets_at({3, 9}, 0.1);
  const std::vector<double> sigma{1e30, 81};  // over r^2: 1e15 / 9 and 1 / 9
  const std::vector<Complex> xi{1, 1};
  const Echoes echoes = target_echoes(targets, sigma, xi, head.pulse, clear_water());
  const ComplexGrid fast = synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-6});
  const ComplexGrid slow = synthesize_direct(echoes, head, clear_water());
  const Eigen::Index far = slow.cols() / 2;  // from 6.5 m on
  EXPECT_LT(relative_l2(fast.rightCols(far), slow.rightCols(far)), 1e-6);
  EXPECT_GT(slow.leftCols(far).abs().maxCoeff() / slow.rightCols(far).abs().maxCoeff(), 0.9e15);
}

TEST(ExtremeLevels, n34_image_scales_with_the_source_level_and_stays_finite) {
  const SceneCloud scene = plate(5, 2, 10);
  const double reference = pressure_level_db(image(ping_of(scene)).abs().maxCoeff());
  for (const double level : {-400.0, -50.0, 0.0, 260.0}) {
    const SimulatedPing p = ping_of(scene, {}, loud_sonar(level));
    EXPECT_TRUE(all_finite(p)) << level;
    EXPECT_NEAR(pressure_level_db(image(p).abs().maxCoeff()) - reference, level - 220, 1e-3) << level;
  }
  for (const double level : {260.5, 400.0, -500.0, infinity, not_a_number})
    expect_error(ErrorKind::argument, {"source_level_db", "dB", "within -400 and 260"},
                 [&] { make_head(loud_sonar(level), 1500); });
}

// complex<float> ends at 3.4e38: what does not fit is refused, not stored as inf.
TEST(ExtremeLevels, n34_pressure_beyond_single_precision_is_refused) {
  SonarHead head = small_head();
  for (const double level : {900.0, 3000.0, 7000.0}) {
    head.pulse.source_level_db = level;
    expect_error(ErrorKind::argument, {"source_level_db"},
                 [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
  }
  head.pulse.source_level_db = 260;
  SceneCloud scene = plate(5, 1, 3);
  for (float& area : scene.area) area = 3e38F;
  scene.materials[0].lambert_mu = 1e30;
  expect_error(ErrorKind::content, {"PingSimulator", "Pa", "single precision"},
               [&] { simulate_ping(scene, head, Pose::Identity(), {}, {.sampling = {.scatterers_per_cell = 0}}); });
}

TEST(ExtremeLevels, n35_level_of_nothing_is_the_floor) {
  const SimulatedPing p = ping_of(SceneCloud{});
  EXPECT_TRUE((level_db(p.ping) == -200).all());
  EXPECT_TRUE((level_db(p.ping, -300) == -300).all());
  EXPECT_TRUE((range_compensated_level_db(p.ping, 0.3) == -200).all());
  EXPECT_EQ(mean_level_db(p.ping, 2, 3), -infinity);
  EXPECT_EQ(mean_level_db(p.ping, 200, 300), -infinity);
}

TEST(ExtremeLevels, n36_silent_material_sends_nothing_and_shifts_no_other_amplitude) {
  SceneCloud scene = plate(5, 2, 12);
  scene.materials = {{"sand", 0.002}, {"silent", 0}};
  for (std::size_t i = 0; i < scene.size(); i += 2) scene.material[i] = 1;
  std::vector<std::uint32_t> loud;
  for (std::uint32_t i = 1; i < scene.size(); i += 2) loud.push_back(i);
  const ComplexGrid with = image(ping_of(scene)), without = image(ping_of(subset(scene, loud)));
  EXPECT_GT(without.abs().maxCoeff(), 0);
  EXPECT_LT(relative_l2(with, without), 1e-12);
}

// Arrays and fans at their limits: no width, every width, grating lobes, odd numbers of everything.
#include "extreme_cases.hpp"
#include "support/test.hpp"

using namespace insonify::extreme;

namespace {

/// Echoes spread over ranges 1.5 to 11.5 m and directions of the fan, with random amplitudes.
Echoes spread_echoes(std::size_t count, double reach = 0.5) {
  Echoes e;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random_uniform(7, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (1.5 + 10 * u[0]) / 1500);
    e.u.push_back(reach * (2 * u[1] - 1));
    e.amplitude.push_back(random_complex_normal(7, RandomStage::surface_amplitude, {i, 0, 0}));
  }
  return e;
}

LineArray uniform_array(std::size_t elements, double spacing) { return {spacing, uniform_shading(elements)}; }

}  // namespace

TEST(ExtremeArrays, n24_beam_too_narrow_for_any_array_is_refused) {
  SonarSpec s = small_sonar();
  for (const double width_deg : {1e-3, 1e-6, 1e-300}) {
    s.beam_width = radians(width_deg);
    expect_error(ErrorKind::argument, {"beam_width = ", "deg needs more than 16384 elements"},
                 [&] { make_head(s, 1500); });
  }
  for (const double width : {0.0, -0.1, not_a_number}) {
    s.beam_width = width;
    expect_error(ErrorKind::argument, {"beam_width_deg", "> 0"}, [&] { make_head(s, 1500); });
  }
}

// Mean power over echoes from all directions of u is the width of the beam: it falls as 1 / elements.
TEST(ExtremeArrays, n24_energy_in_a_beam_falls_as_its_width) {
  const auto energy = [](std::size_t elements) {
    const LineArray array = uniform_array(elements, 0.5);
    double sum = 0;
    for (int i = 0; i < 20000; ++i) sum += std::pow(array_response(array, 1, (i + 0.5) / 10000 - 1, 0).real(), 2);
    return sum / 20000;
  };
  for (const std::size_t n : {8UL, 64UL, 512UL, 2048UL}) EXPECT_NEAR(energy(n) * static_cast<double>(n), 1, 1e-3) << n;
}

TEST(ExtremeArrays, n25_beam_of_180_degrees_is_one_omnidirectional_element) {
  SonarSpec s = small_sonar();
  s.beam_width = pi;
  for (const double side_lobes : {0.0, -30.0}) {
    s.side_lobe_db = side_lobes;
    const SonarHead head = make_head(s, 1500);
    ASSERT_EQ(head.array.elements(), 1U);
    EXPECT_EQ(array_beam_width(head.array, 1500 / s.centre_frequency), pi);
    for (const double u : {-1.0, -0.3, 0.0, 0.7, 1.0})
      EXPECT_EQ(array_response(head.array, 0.1, u, 0.2).real(), 1) << u;
  }
  EXPECT_NEAR(directivity_index_db(uniform_array(1, 0.5), 1), 0, 1e-12);
  s.beam_width = radians(181);
  expect_error(ErrorKind::argument, {"beam_width_deg = 181 deg", "at most 180"}, [&] { make_head(s, 1500); });
}

TEST(ExtremeArrays, n25_one_element_is_omnidirectional_whatever_its_spacing) {
  for (const double spacing : {1e-300, 1e-3, 1.0, 1e6, 1e300})
    EXPECT_EQ(array_beam_width(uniform_array(1, spacing), 0.003), pi) << spacing;
}

TEST(ExtremeArrays, n26_array_shorter_than_a_wavelength_has_no_null) {
  const LineArray array = uniform_array(4, 0.2);  // 0.8 wavelengths
  for (int i = -100; i <= 100; ++i) EXPECT_GT(std::abs(array_response(array, 1, 0.01 * i, 0)), 0.1);
  // The closed form of a uniform row: sin(N x / 2) / (N sin(x / 2)), x = 2 pi d u / lambda.
  const double x = 2 * pi * 0.2 * 0.8;
  EXPECT_NEAR(array_response(array, 1, 0.8, 0).real(), std::sin(2 * x) / (4 * std::sin(x / 2)), 1e-14);
}

// Lobes of full height at sin g = sin s + n lambda / d.
TEST(ExtremeArrays, n27_grating_lobes_stand_where_they_must_and_symmetric) {
  const struct { double spacing, lobe_deg; } cases[] = {{1, 90}, {1.5, 41.81031}, {2, 30}, {2, 90}};
  for (const auto& c : cases) {
    const LineArray array = uniform_array(16, c.spacing);
    const double u = std::sin(radians(c.lobe_deg));
    EXPECT_NEAR(std::abs(array_response(array, 1, u, 0)), 1, 1e-9) << c.spacing;
    EXPECT_NEAR(array_response(array, 1, u, 0).real(), array_response(array, 1, -u, 0).real(), 1e-9) << c.spacing;
  }
  // d = 0.75 lambda: free of lobes when steered up to 19.47 degrees; beyond, one enters from the other side.
  const LineArray array = uniform_array(16, 0.75);
  EXPECT_LT(std::abs(array_response(array, 1, -1, std::sin(radians(10)))), 0.3);
  EXPECT_NEAR(std::abs(array_response(array, 1, -1, 1 / 0.75 - 1)), 1, 1e-9);
}

TEST(ExtremeArrays, n28_beams_beyond_the_circle_are_refused) {
  SonarSpec s = small_sonar();
  s.beams = 3;
  for (const double azimuth : {3.15, -4.0, infinity, not_a_number}) {
    s.azimuths = {-0.1, azimuth, 0.1};
    expect_error(ErrorKind::argument, {"azimuth[1]", "rad", "within +-pi"}, [&] { make_head(s, 1500); });
  }
}

TEST(ExtremeArrays, n29_patterns_have_their_limits_where_sine_over_sine_is_0_over_0) {
  EXPECT_EQ(elevation_response(ElevationShape::line, 0.3, 0), 1);
  EXPECT_NEAR(elevation_response(ElevationShape::line, 0.3, 1e-12), 1, 1e-12);
  for (const std::size_t n : {1UL, 2UL, 3UL, 8UL, 101UL})  // x = 2 pi k: the limit is (-1)^(k (N-1))
    for (const int k : {-2, -1, 0, 1, 2})
      EXPECT_NEAR(array_response(uniform_array(n, 2), 1, 0.5 * k, 0).real(), k % 2 == 0 || n % 2 == 1 ? 1 : -1, 1e-12);
}

TEST(ExtremeArrays, n29_patterns_of_any_width_are_between_minus_1_and_1) {
  for (const ElevationShape shape : {ElevationShape::gaussian, ElevationShape::line, ElevationShape::sector})
    for (const double width : {1e-320, 1e-300, 1e-12, 0.1, pi, 10.0, 1e300})
      for (const double off : {-pi / 2, -1e-9, 0.0, 1e-300, 0.3, pi / 2}) {
        EXPECT_LE(std::abs(elevation_response(shape, width, off)), 1) << width << " " << off;
        EXPECT_GE(elevation_half_extent(shape, width, -40), 0);
        EXPECT_LE(elevation_half_extent(shape, width, -40), pi / 2);
      }
}

// 4096 scatterers in one bin and one direction: the sum keeps its tolerance, for any number of threads.
TEST(ExtremeArrays, n40_everything_in_one_place_adds_up) {
  const SonarHead head = single_beam({900e3, 29.5e3, 220}, 4, 6);
  const Scatterers targets = targets_at(std::vector<double>(4096, 5.0));
  const Echoes echoes = echoes_of(targets, head.pulse, clear_water());
  const ComplexGrid one = synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-11, .threads = 1});
  EXPECT_NEAR(one.abs().maxCoeff(), 4096 * std::abs(echoes.amplitude[0]), 1e-11 * one.abs().maxCoeff());
  for (const int threads : {2, 5})
    EXPECT_TRUE(same(synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-11, .threads = threads}), one));
}

TEST(ExtremeArrays, n40_cloud_of_identical_points_is_indexed_and_received) {
  SceneCloud scene;
  for (int i = 0; i < 5000; ++i) add_surfel(scene, {5, 0.5, 0.1}, Eigen::Vector3d(-5, -0.5, -0.1).normalized(), 1e-2);
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    const SimulatedPing p = ping_of(scene, {.sampling = {.kind = kind, .rays_per_beam = 2000}});
    EXPECT_TRUE(all_finite(p));
    EXPECT_GT(p.report.sampling.scatterers, 0U);
    EXPECT_GT(p.ping.pressure.abs().maxCoeff(), 0);
  }
}

TEST(ExtremeArrays, n41_thousands_of_beams_are_what_each_is_alone) {
  SonarHead head = small_head();
  head.array = uniform_array(256, head.array.spacing);
  head.gate = {4, 5, 0.0157};
  head.fan = make_fan(4096, radians(90), radians(0.5), radians(20));
  const Echoes echoes = spread_echoes(300);
  const ComplexGrid all = synthesize_gridded(echoes, head, clear_water());
  EXPECT_TRUE(all.isFinite().all());
  for (const Eigen::Index b : {0, 1000, 4095}) {
    SonarHead lone = head;
    lone.fan.azimuth = {head.fan.azimuth[static_cast<std::size_t>(b)]};
    lone.fan.elevation = {0};
    EXPECT_LT(relative_l2(all.row(b), synthesize_direct(echoes, lone, clear_water())), 1e-4) << b;
  }
}

TEST(ExtremeArrays, n41_image_that_no_memory_holds_is_refused_with_its_size) {
  SonarSpec s = small_sonar();
  s.beams = 65536;
  s.bin_size = 1e-5;
  expect_error(ErrorKind::argument, {"65536 beams x 1100000 bins", "GiB", "2^28"}, [&] { make_head(s, 1500); });
  s.bin_size = 1e-9;
  expect_error(ErrorKind::argument, {"bin_size = 1e-09 m", "more than 2^24 bins"}, [&] { make_head(s, 1500); });
  s.beams = 65537;
  expect_error(ErrorKind::argument, {"beams = 65537", "within 1 and 65536"}, [&] { make_head(s, 1500); });
  SonarHead head = small_head();
  head.fan = make_fan(40000, 1, 0.1, 0.1);
  head.array = uniform_array(16384, head.array.spacing);
  expect_error(ErrorKind::argument, {"40000 beams x 16384 elements", "GiB", "2^28"},
               [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
}

TEST(ExtremeArrays, n41_more_parts_than_memory_holds_are_refused_with_their_number) {
  // 90 000 surfels in 4096 parts each.
  expect_error(ErrorKind::argument, {"90000 surfels", "368640000 scatterers", "2^28", "scatterers_per_cell"},
               [] { ping_of(plate(8, 4, 300), {.sampling = {.scatterers_per_cell = 1e12, .occlusion = false}}); });
}

TEST(ExtremeArrays, n42_prime_numbers_of_bins_beams_and_elements_keep_the_tolerance) {
  const Echoes echoes = spread_echoes(200);
  for (const auto& [beams, bins, elements] : {std::array{1, 1, 1}, std::array{7, 61, 13}, std::array{13, 67, 31},
                                              std::array{31, 127, 61}, std::array{101, 997, 53}}) {
    SonarHead head = small_head();
    head.fan = make_fan(static_cast<std::size_t>(beams), radians(50), radians(3), radians(20));
    head.array = uniform_array(static_cast<std::size_t>(elements), head.array.spacing);
    head.gate = {4, 4 + 0.0075 * bins, 0.0075};
    ASSERT_EQ(head.gate.bins(), static_cast<std::size_t>(bins));
    const ComplexGrid slow = synthesize_direct(echoes, head, clear_water());
    EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-6}), slow), 1e-6) << bins;
    EXPECT_LT(relative_l2(synthesize_spectrum(echoes, head, clear_water()), slow), 1e-9) << bins;
  }
}

TEST(ExtremeArrays, n43_beams_even_in_angle_and_in_direction_cosine_agree_where_they_coincide) {
  SonarHead angle = small_head(), cosine = small_head();
  angle.fan.azimuth = {-pi / 6, -pi / 12, 0, pi / 12, pi / 6};  // u = -0.5 and 0.5 are in both
  cosine.fan.azimuth = {-pi / 6, std::asin(-0.25), 0, std::asin(0.25), pi / 6};
  angle.fan.elevation.assign(5, 0);
  cosine.fan.elevation.assign(5, 0);
  const Echoes echoes = spread_echoes(200);
  const ComplexGrid a = synthesize_gridded(echoes, angle, clear_water()),
                    b = synthesize_gridded(echoes, cosine, clear_water());
  for (const Eigen::Index beam : {0, 2, 4}) EXPECT_TRUE(same(a.row(beam), b.row(beam))) << beam;
  for (const Eigen::Index beam : {1, 3}) EXPECT_FALSE(same(a.row(beam), b.row(beam))) << beam;
}

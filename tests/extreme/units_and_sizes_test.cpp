// Numbers of points beyond the ordinary, values in other units than SI, pulses cut off in frequency, rays that miss.
#include <malloc.h>
#include <unistd.h>

#include "acoustics/sound_speed_profile.hpp"
#include "extreme_cases.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/load_scene.hpp"
#include "support/sanitizers.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

using namespace insonify::extreme;

namespace {

/// A line of Linux' account of this process [bytes]; 0 where there is none.
double memory_line(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name, 0) == 0) return 1024 * std::stod(line.substr(name.size()));
  return 0;
}

/// Largest resident set since the last call of forget_peak [bytes].
double peak_memory() { return memory_line("VmHWM:"); }

bool forget_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good() && peak_memory() > 0 && peak_memory() < 1.1 * memory_line("VmRSS:");
}

/// A wall of side x side surfels, 6 m square and 8 m ahead.
SceneCloud wall(int side, double x = 8) {
  SceneCloud scene;
  const auto n = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const float step = 6.0F / static_cast<float>(side);
  scene.origin = {x, -3, -3};
  scene.point.reserve(n);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      scene.point.emplace_back(0.0F, (static_cast<float>(i) + 0.5F) * step, (static_cast<float>(j) + 0.5F) * step);
  scene.normal.assign(n, {-1, 0, 0});
  scene.area.assign(n, step * step);
  scene.material.assign(n, 0);
  scene.id.resize(n);
  for (std::size_t i = 0; i < n; ++i) scene.id[i] = static_cast<std::uint32_t>(i);
  return scene;
}

/// What a ping of `scene` takes beyond the scene itself [bytes].
double memory_of_ping(const SceneCloud& scene) {
  forget_peak();
  const double before = peak_memory();
  const SimulatedPing p = ping_of(scene, {.sampling = {.scatterers_per_cell = 0}});
  EXPECT_GT(p.ping.pressure.abs().maxCoeff(), 0);
  return peak_memory() - before;
}

/// Floor and one wall of a room of 4 x 4 x 3 m, 20 mm between points, in units of `unit` metres.
std::string room(double unit) {
  std::ostringstream text;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) text << i * 0.02 / unit << ' ' << j * 0.02 / unit << " 0\n";
    for (int j = 1; j < 150; ++j) text << i * 0.02 / unit << " 0 " << j * 0.02 / unit << '\n';
  }
  return text.str();
}

}  // namespace

// A ping needs 34 bytes per surfel of the scene and the arrays of the surfels in view, which grow linearly with their
// number: 120 bytes per surfel when this was written. Scenes larger than memory are not covered here.
TEST(MemoryInView, n15_memory_grows_with_the_points_in_view_and_no_faster) {
  if (sanitized || !forget_peak()) GTEST_SKIP() << "peak memory cannot be measured here";
  constexpr double bytes_per_surfel = 250;
  const double half = memory_of_ping(wall(1000)), full = memory_of_ping(wall(1414));
  EXPECT_LT(full, bytes_per_surfel * 1414 * 1414);
  EXPECT_LT(full, 2.5 * half);
  RecordProperty("bytes_per_surfel", std::to_string(full / (1414 * 1414)));
}

// Points that are neither in the gate nor can occlude it are discarded at once: two million of them beyond the gate
// cost a ping of one small plate no more than sorting them into blocks (two keys of 8 bytes each), and do not change a
// bit of the result.
TEST(MemoryOutOfView, n15_points_out_of_view_cost_a_ping_no_memory) {
  if (sanitized || !forget_peak()) GTEST_SKIP() << "peak memory cannot be measured here";
  const SceneCloud near = plate(6, 1, 30);
  SceneCloud far = wall(1414, 40);
  far.origin.setZero();
  for (auto& p : far.point) p += Eigen::Vector3f(40, -3, -3);
  const std::size_t beyond = far.size();
  for (std::size_t i = 0; i < near.size(); ++i) {
    far.point.push_back(near.point[i]);
    far.normal.push_back(near.normal[i]);
    far.area.push_back(near.area[i]);
    far.material.push_back(0);
    far.id.push_back(near.id[i]);
  }
  for (std::size_t i = 0; i < beyond; ++i) far.id[i] += static_cast<std::uint32_t>(near.size());
  const double alone = memory_of_ping(near), among = memory_of_ping(far);
  EXPECT_LT(among - alone, 18.0 * static_cast<double>(beyond));  // bytes
  EXPECT_TRUE(same(image(ping_of(far, {.sampling = {.scatterers_per_cell = 0}})),
                   image(ping_of(near, {.sampling = {.scatterers_per_cell = 0}}))));
}

// A Gaussian spectrum cut off at +-Bs/2 loses erfc(sqrt(2 ln2) Bs / 2B) of its peak: -24.6 dB for the band that the
// default bins can hold (Bs = 2.27 B), -38 dB at 3 B. The spectrum form takes 10 B whatever the bins: e^-34.
TEST(ExtremeSizes, n22_spectrum_is_so_wide_that_its_truncation_is_negligible) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const auto lost_db = [](double band) {
    return db_from_amplitude(std::erfc(std::sqrt(2 * std::log(2)) * 0.5 * band));
  };
  EXPECT_NEAR(lost_db(1 / 0.44), -24.6, 0.1);
  EXPECT_NEAR(lost_db(3), -38.1, 0.1);
  EXPECT_LT(lost_db(10), -300);
  SonarHead head = single_beam(pulse, 4, 6);
  for (const double bin : {0.002, default_bin_size(pulse, 1500), 0.05}) {
    head.gate.bin_size = bin;
    const Echoes echoes = echoes_of(targets_at({4.503, 5.0, 5.49}), pulse, clear_water());
    const double peak = std::abs(echoes.amplitude[0]);
    const ComplexGrid spectrum = synthesize_spectrum(echoes, head, clear_water()),
                      exact = synthesize_direct(echoes, head, clear_water());
    EXPECT_LT((spectrum - exact).abs().maxCoeff(), 1e-12 * peak) << "bins of " << bin << " m";
  }
}

// No range side lobes between two targets: the spectrum form is as silent there as the pulse itself.
TEST(ExtremeSizes, n22_nothing_rings_between_two_echoes) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const SonarHead head = single_beam(pulse, 4, 6);
  const Echoes echoes = echoes_of(targets_at({4.5, 5.5}), pulse, clear_water());
  const ComplexGrid p = synthesize_spectrum(echoes, head, clear_water());
  const auto at = [&](double range) { return static_cast<Eigen::Index>(std::lround((range - 4) / 0.002)); };
  EXPECT_LT(p.row(0).segment(at(4.6), at(5.4) - at(4.6)).abs().maxCoeff(), 1e-13 * std::abs(echoes.amplitude[0]));
}

TEST(ExtremeSizes, n37_cloud_in_millimetres_is_suspected_with_the_unit_to_give) {
  const std::string path = own_file("room_mm.xyz", room(0.001)), metres = own_file("room_m.xyz", room(1)),
                    kilometres = own_file("room_km.xyz", room(1000));
  const auto problems = [](const std::string& file) {
    std::string all;
    for (const std::string& problem : describe_file(file).problems) all += problem + "\n";
    return all;
  };
  EXPECT_THAT(problems(path), HasSubstr("this looks like millimetres. If so, give the unit (0.001"));
  EXPECT_THAT(problems(kilometres), HasSubstr("for kilometres"));
  EXPECT_THAT(problems(metres), ::testing::Not(HasSubstr("unit")));
  LoadOptions options;
  options.unit = 0.001;
  const SceneCloud scaled = load_scene(path, options).scene;
  EXPECT_NEAR((bounds(scaled).max - bounds(scaled).min).maxCoeff(), 3.98, 1e-5);
  for (const std::string& file : {path, metres, kilometres}) std::filesystem::remove(file);
}

// Kilohertz for hertz, kilometres a second for metres, degrees for radians: refused, naming value, unit and rule.
TEST(ExtremeSizes, n37_values_in_other_units_are_refused_with_the_unit_wanted) {
  SonarSpec kilohertz = small_sonar();
  kilohertz.centre_frequency /= 1000;
  expect_error(ErrorKind::argument, {"bandwidth_hz", "20000 Hz"}, [&] { make_head(kilohertz, 1500); });
  kilohertz.bandwidth /= 1000;
  expect_error(ErrorKind::argument, {"bandwidth_hz = 20 Hz"}, [&] { make_head(kilohertz, 1500); });
  BeamFan degrees_fan = make_fan(3, radians(40), radians(4), radians(20));
  for (double& azimuth : degrees_fan.azimuth) azimuth = degrees(azimuth);
  expect_error(ErrorKind::argument, {"azimuth[0]", "rad"}, [&] { require_valid(degrees_fan, "test"); });
  expect_error(ErrorKind::argument, {"1.5 m/s", "1300"}, [] { require_valid(SoundSpeedProfile{{0}, {1.5}}, "test"); });
  EXPECT_FALSE(validity_notes({.depth = 20000}, 900e3).empty());  // metres, typed for a depth of 20 km
}

// 2 m/s towards a patch at 30 m, 900 kHz, 1500 m/s: carrier up by 2 v f / (c - v) = 2403 Hz, range short by v / (c + v)
// of itself, 40 mm.
TEST(ExtremeSizes, n44_head_approaching_at_2_m_per_s_receives_2403_hz_more_and_40_mm_less) {
  const double r = 30, v = 2, c = 1500;
  SceneCloud scene;
  scene.origin = {r, 0, 0};
  add_surfel(scene, {r, 0, 0}, {-1, 0, 0}, 0.01);
  SonarHead head = single_beam({900e3, 29.5e3, 220}, 29.8, 30.2);
  head.fan.elevation_width = 1;
  Environment water;
  water.profile = SoundSpeedProfile{{0, 100}, {c, c}};
  const auto ping = [&](double speed) {
    SimulationOptions options;
    options.sampling.scatterers_per_cell = 0;
    options.amplitude = SurfaceAmplitude::coherent;
    options.synthesis.tolerance = 1e-7;
    options.effects.absorption_order = 0;  // its slope lowers the carrier by 1211 Hz
    return simulate_event(scene, head, {.motion = {.velocity = {speed, 0, 0}}}, water, options);
  };
  const auto peak_range = [&](const ComplexGrid& p, Eigen::Index& n) {
    p.row(0).abs().maxCoeff(&n);
    const double low = std::log(std::abs(p(0, n - 1))), mid = std::log(std::abs(p(0, n))),
                 high = std::log(std::abs(p(0, n + 1)));
    return head.gate.centre(static_cast<std::size_t>(n)) + 0.002 * 0.5 * (low - high) / (low - 2 * mid + high);
  };
  Eigen::Index n, at_rest;
  const ComplexGrid rest = image(ping(0)), closing = image(ping(v)), leaving = image(ping(-v));
  EXPECT_NEAR(peak_range(rest, at_rest), r, 1e-6);
  EXPECT_NEAR(peak_range(leaving, n) - r, r * v / (c - v), 2e-5);
  EXPECT_NEAR(peak_range(closing, n) - r, -r * v / (c + v), 2e-5);
  EXPECT_NEAR(r * v / (c + v), 0.040, 1e-4);

  // exp(-2 pi i f_d t): the phase turns by 2 pi f_d 2 dr / c from bin to bin.
  const double turn = -std::arg(closing(0, n + 3) * std::conj(closing(0, n - 3))) / 6;
  EXPECT_NEAR(turn / (2 * pi) * c / (2 * 0.002), 2403, 3);
  EXPECT_NEAR(std::arg(rest(0, at_rest) * std::conj(rest(0, at_rest - 1))), 0, 1e-6);
  // Over the pulse's length 1 / B that is half a radian: 2 pi 2403 / 29500 = 0.51.
  EXPECT_NEAR(2 * pi * 2403 / 29.5e3, 0.51, 0.005);
}

TEST(ExtremeSizes, n44_head_with_no_velocity_gives_the_image_of_one_at_rest_bit_for_bit) {
  const SceneCloud scene = plate(6, 4, 40);
  const Motion still{Eigen::Vector3d(0, -0.0, 0), Eigen::Vector3d(-0.0, 0, 0)};
  EXPECT_TRUE(same(image(ping_of(scene, {}, still)), image(ping_of(scene))));
}

// A bottom 3 m below, at 10 to 12 m: r^2 dphi / h sets how far apart rays meet it. 64 rays over 40 degrees and more
// leave most cells empty, and the ping says so with the number it takes; surfels leave none.
TEST(ExtremeSizes, n55_rays_too_few_for_a_grazing_plane_are_noted_with_the_number_it_takes) {
  SceneCloud scene;
  for (int i = 0; i < 240; ++i)
    for (int j = 0; j < 200; ++j) add_surfel(scene, {4 + 0.04 * i, 0.04 * j - 4, -3}, {0, 0, 1}, 0.0016);
  const SimulatedPing few = ping_of(scene, {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 64}});
  ASSERT_EQ(few.report.notes.size(), 1U);
  EXPECT_THAT(few.report.notes[0], HasSubstr("rays are too few"));
  EXPECT_THAT(few.report.notes[0], HasSubstr("rays per beam"));
  // 20 000 rays leave 1.2 % of the cells empty, 46 of 3850; above 1 % the ping says so.
  const SimulatedPing enough = ping_of(scene, {.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 30000}});
  EXPECT_TRUE(enough.report.notes.empty()) << enough.report.notes[0];
  EXPECT_TRUE(ping_of(scene).report.notes.empty());
  EXPECT_TRUE(all_finite(few));
}

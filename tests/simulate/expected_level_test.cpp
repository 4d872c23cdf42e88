// Expected levels without speckle, how well finitely many points give them, and where the scan has holes.
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace {

const SonarHead level_head = small_head({.beams = 12,
                                         .field_of_view_deg = 24,
                                         .elevation_width_deg = 30,
                                         .min_range = 3,
                                         .max_range = 8,
                                         .source_level_db = 200});

/// Between surface and bottom, in water that scatters.
Environment loud_sea() {
  Environment e;
  e.surface = SeaSurface{3, 1e-4, -35};
  e.bottom = FlatBottom{-3};
  e.bottom->lambert_mu = 1e-4;
  e.volume_scattering_db = -50;
  e.self_noise_db = 55;
  return e;
}

const SceneCloud& plane() {
  static const SceneCloud scene = make_built_in_scene("plane", {.points = 12000, .size = {14, 10}});
  return scene;
}

const Pose above = pose_from_yaw_pitch_roll({-4, 0, 2.5}, 0, radians(25), 0);

SimulatedPing ping_levels(const SimulationOptions& options, const Environment& environment = {},
                          std::int64_t number = 0) {
  return simulate_event(plane(), level_head, {.world_from_head = above, .number = number}, environment, options);
}

Grid<double> power(const ComplexGridF& pressure) { return pressure.cast<std::complex<double>>().abs2(); }

/// Root mean square of a map over the cells that a mask judges.
template <typename Map>
double rms(const Map& map, const Grid<bool>& judged) {
  return std::sqrt(judged.select(map.square(), 0).sum() / static_cast<double>(judged.count()));
}

/// The spread of the expected level of every cell over seeds of the sampling, against what is predicted for one: in
/// the cells where first order holds, those whose prediction stays below 1.5 dB.
struct Spread {
  double measured = 0, predicted = 0;  ///< [dB], root mean square over these cells
  Eigen::Index cells = 0;

  explicit Spread(SimulationOptions options) {
    constexpr int seeds = 20;
    options.synthesis.method = SynthesisMethod::incoherent;
    options.outputs.scatterers = true;
    Grid<double> sum, squares, prediction;
    Grid<bool> judged = Grid<bool>::Constant(level_head.fan.beams(), level_head.gate.bins(), true);
    sum = squares = prediction = Grid<double>::Zero(judged.rows(), judged.cols());
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      options.seed = seed;
      const SimulatedPing p = ping_levels(options);
      const Transmission sent = resolve_ping(whole_of(plane()), level_head, {above}, {}, options).sent;
      const Echoes echoes =
          direct_echoes(p.outputs.scatterers, plane().materials, sent.pulse, sent.medium, sent.echo_options);
      const Grid<double> error = predict_level_error_db(echoes, level_head, sent.medium).cast<double>();
      judged = judged && error < 1.5;
      const Grid<double> level = 10 * power(p.ping.pressure).log10();
      sum += level, squares += level.square(), prediction += error.square() / seeds;
    }
    const Grid<double> variance = (squares - sum.square() / seeds) / (seeds - 1);
    measured = rms(judged.select(variance.max(0), 0).sqrt(), judged);
    cells = judged.count();
    predicted = rms(judged.select(prediction, 0).sqrt(), judged);
  }
};

}  // namespace

TEST(ExpectedLevel, is_the_mean_power_of_many_pings_with_speckle) {
  SimulationOptions options{.sampling = {.scatterers_per_cell = 4},
                            .synthesis = {.method = SynthesisMethod::incoherent},
                            .effects = {.multipath = Choice::never, .noise = true},
                            .outputs = {.layers = true}};
  const SimulatedPing expected = ping_levels(options, loud_sea());
  EXPECT_TRUE(expected.ping.expected_level);
  EXPECT_TRUE((expected.ping.pressure.imag() == 0).all());

  // Amplitudes by the seed; it also moves the parts of surfels, so means over many cells are compared.
  options.synthesis.method = SynthesisMethod::gridded;
  std::map<std::string, double> mean;
  constexpr int pings = 30;
  for (std::uint64_t seed = 1; seed <= pings; ++seed) {
    options.seed = seed;
    const SimulatedPing p = ping_levels(options, loud_sea(), static_cast<std::int64_t>(seed));
    EXPECT_FALSE(p.ping.expected_level);
    for (const Layer& layer : p.ping.layers) mean[layer.name] += power(layer.pressure).sum() / pings;
  }
  ASSERT_EQ(expected.ping.layers.size(), 5u);
  for (const Layer& layer : expected.ping.layers)
    EXPECT_NEAR(db_from_power(power(layer.pressure).sum() / mean[layer.name]), 0, 0.25) << layer.name;
}

TEST(ExpectedLevel, adds_layers_by_their_squares) {
  const SimulatedPing p = ping_levels({.sampling = {.scatterers_per_cell = 2},
                                       .synthesis = {.method = SynthesisMethod::incoherent},
                                       .effects = {.multipath = Choice::always, .noise = true},
                                       .outputs = {.layers = true}},
                                      loud_sea());
  ASSERT_EQ(p.ping.layers.size(), 6u);
  Grid<double> sum = Grid<double>::Zero(p.ping.pressure.rows(), p.ping.pressure.cols());
  for (const Layer& layer : p.ping.layers) sum += power(layer.pressure);
  EXPECT_LT(((power(p.ping.pressure) - sum).abs() / sum).maxCoeff(), 1e-5);
}

TEST(ExpectedLevel, does_not_depend_on_the_amplitude_law_nor_on_threads) {
  SimulationOptions options{.sampling = {.scatterers_per_cell = 2},
                            .synthesis = {.method = SynthesisMethod::incoherent}};
  const SimulatedPing one = ping_levels(options);
  options.amplitude = SurfaceAmplitude::random_phase;
  options.threads = 3;
  EXPECT_TRUE((ping_levels(options).ping.pressure == one.ping.pressure).all());
}

TEST(LevelError, is_an_upper_estimate_for_split_surfels) {
  const Spread spread({.sampling = {.scatterers_per_cell = 20}});
  RecordProperty("measured_db", std::to_string(spread.measured));
  RecordProperty("predicted_db", std::to_string(spread.predicted));
  RecordProperty("cells", std::to_string(spread.cells));
  EXPECT_GT(spread.cells, 1000);
  EXPECT_LE(spread.measured, spread.predicted);
  EXPECT_GT(spread.measured, 0.1 * spread.predicted);  // the same kind of thing
}

TEST(LevelError, is_an_upper_estimate_for_jittered_rays) {
  SimulationOptions options{.sampling = {.kind = SamplingKind::rays, .rays_per_beam = 16384}};
  const Spread spread(options);
  RecordProperty("measured_db", std::to_string(spread.measured));
  RecordProperty("predicted_db", std::to_string(spread.predicted));
  RecordProperty("cells", std::to_string(spread.cells));
  EXPECT_GT(spread.cells, 1000);
  EXPECT_LE(spread.measured, spread.predicted);
  EXPECT_GT(spread.measured, 0.03 * spread.predicted);  // an interval of elevation holds its number of rays exactly
}

TEST(LevelError, asked_for_is_kept_in_99_of_100_cells) {
  for (const SamplingKind kind : {SamplingKind::surfels, SamplingKind::rays}) {
    SimulationOptions options{.sampling = {.kind = kind,
                                           .scatterers_per_cell = 2,
                                           .rays_per_beam = 32,
                                           .level_error_db = 0.7,
                                           .outer_elevations = Choice::never,
                                           .outer_azimuths = Choice::never}};
    const SimulatedPing p = ping_levels(options);
    const ConvergenceReport& report = p.report.convergence;
    EXPECT_TRUE(report.reached);
    EXPECT_TRUE(p.report.notes.empty() || kind == SamplingKind::rays);
    EXPECT_GT(report.samplings, 1);
    EXPECT_GT(report.judged, 1000u);
    EXPECT_GE(report.share_below, 0.99);
    EXPECT_LT(report.reached_db, 0.7);
    EXPECT_EQ(p.report.sampling.scatterers, report.scatterers);
    ASSERT_EQ(p.ping.level_error_db.size(), p.ping.pressure.size());
    EXPECT_EQ(static_cast<std::size_t>((!p.ping.level_error_db.isNaN()).count()), report.judged);
    const auto below = (p.ping.level_error_db < 0.7f).count();
    EXPECT_DOUBLE_EQ(static_cast<double>(below) / static_cast<double>(report.judged), report.share_below);

    // What was used, asked for outright, gives the same ping_levels.
    options.sampling.level_error_db = 0;
    options.sampling.scatterers_per_cell = report.scatterers_per_cell;
    options.sampling.rays_per_beam = report.rays_per_beam;
    const SimulatedPing again = ping_levels(options);
    EXPECT_TRUE((again.ping.pressure == p.ping.pressure).all());
    EXPECT_EQ(again.ping.level_error_db.size(), 0);
    EXPECT_EQ(again.report.convergence.samplings, 0);
  }
}

TEST(LevelError, out_of_reach_is_told) {
  // A surfel has at most 4096 parts, which leave 4.34 dB / 64.
  SceneCloud scene;
  add_surfel(scene, {5, 0, 0}, {-1, 0, 0}, 0.01);
  const SimulatedPing p =
      simulate_ping(scene, level_head, Pose::Identity(), {}, {.sampling = {.level_error_db = 1e-3}});
  EXPECT_FALSE(p.report.convergence.reached);
  EXPECT_LT(p.report.convergence.share_below, 0.99);
  ASSERT_FALSE(p.report.notes.empty());
  EXPECT_THAT(p.report.notes.back(), HasSubstr("of the cells are below the 0.001 dB asked for"));
}

TEST(LevelError, of_a_silent_ping_is_kept_at_once) {
  const SimulatedPing p =
      simulate_ping(SceneCloud{}, level_head, Pose::Identity(), {}, {.sampling = {.level_error_db = 0.5}});
  EXPECT_TRUE(p.report.convergence.reached);
  EXPECT_EQ(p.report.convergence.judged, 0u);
  EXPECT_EQ(p.report.convergence.samplings, 1);
}

TEST(HoleMask, of_a_ping_marks_what_the_scan_left_out) {
  SceneCloud scene;
  const SceneCloud whole = make_built_in_scene("plane", {.points = 60000, .size = {14, 10}});
  const double gap = 4.5 * std::sqrt(14.0 * 10 / 60000);
  scene.materials = whole.materials;
  constexpr double middle = 0.8;  // of the hole, on the axis of the fan
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (std::hypot(whole.point[i].x() - middle, whole.point[i].y()) > gap)
      add_surfel(scene, whole.point[i].cast<double>(), whole.normal[i].cast<double>(), whole.area[i]);
  SimulationOptions options{.sampling = {.scatterers_per_cell = 0, .rays_per_beam = 512}, .outputs = {.mask = true}};
  const auto ping_of = [&](const SceneCloud& s) { return simulate_ping(s, level_head, above, {}, options); };
  const SimulatedPing clean = ping_of(whole), pierced = ping_of(scene);
  ASSERT_EQ(pierced.ping.unknown.size(), pierced.ping.pressure.size());
  EXPECT_EQ(clean.report.holes.directions, 12u * 512u);
  EXPECT_EQ(clean.report.holes.unknown, 0u);
  EXPECT_EQ(clean.ping.unknown.cast<int>().sum(), 0);
  EXPECT_GT(pierced.report.holes.unknown, 0u);
  const double range = std::hypot(4 + middle, 2.5);
  for (Eigen::Index b = 0; b < pierced.ping.unknown.rows(); ++b)
    for (Eigen::Index n = 0; n < pierced.ping.unknown.cols(); ++n)
      if (pierced.ping.unknown(b, n)) {
        EXPECT_LT(std::abs(pierced.ping.gate.centre(static_cast<std::size_t>(n)) - range), 3 * gap);
        EXPECT_LT(std::abs(pierced.ping.fan.azimuth[static_cast<std::size_t>(b)]), radians(1) + gap / range);
      }
  options.outputs.mask = false;
  EXPECT_EQ(ping_of(scene).ping.unknown.size(), 0);
}

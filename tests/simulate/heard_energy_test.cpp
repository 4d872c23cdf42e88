// What a beam hears of a surfel (E127), against the energy of pings of single surfels.
#include "simulate/heard_energy_internal.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

const SonarHead single_beam =
    small_head({.beams = 1, .field_of_view_deg = 2, .elevation_width_deg = 40, .max_range = 12});

/// A surfel in head axes, tilted against the line of sight.
struct OneSurfel {
  double range = 6, u = 0, elevation = 0, tilt = 0;
  std::uint16_t material = 0;
};

SceneCloud scene_of(const OneSurfel& s) {
  SceneCloud scene;
  scene.materials = {Material{}, Material{"mud", 1e-4}};
  const double across = std::cos(s.elevation);
  const Eigen::Vector3d along(std::sqrt(across * across - s.u * s.u), s.u, std::sin(s.elevation));
  const Eigen::Vector3d beside = along.unitOrthogonal();
  add_surfel(scene, s.range * along, -std::cos(s.tilt) * along + std::sin(s.tilt) * beside, 1e-4, s.material);
  return scene;
}

SimulationOptions all_directions() {
  SimulationOptions options{.sampling = {.elevation_floor_db = -120},
                            .synthesis = {.method = SynthesisMethod::incoherent}};
  options.sampling.outer_azimuths = options.sampling.outer_elevations = Choice::always;
  options.synthesis.true_delays = Choice::never;
  return options;
}

double energy_of_ping(const OneSurfel& surfel) {
  const SimulatedPing p = simulate_ping(scene_of(surfel), single_beam, Pose::Identity(), {}, all_directions());
  return p.ping.pressure.cast<std::complex<double>>().abs2().sum();
}

double heard_of(const OneSurfel& surfel) {
  const SceneCloud scene = scene_of(surfel);
  const ResolvedPing ping =
      resolve_ping(PreparedScene(scene).whole(), single_beam, Pose::Identity(), {}, all_directions());
  const HeardEnergy heard = heard_energy(ping, scene.materials);
  return heard(scene.origin + scene.point[0].cast<double>(), std::cos(surfel.tilt), scene.area[0], surfel.material);
}

}  // namespace

TEST(HeardEnergy, is_the_energy_of_echoes_up_to_a_factor) {
  const double factor = energy_of_ping({}) / heard_of({});
  // Whole bins apart, since a sum over bins depends on where between two of them an echo lies.
  const double bins = std::round(3.5 / single_beam.gate.bin_size) * single_beam.gate.bin_size;
  for (const OneSurfel& surfel :
       {OneSurfel{.range = 6 - bins}, OneSurfel{.range = 6 + bins}, OneSurfel{.elevation = radians(20)},
        OneSurfel{.elevation = radians(-35)}, OneSurfel{.tilt = radians(60)}, OneSurfel{.material = 1}})
    EXPECT_NEAR(energy_of_ping(surfel) / heard_of(surfel), factor, 1e-4 * factor)
        << surfel.range << " m, elevation " << surfel.elevation << ", tilt " << surfel.tilt;
}

TEST(HeardEnergy, is_a_mean_over_a_beam_width_to_either_side) {
  const auto mean_of = [](double u, const auto& energy) {
    constexpr int places = 41;
    double sum = 0;
    for (int k = 0; k < places; ++k)
      sum += energy(OneSurfel{.u = u + single_beam.fan.beam_width * (2.0 * k / (places - 1) - 1)}) / places;
    return sum;
  };
  const double factor = mean_of(0, energy_of_ping) / heard_of({});
  for (const double u : {0.1, -0.3, 0.6})
    EXPECT_NEAR(mean_of(u, energy_of_ping) / heard_of({.u = u}), factor, 0.1 * factor) << u;
}

TEST(HeardEnergy, is_left_open_where_parts_must_be_as_many_as_cells_ask_for) {
  const auto given = [](const SonarHead& head, const SimulationOptions& options, double coherent_fraction = 0) {
    std::vector<Material> materials(1);
    materials[0].coherent_fraction = coherent_fraction;
    return bool{heard_energy(resolve_ping(WholeScene{}, head, Pose::Identity(), {}, options), materials)};
  };
  EXPECT_TRUE(given(single_beam, {}));
  EXPECT_FALSE(given(small_head({.beams = 2}), {}));
  EXPECT_FALSE(given(single_beam, {}, 0.1));
  EXPECT_FALSE(given(single_beam, {.amplitude = SurfaceAmplitude::coherent}));
  EXPECT_FALSE(given(single_beam, {.effects = {.refraction = Choice::always}}));
  EXPECT_FALSE(given(single_beam, {.sampling = {.kind = SamplingKind::rays}}));
  EXPECT_FALSE(given(single_beam, {.sampling = {.scatterers_per_cell = 0}}));
}

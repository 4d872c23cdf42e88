// SPDX-License-Identifier: BSD-3-Clause
// Compares the energy of a surfel (E127) with pings of single surfels, and the error of parts by its fraction.
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "simulate/simulate_ping.hpp"
#include "simulate/surfel_energy_internal.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
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

double energy_of_ping(const OneSurfel& surfel, const SonarHead& head = single_beam) {
  const SimulatedPing p = simulate_ping(scene_of(surfel), head, Pose::Identity(), {}, all_directions());
  return p.ping.pressure.cast<std::complex<double>>().abs2().sum();
}

double received_from(const OneSurfel& surfel, const SonarHead& head = single_beam) {
  const SceneCloud scene = scene_of(surfel);
  const ResolvedPing ping = resolve_ping(PreparedScene(scene).whole(), head, {}, {}, all_directions());
  return surfel_energy(ping, scene.materials)
      ->of(scene.origin + scene.point[0].cast<double>(), std::cos(surfel.tilt), scene.area[0], surfel.material);
}

}  // namespace

TEST(SurfelEnergy, is_the_energy_of_echoes_up_to_a_factor) {
  const SonarHead fan = small_head({.elevation_width_deg = 40, .max_range = 12});
  // Whole bins apart, since a sum over bins depends on where between two of them an echo lies.
  const double bins = std::round(3.5 / single_beam.gate.bin_size) * single_beam.gate.bin_size;
  for (const SonarHead& head : {single_beam, fan}) {
    const double factor = energy_of_ping({}, head) / received_from({}, head);
    for (const OneSurfel& surfel :
         {OneSurfel{.range = 6 - bins}, OneSurfel{.range = 6 + bins}, OneSurfel{.elevation = radians(20)},
          OneSurfel{.elevation = radians(-35)}, OneSurfel{.tilt = radians(60)}, OneSurfel{.material = 1}})
      EXPECT_NEAR(energy_of_ping(surfel, head) / received_from(surfel, head), factor, 1e-4 * factor)
          << head.fan.beams() << " beams, " << surfel.range << " m, elevation " << surfel.elevation << ", tilt "
          << surfel.tilt;
  }
}

TEST(SurfelEnergy, is_a_mean_over_a_beam_width_to_either_side) {
  const auto mean_of = [](double u, const auto& energy) {
    constexpr int positions = 41;
    double sum = 0;
    for (int k = 0; k < positions; ++k)
      sum += energy(OneSurfel{.u = u + single_beam.fan.beam_width * (2.0 * k / (positions - 1) - 1)}) / positions;
    return sum;
  };
  const auto of_ping = [](const OneSurfel& surfel) { return energy_of_ping(surfel); };
  const double factor = mean_of(0, of_ping) / received_from({});
  for (const double u : {0.1, -0.3, 0.6})
    EXPECT_NEAR(mean_of(u, of_ping) / received_from({.u = u}), factor, 0.1 * factor) << u;
}

TEST(SurfelEnergy, is_left_open_where_parts_must_be_as_many_as_cells_ask_for) {
  const auto given = [](const SonarHead& head, const SimulationOptions& options, double coherent_fraction = 0) {
    std::vector<Material> materials(1);
    materials[0].coherent_fraction = coherent_fraction;
    return surfel_energy(resolve_ping(WholeScene{}, head, {}, {}, options), materials) != nullptr;
  };
  EXPECT_TRUE(given(single_beam, {}));
  EXPECT_TRUE(given(small_head({.beams = 2}), {}));
  SonarHead two_rows = small_head({.beams = 2});
  two_rows.fan.elevation = {0, radians(2)};
  EXPECT_FALSE(given(two_rows, {}));
  EXPECT_FALSE(given(single_beam, {}, 0.1));
  EXPECT_FALSE(given(single_beam, {.amplitude = SurfaceAmplitude::coherent}));
  SonarHead sparse = single_beam;
  sparse.array.spacing *= 2.1;
  EXPECT_FALSE(given(sparse, {}));
  EXPECT_FALSE(given(single_beam, {.sampling = {.kind = SamplingKind::rays}}));
  EXPECT_FALSE(given(single_beam, {.sampling = {.scatterers_per_cell = 0}}));
}

// The foot of a wall, seen in the main lobe, and the bed before it, seen below, are received at one range.
TEST(SurfelEnergy, lets_a_fan_do_with_fewer_parts) {
  SceneCloud scene;
  add_rectangle(scene, {12, -5, -4}, {0, 10, 0}, {0, 0, 8}, {-1, 0, 0}, 0.4, 0.1);
  add_rectangle(scene, {10, -5, -4}, {2, 0, 0}, {0, 10, 0}, {0, 0, 1}, 0.4, 0.1);
  const SonarHead head = small_head({.min_range = 11.5, .max_range = 13});
  const ResolvedPing ping = resolve_ping(PreparedScene(scene).whole(), head, {}, {}, {});
  std::size_t parts = 0;
  const auto levels = [&](double per_cell, bool by_shares, std::uint64_t seed) {
    SamplingOptions o = ping.view.sampling;
    o.scatterers_per_cell = per_cell, o.seed = seed;
    o.energy = by_shares ? surfel_energy(ping, scene.materials) : nullptr;
    const Scatterers s = find_scatterers(scene, ping.view.world_from_head, head.fan, ping.view.gate, o).scatterers;
    parts = s.size();
    const Transmission& sent = ping.sent;
    return synthesize_intensity(direct_echoes(s, scene.materials, sent.pulse, sent.medium, sent.echo_options), head,
                                sent.medium);
  };
  const Grid<double> exact = levels(200, false, 100);
  struct Result {
    double error = 0, energy = 0, parts = 0;
  };
  const auto result = [&](bool by_shares) {
    Result r;
    double bins = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Grid<double> some = levels(8, by_shares, seed);
      r.energy += some.sum() / exact.sum() / 3;
      for (Eigen::Index i = 0; i < exact.size(); ++i)
        if (exact.data()[i] > 1e-9 * exact.maxCoeff())
          r.error += std::pow(db_from_power(some.data()[i] / exact.data()[i]), 2), ++bins;
    }
    r.error = std::sqrt(r.error / bins), r.parts = static_cast<double>(parts);
    return r;
  };
  const Result all = result(false), fewer = result(true);
  EXPECT_LT(fewer.parts, 0.8 * all.parts);
  EXPECT_LT(fewer.error, 1.1 * all.error) << all.error << " dB";
  EXPECT_NEAR(fewer.energy, all.energy, 0.01);
}

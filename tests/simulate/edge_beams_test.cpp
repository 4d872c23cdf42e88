// SPDX-License-Identifier: BSD-3-Clause
// Levels of the outermost beams against those of everything ahead of the head: a line array receives along
// cones, which reach far below the axis there.
#include "acoustics/reverberation_echoes.hpp"
#include "beamforming/head_patterns.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "sonar/response_table.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/test.hpp"

namespace {

SonarHead head_of(const char* name, double frequency, std::size_t beams, double field_deg, double width_deg,
                  double elevation_deg) {
  SonarSpec s;
  s.name = name;
  s.centre_frequency = frequency, s.bandwidth = 29.5e3;
  s.beams = beams, s.field_of_view = radians(field_deg);
  s.beam_width = radians(width_deg), s.elevation_width = radians(elevation_deg);
  s.min_range = 0.4, s.max_range = 12;
  return make_head(s, 1500);
}

const std::vector<SonarHead> heads = {
    head_of("oculus-m750d", 750e3, 512, 130, 1, 20), head_of("m900-130", 900e3, 768, 130, 1, 12),
    head_of("p900-45", 900e3, 256, 45, 1, 20), head_of("p900-130", 900e3, 768, 130, 1, 20),
    head_of("gemini-720im", 720e3, 128, 90, 1.5, 20)};
const Pose pose = pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0);
const Medium medium{1500, {}};

Transmission sent_by(const SonarHead& head) {
  EchoOptions options;
  options.amplitude = SurfaceAmplitude::mean_power;
  return {head.pulse, medium, with_patterns(options, head)};
}

// Returns the energy in a beam [Pa^2].
double energy(const Echoes& echoes, const SonarHead& head, std::size_t beam) {
  const ResponseTable response(head.array, 1500 / head.pulse.centre_frequency);
  const double u = std::sin(head.fan.azimuth[beam]);
  double sum = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i)
    sum += std::norm(std::complex<double>(echoes.amplitude[i])) * response.intensity(echoes.u[i] - u);
  return sum;
}

void expect_alike(const Echoes& echoes, const Echoes& all, const SonarHead& head) {
  for (const std::size_t beam : {std::size_t{0}, head.fan.beams() / 3, head.fan.beams() - 1})
    EXPECT_NEAR(db_from_power(energy(echoes, head, beam) / energy(all, head, beam)), 0, 0.2) << "beam " << beam;
}

// Returns beams that fill the half-circle, of the same widths.
BeamFan half_circle(const SonarHead& head) { return make_fan(180, pi, head.fan.beam_width, head.fan.elevation_width); }

}  // namespace

TEST(EdgeBeams, receive_a_plane_as_if_all_of_it_were_sampled) {
  const SceneCloud plane = make_built_in_scene("plane", {.points = 300000, .size = {12, 26}});
  for (const SonarHead& head : heads) {
    SCOPED_TRACE(head.name);
    const Transmission sent = sent_by(head);
    const auto echoes_within = [&](double margin) {
      SamplingOptions options{.scatterers_per_cell = 0, .occlusion = false, .azimuth_margin = margin};
      options.elevation_half_extent = sampled_half_extent(head, -40);
      const Scatterers s = find_scatterers(plane, pose, head.fan, head.gate, options).scatterers;
      return direct_echoes(s, plane.materials, sent.pulse, medium, sent.echo_options);
    };
    expect_alike(echoes_within(0), echoes_within(2), head);
  }
}

TEST(EdgeBeams, receive_the_reverberation_of_all_directions) {
  Environment e;
  e.volume_scattering_db = -70;
  e.bottom = FlatBottom{.height = 0, .lambert_mu = power_from_db(-27)};
  for (const SonarHead& head : heads) {
    SCOPED_TRACE(head.name);
    const Transmission sent = sent_by(head);
    const RangeGate gate{5, 5.5, 0.01};
    expect_alike(volume_echoes(e, head.fan, gate, sent), volume_echoes(e, half_circle(head), gate, sent), head);
    expect_alike(bottom_echoes(e, pose, head.fan, gate, sent), bottom_echoes(e, pose, half_circle(head), gate, sent),
                 head);
  }
}

// Over the upper half of a band of a quarter of the carrier, elements of half a wavelength have further main lobes for
// beams at the edge: what the water adds there, against the integral over directions and band, of the same speckle.
TEST(EdgeBeams, of_a_wide_band_hear_all_the_water_that_further_lobes_do) {
  SonarSpec spec;
  spec.centre_frequency = 750e3, spec.bandwidth = 187.5e3;
  spec.beams = 24, spec.field_of_view = radians(130), spec.beam_width = radians(1.5),
  spec.elevation_width = radians(20);
  spec.min_range = 4, spec.max_range = 6;
  const SonarHead head = make_head(spec, sound_speed(Water{}));
  Environment water;
  water.volume_scattering_db = -60;
  SceneCloud behind;
  add_surfel(behind, {-50, 0, 0}, {1, 0, 0}, 1);
  behind.materials = {Material{}};
  const auto energies = [&](std::uint64_t seed, SynthesisMethod method) -> Eigen::ArrayXd {
    SimulationOptions o;
    o.seed = seed, o.synthesis.method = method, o.effects.absorption_order = 0;
    o.synthesis.tolerance = 1e-3, o.synthesis.true_delays = Choice::never;
    return simulate_ping(behind, head, Pose::Identity(), water, o)
        .ping.pressure.cast<std::complex<double>>()
        .abs2()
        .rowwise()
        .sum();
  };
  Eigen::ArrayXd narrow = Eigen::ArrayXd::Zero(24), wide = narrow;
  for (const std::uint64_t seed : {1, 2, 3}) {
    narrow += energies(seed, SynthesisMethod::gridded);
    wide += energies(seed, SynthesisMethod::true_delays);
  }

  // Energy of a steered beam from all directions ahead, at a part f of the carrier.
  const std::vector<double>& shading = head.array.shading;
  const auto beam_azimuth = [&](std::size_t beam, double f) {
    double sum = 0;
    for (int k = 0; k < 720; ++k)
      for (int j = -8; j <= 8; ++j) {
        const double azimuth = pi * ((k + 0.5) / 720 - 0.5), elevation = radians(2.5) * j;
        const double du = std::cos(elevation) * std::sin(azimuth) - std::sin(head.fan.azimuth[beam]);
        std::complex<double> response = 0;
        for (std::size_t m = 0; m < shading.size(); ++m)
          response += std::polar(shading[m], pi * f * du * static_cast<double>(m));  // half a wavelength apart
        sum +=
            std::norm(response) * std::exp2(-std::pow(2 * elevation / spec.elevation_width, 2)) * std::cos(elevation);
      }
    return sum;
  };
  for (const std::size_t beam : {0U, 12U}) {
    double expected = 0, parts = 0;
    for (int n = -12; n <= 12; ++n) {
      const double x = 0.25 * n, part = std::exp(-0.5 * x * x),
                   deviation = spec.bandwidth / std::sqrt(8 * std::numbers::ln2);
      expected += part * beam_azimuth(beam, 1 + x * deviation / spec.centre_frequency), parts += part;
    }
    const double closed = db_from_power(expected / parts / beam_azimuth(beam, 1));
    const std::size_t other = 23 - beam;
    const double found = db_from_power((wide[beam] + wide[other]) / (narrow[beam] + narrow[other]));
    EXPECT_NEAR(found, closed, 0.3) << beam;
    if (beam == 0) {
      EXPECT_GT(closed, 1.2);
    }
  }
}

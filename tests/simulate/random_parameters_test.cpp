// SPDX-License-Identifier: BSD-3-Clause
// Draws random parameters from far wider ranges than any sonar has. The result is finite, or an Error that names the
// fault. A failure prints the case's number, which draws it again.
#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "support/checked_ping.hpp"

namespace insonify::random_parameters {

/// Numbers of one case: the same for the same case, on any machine.
class Draw {
 public:
  explicit Draw(std::uint64_t test_case) : case_(test_case) {}
  double uniform(double low, double high) {
    return low + (high - low) * random_uniform(20261120, RandomStage::scene_points, {case_, next_++, 0})[0];
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  std::size_t count(double low, double high) { return static_cast<std::size_t>(log_uniform(low, high)); }
  bool one_in(double n) { return uniform(0, n) < 1; }

 private:
  std::uint64_t case_, next_ = 0;
};

SonarSpec any_sonar(Draw& draw) {
  SonarSpec s;
  s.name = "any";
  s.centre_frequency = draw.log_uniform(10, 1e9), s.bandwidth = s.centre_frequency * draw.log_uniform(1e-6, 3);
  s.source_level_db = draw.uniform(-50, 300);
  s.beams = draw.count(1, 24), s.field_of_view = draw.log_uniform(1e-3, 7);
  s.beam_width = draw.log_uniform(2e-2, 3.5);
  s.elevation = draw.uniform(-1.6, 1.6);
  s.elevation_width = draw.log_uniform(1e-6, 3.5);
  s.elevation_shape = static_cast<ElevationShape>(draw.count(1, 3.999) - 1);
  s.side_lobe_db = draw.one_in(2) ? 0 : draw.uniform(-85, -12);
  s.min_range = draw.log_uniform(1e-3, 1e3), s.max_range = s.min_range * draw.log_uniform(0.9, 1e3);
  return s;
}

Water any_water(Draw& draw) {
  return {draw.uniform(-5, 60), draw.one_in(5) ? 0 : draw.uniform(0, 60), draw.log_uniform(1e-3, 1.2e4),
          draw.uniform(4, 10)};
}

Eigen::Vector3d any_direction(Draw& draw) {
  const double z = draw.uniform(-1, 1), turn = draw.uniform(-pi, pi), across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// Returns surfels around the gate's ranges in every direction, of any size, most of them before the head.
SceneCloud any_scene(Draw& draw, const RangeGate& gate, double most) {
  SceneCloud scene;
  scene.materials = {{"a", draw.log_uniform(1e-9, 1)}, {"silent", 0}};
  scene.normals_oriented = draw.one_in(2);
  const std::size_t surfels = draw.count(1, most);
  const double size = draw.log_uniform(1e-6, 10);
  for (std::size_t i = 0; i < surfels; ++i) {
    const double range = draw.log_uniform(0.5 * gate.min_range, 2 * gate.max_range);
    Eigen::Vector3d u = any_direction(draw);
    if (!draw.one_in(4)) u = unit_vector({draw.uniform(-0.4, 0.4), draw.uniform(-0.4, 0.4)});
    add_surfel(scene, range * u, draw.one_in(3) ? Eigen::Vector3d(-u) : any_direction(draw),
               size * size * draw.uniform(0, 1), draw.one_in(10));
  }
  return scene;
}

/// Reduces the gate to a window of at most 200 bins, so that every case is small.
void shorten(RangeGate& gate, Draw& draw) {
  const double most = 200 * gate.bin_size;
  if (gate.max_range - gate.min_range <= most) return;
  gate.min_range = draw.log_uniform(gate.min_range, gate.max_range - most);
  gate.max_range = gate.min_range + most * draw.uniform(0.2, 1);
}

SimulationOptions any_options(Draw& draw) {
  SimulationOptions o;
  o.seed = draw.count(1, 1e9);
  o.sampling.kind = draw.one_in(3) ? SamplingKind::rays : SamplingKind::surfels;
  o.sampling.rays_per_beam = static_cast<int>(draw.count(1, 30));
  o.amplitude = static_cast<SurfaceAmplitude>(draw.count(1, 3.999) - 1);
  const bool split = draw.one_in(5);  // up to 4096 parts per surfel: for the fast method
  o.sampling.scatterers_per_cell = split ? draw.log_uniform(1e-3, 3) : 0;
  o.synthesis.method = !split && draw.one_in(4) ? SynthesisMethod::direct : SynthesisMethod::gridded;
  o.synthesis.tolerance = draw.log_uniform(1e-12, 0.5);
  if (const int order = static_cast<int>(draw.count(1, 3.999)) - 1; order >= 0) o.effects.absorption_order = order;
  o.threads = static_cast<int>(draw.count(1, 3.999));
  return o;
}

enum class Outcome { finite, refused, wrong };

/// Runs one case; an Error must be the caller's or the scene's fault and say so in one line.
template <typename Call>
Outcome outcome_of(std::uint64_t test_case, const Call& call) {
  try {
    if (call()) return Outcome::finite;
    ADD_FAILURE() << "case " << test_case << ": not all finite";
  } catch (const Error& error) {
    const bool theirs = error.kind() == ErrorKind::argument || error.kind() == ErrorKind::content;
    if (theirs && std::string(error.what()).find('\n') == std::string::npos) return Outcome::refused;
    ADD_FAILURE() << "case " << test_case << ": " << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "case " << test_case << ": not an Error: " << error.what();
  }
  return Outcome::wrong;
}

struct Tally {
  int finite = 0, refused = 0;
  void add(Outcome outcome) {
    finite += outcome == Outcome::finite;
    refused += outcome == Outcome::refused;
  }
};

TEST(RandomParameters, every_ping_is_finite_or_refused) {
  Tally tally;
  int received = 0;
  for (std::uint64_t c = 0; c < 6000; ++c)
    tally.add(outcome_of(c, [&] {
      Draw draw(c);
      const Water water = any_water(draw);
      SonarHead head = make_head(any_sonar(draw), sound_speed(water));
      shorten(head.gate, draw);
      const SimulationOptions options = any_options(draw);
      const SceneCloud scene = any_scene(draw, head.gate, options.sampling.scatterers_per_cell > 0 ? 8 : 300);
      const Pose pose =
          pose_from_yaw_pitch_roll({0, 0, 0}, draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-4, 4));
      const SimulatedPing p = simulate_ping(scene, head, pose, {water}, options);
      received += p.ping.pressure.abs().maxCoeff() > 0;
      return all_finite(p);
    }));
  // The ranges are not so wide that nothing works, nor so narrow that nothing is refused.
  EXPECT_GT(tally.finite, 500);
  EXPECT_GT(tally.refused, 100);
  EXPECT_GT(received, 200);
}

TEST(RandomParameters, gridded_synthesis_keeps_its_tolerance_against_the_referee_or_is_refused) {
  Tally tally;
  for (std::uint64_t c = 0; c < 600; ++c)
    tally.add(outcome_of(c, [&] {
      Draw draw(1000000 + c);
      const Water water = any_water(draw);
      SonarHead head = make_head(any_sonar(draw), sound_speed(water));
      shorten(head.gate, draw);
      const Medium medium = medium_of(water, head.pulse.centre_frequency, static_cast<int>(draw.count(1, 3.999)) - 1);
      Echoes echoes;
      const std::size_t count = draw.count(1, 100);
      for (std::size_t i = 0; i < count; ++i) {
        echoes.delay.push_back(2 * draw.uniform(head.gate.min_range, head.gate.max_range) / medium.sound_speed);
        echoes.u.push_back(draw.uniform(-1, 1));
        echoes.amplitude.push_back(std::polar(draw.log_uniform(0.1, 10), draw.uniform(-pi, pi)));
      }
      const double tolerance = draw.log_uniform(1e-9, 1e-2);
      const ComplexGrid slow = synthesize_direct(echoes, head, medium);
      const ComplexGrid fast = synthesize_gridded(echoes, head, medium, {.tolerance = tolerance});
      const double size = std::sqrt(slow.abs2().sum());
      // Beams away from all echoes contain little but cancelled terms: the error is relative to the echoes.
      // Delays are rounded to 1e-16 of themselves, which counts against the pulse's length.
      double incoherent = 0, rounding = 1e-11;
      for (std::size_t i = 0; i < count; ++i)
        incoherent +=
            std::norm(echoes.amplitude[i] *
                      echo_envelope(head.pulse, medium.absorption, 0.5 * medium.sound_speed * echoes.delay[i]).at(0));
      for (const double delay : echoes.delay) rounding = std::max(rounding, 1e-14 * head.pulse.bandwidth * delay);
      const double error = std::sqrt((fast - slow).abs2().sum());
      EXPECT_LE(error, tolerance * size + rounding * std::sqrt(incoherent))
          << "case " << c << ", tolerance " << tolerance << ", curvature " << medium.absorption.a2;
      return slow.isFinite().all() && fast.isFinite().all();
    }));
  EXPECT_GT(tally.finite, 100);
}

TEST(RandomParameters, every_envelope_is_finite_and_no_louder_than_it_was_sent_or_is_refused) {
  Tally tally;
  for (std::uint64_t c = 0; c < 20000; ++c)
    tally.add(outcome_of(c, [&] {
      Draw draw(2000000 + c);
      Pulse pulse;
      pulse.centre_frequency = draw.log_uniform(10, 1e9);
      pulse.bandwidth = pulse.centre_frequency * draw.log_uniform(1e-9, 1.99);
      const Absorption a =
          absorption_about(any_water(draw), pulse.centre_frequency, static_cast<int>(draw.count(1, 3.999)) - 1);
      const EchoEnvelope e = echo_envelope(pulse, a, draw.log_uniform(1e-6, 1e6));
      const double t = draw.log_uniform(1e-9, 10) / pulse.bandwidth;
      for (const std::complex<double> g : {e.at(0), e.at(t), e.at(-t)})
        if (!(std::abs(g) <= 1 + 1e-9)) return false;
      return true;
    }));
  EXPECT_GT(tally.finite, 10000);
}

TEST(RandomParameters, every_water_has_a_sound_speed_and_an_absorption_or_is_refused) {
  Tally tally;
  for (std::uint64_t c = 0; c < 20000; ++c)
    tally.add(outcome_of(c, [&] {
      Draw draw(3000000 + c);
      const Water water = any_water(draw);
      const double speed = sound_speed(water), alpha = absorption_db_per_m(water, draw.log_uniform(1e-3, 1e10));
      return speed > 1000 && speed < 3000 && alpha >= 0 && std::isfinite(alpha);
    }));
  EXPECT_GT(tally.finite, 15000);
  EXPECT_GT(tally.refused, 10);
}

}  // namespace insonify::random_parameters

// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "core/random.hpp"
#include "sonar/shading.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/point_targets.hpp"
#include "support/test.hpp"

namespace {

using Synthesis = ComplexGrid (*)(const Echoes&, const SonarHead&, const Medium&, const SynthesisOptions&);
const std::vector<ReplicaWindow> windows = {ReplicaWindow::uniform, ReplicaWindow::hann, ReplicaWindow::hamming};

/// A sweep over 60 kHz in 1 ms: BT = 60, 1.5 m of range.
SonarHead head_of(ReplicaWindow window, std::size_t beams = 5, std::size_t elements = 16, double max_range = 3) {
  SonarHead head = line_head({.beams = beams, .elements = elements, .max_range = max_range});
  head.pulse = {750e3, 60e3, 220, PulseShape::linear_fm, 1e-3, window};
  return head;
}

Echoes random_echoes(std::size_t n, double doppler = 0) {
  Echoes e;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto x = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (1 + 2 * x[0]) / c0_cold);
    e.u.push_back(-0.9 + 1.8 * x[1]);
    e.amplitude.push_back(std::polar(std::pow(10, -2 * x[2]), 2 * pi * x[3]));
    if (doppler != 0) e.doppler.push_back(doppler * (2 * x[3] - 1));
  }
  return e;
}

Medium sweep_medium(int order = 0) { return {c0_cold, absorption_about({}, 750e3, order)}; }

/// |a - b| at most, against the highest of b.
double highest_error(const ComplexGrid& a, const ComplexGrid& b) {
  return (a - b).abs().maxCoeff() / b.abs().maxCoeff();
}

}  // namespace

// The peak of a compressed echo is SL - 2 TL + TS: compression changes its length, not its level.
TEST(LinearFmSynthesis, peak_of_one_scatterer_is_the_sonar_equation) {
  for (const ReplicaWindow window : windows) {
    const SonarHead head = head_of(window, 1);
    const double r = head.gate.centre(200), ts = -20;
    const Echoes echoes = echoes_of(targets_at({r}), head.pulse, sweep_medium(), power_from_db(ts));
    const double loss = 20 * std::log10(r) + sweep_medium().absorption.a0 / nepers_per_db * r;
    for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum}) {
      Eigen::Index beam, bin;
      const double peak = synthesize(echoes, head, sweep_medium(), {1e-12, 0}).abs().maxCoeff(&beam, &bin);
      EXPECT_EQ(bin, 200);
      EXPECT_NEAR(pressure_level_db(peak), 220 - 2 * loss + ts, synthesize == synthesize_spectrum ? 1e-3 : 1e-9);
    }
  }
}

TEST(LinearFmSynthesis, gridded_keeps_its_tolerance_against_the_referee) {
  for (const ReplicaWindow window : windows)
    for (const double doppler : {0.0, 900.0})
      for (const int order : {0, 1, 2}) {
        const SonarHead head = head_of(window);
        const Echoes echoes = random_echoes(60, doppler);
        const ComplexGrid reference = synthesize_direct(echoes, head, sweep_medium(order));
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-4, 1e-10})
          EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, sweep_medium(order), {tolerance, 0}), reference),
                    tolerance)
              << "order " << order << ", doppler " << doppler;
      }
}

// An independent method: sampled sweep and replica, FFT, absorption as a filter on the spectrum. Without slope the
// difference is due to its sampling at 64 B. With slope the two treat the ends of the sweep differently: the derivative
// that a slope represents makes a spike at each end of height slope / (2 pi level T), which is 0.034 (hann) / BT per dB
// over the band for small slopes and grows with the loss between peak and end. Slopes of 1, 10 and 100 times that of
// water amount to up to 11 dB.
TEST(LinearFmSynthesis, spectrum_form_agrees_with_the_referee) {
  for (const ReplicaWindow window : windows)
    for (const double doppler : {0.0, 900.0}) {
      const SonarHead head = head_of(window, 3, 8);
      const Echoes echoes = random_echoes(12, doppler);
      EXPECT_LT(highest_error(synthesize_spectrum(echoes, head, sweep_medium()),
                              synthesize_direct(echoes, head, sweep_medium())),
                5e-5);
    }
}

TEST(LinearFmSynthesis, absorption_inside_the_band_agrees_with_a_filter_on_the_spectrum) {
  for (const ReplicaWindow window : windows)
    for (const double duration : {0.25e-3, 1e-3})
      for (const int order : {1, 2})
        for (const double times : {1.0, 10.0, 100.0}) {
          SonarHead head = head_of(window, 1, 8);
          head.pulse.duration = duration;
          Medium m = sweep_medium(order);
          m.absorption.a0 *= times, m.absorption.a1 *= times, m.absorption.a2 *= times;
          Echoes e;
          e.delay = {2 * 2.0 / c0_cold}, e.u = {0}, e.amplitude = {1};
          const double difference_db = 2 * m.absorption.a1 * 2.0 * head.pulse.bandwidth / nepers_per_db;
          EXPECT_LT(highest_error(synthesize_spectrum(e, head, m), synthesize_direct(e, head, m)),
                    5e-5 + 0.06 * difference_db / (head.pulse.bandwidth * duration))
              << difference_db << " dB over the band, order " << order;
        }
}

// A burst with a Doppler shift against a shifted spectrum.
TEST(LinearFmSynthesis, doppler_of_a_gaussian_agrees_with_a_moved_spectrum) {
  SonarHead head = head_of(ReplicaWindow::hann, 3, 8);
  head.pulse = {750e3, 60e3, 220};
  const Echoes echoes = random_echoes(20, 900);
  for (const int order : {0, 1, 2}) {
    const ComplexGrid direct = synthesize_direct(echoes, head, sweep_medium(order));
    EXPECT_LT(relative_l2(synthesize_spectrum(echoes, head, sweep_medium(order)), direct), 1e-11);
    EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, sweep_medium(order), {1e-8, 0}), direct), 1e-8);
  }
}

// The echo of a tone of 50 ms from an approaching target varies as exp(-2 pi i f_d t), the sign of the carrier.
TEST(LinearFmSynthesis, doppler_turns_a_long_burst_with_the_carrier) {
  SonarHead head = head_of(ReplicaWindow::hann, 1, 4, 60);
  head.pulse = {750e3, 20, 220};
  head.gate = {30, 60, 0.01};
  Echoes echoes;
  echoes.delay = {2 * 45 / c0_cold}, echoes.u = {0}, echoes.amplitude = {1};
  const ComplexGrid still = synthesize_direct(echoes, head, sweep_medium());
  echoes.doppler = {500};
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded}) {
    const ComplexGrid moving = synthesize(echoes, head, sweep_medium(), {1e-12, 0});
    for (Eigen::Index n = 0; n < still.cols(); n += 97) {
      const double t = 2 * head.gate.centre(static_cast<std::size_t>(n)) / c0_cold - echoes.delay[0];
      EXPECT_LT(std::abs(moving(0, n) - still(0, n) * std::polar(1.0, -2 * pi * 500 * t)), 1e-11);
    }
  }
}

TEST(LinearFmSynthesis, zero_doppler_equals_no_doppler) {
  for (const PulseShape shape : {PulseShape::gaussian, PulseShape::linear_fm}) {
    SonarHead head = head_of(ReplicaWindow::hamming);
    head.pulse.shape = shape;
    Echoes echoes = random_echoes(30);
    const ComplexGrid none = synthesize_direct(echoes, head, sweep_medium(2));
    const ComplexGrid gridded = synthesize_gridded(echoes, head, sweep_medium(2));
    echoes.doppler.assign(echoes.size(), 0);
    EXPECT_TRUE((synthesize_direct(echoes, head, sweep_medium(2)) == none).all());
    EXPECT_TRUE((synthesize_gridded(echoes, head, sweep_medium(2)) == gridded).all());
  }
}

TEST(LinearFmSynthesis, gives_the_same_bits_for_any_number_of_threads) {
  const SonarHead head = head_of(ReplicaWindow::hann, 9, 12);
  const Echoes echoes = random_echoes(80, 300);
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded}) {
    const ComplexGrid one = synthesize(echoes, head, sweep_medium(2), {1e-6, 1});
    for (const int threads : {2, 7})
      EXPECT_TRUE((synthesize(echoes, head, sweep_medium(2), {1e-6, threads}) == one).all());
  }
}

// White noise behind the filter has the autocorrelation integral (w s)(tau) conj(w s)(tau - lag) dtau of the weighted
// replica. 27 000 bins, BT = 60: about 12 000 independent values, 0.01 of scatter.
TEST(LinearFmSynthesis, noise_has_the_autocorrelation_of_the_replica) {
  for (const ReplicaWindow window : windows) {
    SonarHead head = head_of(window, 1, 1);
    head.gate.max_range = 150;
    head.array = {0.5 * c0_cold / 750e3, {1}};
    const ComplexGrid p = synthesize_noise(head, sweep_medium(), 60, {.seed = 4});
    EXPECT_NEAR(pressure_level_db(std::sqrt(p.abs2().mean())), 60, 0.15);

    const Pulse& pulse = head.pulse;
    const double half = 0.5 * pulse.duration, rate = pulse.bandwidth / pulse.duration;
    const auto replica = [&](double t) {
      return std::abs(t) > half ? 0 : std::polar(replica_weight(pulse, t), -pi * rate * t * t);
    };
    const auto expected = [&](double lag) {
      std::complex<double> sum = 0;
      for (double t = -half + 1e-8; t < half; t += 2e-8) sum += replica(t) * std::conj(replica(t - lag));
      return sum;
    };
    for (const int lag : {1, 2, 3, 10}) {
      const double seconds = lag * 2 * head.gate.bin_size / c0_cold;
      const auto n = p.cols() - lag;
      const auto a = p.row(0).head(n), b = p.row(0).tail(n);
      const std::complex<double> measured = (b * a.conjugate()).sum() / std::sqrt(a.abs2().sum() * b.abs2().sum());
      EXPECT_NEAR(std::abs(measured - expected(seconds) / expected(0)), 0, 0.035) << "lag " << lag;
    }
  }
}

TEST(LinearFmSynthesis, names_wrong_doppler_and_v) {
  const SonarHead head = head_of(ReplicaWindow::hann);
  Echoes e = random_echoes(4);
  e.doppler = {1, 2};
  EXPECT_EQ(error_of([&] { synthesize_direct(e, head, sweep_medium()); }),
            "synthesize_direct: 4 echoes have 0 values of v and 2 of doppler; must be none, or one of each per echo");
  e.doppler = {1, 2, std::nan(""), 4};
  EXPECT_EQ(error_of([&] { synthesize_gridded(e, head, sweep_medium()); }),
            "synthesize_gridded: echo 2 has v 0, doppler nan Hz; all must be finite");
  e.doppler.clear();
  e.v = {0, 0, 0, INFINITY};
  EXPECT_EQ(error_of([&] { synthesize_spectrum(e, head, sweep_medium()); }),
            "synthesize_spectrum: echo 3 has v inf, doppler 0 Hz; all must be finite");
}

TEST(LinearFmSpec, makes_a_head_whose_bins_sample_the_compressed_pulse) {
  SonarSpec s;
  s.centre_frequency = 750e3, s.bandwidth = 100e3, s.field_of_view = radians(90), s.beams = 64;
  s.beam_width = radians(1), s.elevation_width = radians(20), s.min_range = 1, s.max_range = 30;
  s.pulse = PulseShape::linear_fm, s.pulse_length = 2e-3;
  const SonarHead head = make_head(s, 1500);
  EXPECT_EQ(head.pulse.shape, PulseShape::linear_fm);
  EXPECT_EQ(head.pulse.duration, 2e-3);
  EXPECT_EQ(head.pulse.window, ReplicaWindow::hamming);
  EXPECT_DOUBLE_EQ(head.gate.bin_size, 0.44 * 1500 / 200e3);
  s.replica_window = ReplicaWindow::uniform;  // the narrowest: two bins in its -3 dB width
  EXPECT_EQ(make_head(s, 1500).pulse.window, ReplicaWindow::uniform);
  EXPECT_GT(range_resolution(make_head(s, 1500).pulse, 1500), 2 * head.gate.bin_size);
}

TEST(LinearFmSpec, refuses_incomplete_sweeps) {
  SonarSpec s;
  s.centre_frequency = 750e3, s.bandwidth = 100e3, s.field_of_view = radians(90), s.beams = 64;
  s.beam_width = radians(1), s.elevation_width = radians(20), s.min_range = 1, s.max_range = 30;
  const auto refusal = [&] { return error_of([&] { make_head(s, 1500); }); };
  s.pulse_length = 1e-3;
  EXPECT_EQ(refusal(),
            "make_head: pulse_length_s = 0.001 s, must be left out for pulse gaussian, whose length follows from its "
            "bandwidth; use pulse = \"linear_fm\"");
  s.pulse_length.reset(), s.replica_window = ReplicaWindow::hann;
  EXPECT_EQ(refusal(),
            "make_head: replica_window = hann, must be left out for pulse gaussian; use pulse = \"linear_fm\"");
  s.pulse = PulseShape::linear_fm;
  EXPECT_EQ(refusal(), "make_head: pulse = linear_fm, must come with pulse_length_s, the duration of the sweep");
  s.pulse_length = -1;
  EXPECT_EQ(refusal(), "make_head: pulse_length_s = -1 s, must be > 0");
  s.pulse_length = 1e-6;
  EXPECT_EQ(refusal(),
            "make_head: pulse_length_s = 1e-06 s, times bandwidth_hz = 100000 Hz, must be within 1 and 1e6; it is 0.1");
}

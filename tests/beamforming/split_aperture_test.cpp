// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/split_aperture.hpp"

#include "beamforming/synthesize_noise.hpp"
#include "beamforming/synthesizer.hpp"
#include "support/echo_chunks.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

const Medium split_water{1490, {0.01, 0, 0}};

/// Returns one echo in the middle of the gate.
Echoes one_echo(double u) { return {{2 * 2.0 / 1490}, {u}, {{0.3, -0.4}}}; }

SonarHead half_of(const SonarHead& head, ApertureSide side) { return half_aperture(head, side, "test"); }

/// Returns the distance from the middle of the whole array to that of a half [m].
double half_baseline(const SonarHead& head) {
  return 0.5 * head.array.spacing * static_cast<double>((head.array.elements() + 1) / 2);
}

/// Returns the peak of a beam's envelope about the echo.
std::complex<double> at_echo(const ComplexGrid& image, const SonarHead& head, std::size_t beam) {
  const auto bin = static_cast<Eigen::Index>((2.0 - head.gate.min_range) / head.gate.bin_size);
  return image(static_cast<Eigen::Index>(beam), bin);
}

}  // namespace

// Element by element: the sum over one half of w exp(-i k y (u - u_b)), y the element's place on the whole array.
TEST(SplitAperture, halves_are_sums_over_their_own_elements) {
  for (const std::size_t elements : {48U, 49U}) {
    const SonarHead head = line_head({.beams = 7, .elements = elements});
    const Echoes echo = one_echo(0.11);
    const ComplexGrid whole = synthesize_direct(echo, head, split_water);
    const double k = 2 * pi * head.pulse.centre_frequency / 1490;
    for (const ApertureSide side : {ApertureSide::port, ApertureSide::starboard}) {
      const SonarHead half_head = half_of(head, side);
      const ComplexGrid half = synthesize_gridded(echo, half_head, split_water, {.tolerance = 1e-9});
      EXPECT_LT(relative_l2(half, synthesize_direct(echo, half_head, split_water)), 1e-9);
      EXPECT_LT(relative_l2(half, synthesize_spectrum(echo, half_head, split_water)), 1e-8);
      for (std::size_t b = 0; b < head.fan.beams(); ++b) {
        const double u_b = std::sin(head.fan.azimuth[b]);
        std::complex<double> of_half = 0, of_all = 0;
        for (std::size_t m = 0; m < elements; ++m)
          of_all += head.array.shading[m] / static_cast<double>(elements) *
                    std::polar(1.0, k * head.array.spacing * element_position(m, elements) * (u_b - 0.11));
        const std::size_t first = side == ApertureSide::port ? elements - 24 : 0;
        for (std::size_t m = 0; m < elements; ++m) {
          EXPECT_EQ(half_head.array.shading[m] != 0, m >= first && m < first + 24) << m;
          of_half += half_head.array.shading[m] / static_cast<double>(elements) *
                     std::polar(1.0, k * head.array.spacing * element_position(m, elements) * (u_b - 0.11));
        }
        const std::complex<double> expected = at_echo(whole, head, b) / of_all * of_half;
        EXPECT_LT(std::abs(at_echo(half, head, b) - expected), 1e-7 * std::abs(at_echo(whole, head, 3))) << b;
      }
    }
  }
}

// An echo to port of a beam's axis comes to the port half first: its phase is behind there, by 2 k b (u - u_b).
TEST(SplitAperture, phase_grows_towards_port_and_crosses_zero_on_the_axis) {
  const SonarHead head = line_head({.beams = 1, .elements = 48});
  const double k = 2 * pi * head.pulse.centre_frequency / 1490;
  for (const double u : {-0.01, 0.0, 0.004, 0.015}) {
    const Echoes echo = one_echo(u);
    const auto half = [&](ApertureSide side) {
      return synthesize_gridded(echo, half_of(head, side), split_water, {.tolerance = 1e-9});
    };
    const Grid<float> phase = phase_between(half(ApertureSide::port), half(ApertureSide::starboard));
    const auto bin = static_cast<Eigen::Index>((2.0 - head.gate.min_range) / head.gate.bin_size);
    EXPECT_NEAR(static_cast<double>(phase(0, bin)), 2 * k * half_baseline(head) * u, 1e-5) << u;
  }
}

// Far away and of a narrow band, halves by true delays are those of the narrow band: the phase has one sign.
TEST(SplitAperture, phase_by_true_delays_is_that_of_the_narrow_band) {
  const SonarHead head = line_head({.beams = 1, .elements = 48, .max_range = 62});
  const double k = 2 * pi * head.pulse.centre_frequency / 1490;
  for (const double u : {-0.01, 0.004, 0.015}) {
    const Echoes echo{{2 * 60.0 / 1490}, {u}, {{0.3, -0.4}}};
    const auto half = [&](ApertureSide side) {
      return synthesize(echo, half_of(head, side), split_water, SynthesisMethod::true_delays, {.tolerance = 1e-4});
    };
    const auto bin = static_cast<Eigen::Index>((60.0 - head.gate.min_range) / head.gate.bin_size);
    const Grid<float> phase = phase_between(half(ApertureSide::port), half(ApertureSide::starboard));
    EXPECT_NEAR(static_cast<double>(phase(0, bin)), 2 * k * half_baseline(head) * u, 0.02) << u;
  }
}

// The elements of a half are those of the whole: noise of both halves is independent, and adds up to that of the whole
// where all are weighted alike.
TEST(SplitAperture, noise_of_the_halves_is_that_of_their_elements) {
  SonarHead head = line_head({.beams = 1, .elements = 32, .min_range = 1, .max_range = 20});
  head.array.shading.assign(32, 1.0);
  const ComplexGrid whole = synthesize_noise(head, split_water, 60);
  const ComplexGrid port = synthesize_noise(half_of(head, ApertureSide::port), split_water, 60);
  const ComplexGrid starboard = synthesize_noise(half_of(head, ApertureSide::starboard), split_water, 60);
  EXPECT_LT((whole - 0.5 * (port + starboard)).abs().maxCoeff(), 1e-12 * whole.abs().maxCoeff());
  const double power = port.abs2().mean();
  EXPECT_NEAR(power / whole.abs2().mean(), 2, 0.15);
  EXPECT_LT(std::abs((port * starboard.conjugate()).mean()), 0.1 * power);
}

TEST(SplitAperture, chunks_give_what_stored_echoes_give) {
  const SonarHead half = half_of(line_head({.beams = 9, .elements = 40}), ApertureSide::port);
  const Echoes echoes{{2 * 2.0 / 1490, 2 * 2.0 / 1490, 2 * 2.0 / 1490}, {-0.3, 0.02, 0.25}, {1.0, {0, 1}, -0.5}};
  const Synthesizer synthesizer(half, split_water, SynthesisMethod::gridded, {.tolerance = 1e-6});
  EXPECT_TRUE(
      (synthesizer.pressure(EchoChunks(echoes, split_water.sound_speed)) == synthesizer.pressure(echoes)).all());
}

TEST(SplitAperture, refuses_arrays_without_halves) {
  EXPECT_EQ(error_of([] { half_aperture(line_head({.elements = 6}), ApertureSide::port, "here"); }),
            "here: a split aperture needs at least 8 elements; this head has 6");
  SonarHead rows = line_head({.beams = 4, .elements = 16});
  rows.fan.elevation[0] = 0.2;
  EXPECT_THAT(error_of([&] { half_aperture(rows, ApertureSide::port, "here"); }),
              testing::HasSubstr("this head has several rows"));
}

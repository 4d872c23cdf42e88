// SPDX-License-Identifier: BSD-3-Clause
// A program of a user: eight threads ping while it plans Fourier transforms of its own, by the same FFTW.
#include <future>
#include <vector>

#include <fftw3.h>
#include <insonify/insonify.hpp>

int main() {
  using namespace insonify;
  SceneCloud bed;
  for (int i = 0; i < 100; ++i)
    for (int j = -50; j < 50; ++j) add_surfel(bed, {0.1 * i, 0.1 * j, 0}, {0, 0, 1}, 0.01);
  const PreparedScene scene(bed);
  std::vector<std::future<double>> peaks;
  for (int k = 0; k < 8; ++k)
    peaks.push_back(std::async(std::launch::async, [&scene, k] {
      const SonarSpec spec{.name = "mine",
                           .centre_frequency = 900e3,
                           .bandwidth = 30e3,
                           .beams = 16 + k,
                           .field_of_view = radians(60),
                           .beam_width = radians(3),
                           .elevation_width = radians(20),
                           .min_range = 1,
                           .max_range = 8};
      const PingSimulator simulator(make_head(spec, sound_speed(Water{})), {}, {.threads = 1});
      return double{simulator.ping(scene, {.world_from_head = pose_from_yaw_pitch_roll({0, 0, 2}, 0, radians(25), 0)})
                        .ping.pressure.abs()
                        .maxCoeff()};
    }));
  std::vector<fftw_complex> numbers(4096);
  for (int length = 64; length <= 4096; ++length)
    fftw_destroy_plan(fftw_plan_dft_1d(length, numbers.data(), numbers.data(), FFTW_FORWARD, FFTW_ESTIMATE));
  bool beam_azimuth = true;
  for (auto& peak : peaks) beam_azimuth = peak.get() > 0 && beam_azimuth;
  return beam_azimuth ? 0 : 1;
}

#include <algorithm>
#include <cmath>
#include <numeric>

#include "beamforming/narrow_band/gridding_loops_internal.hpp"
#include "beamforming/narrow_band/windowed_sum_internal.hpp"
#include "beamforming/numerics/flush_denormals_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t beams_at_once = 8;             // beams per thread that share the cached phasors
constexpr std::size_t numbers_in_memory = 0x400000;  // phasors, or samples, in memory

/// Writes cosine and sine of (first + p) step for p < pairs, `stride` apart, by rotation; evaluated anew every 16
/// steps.
void write_phasors(double first, double step, std::size_t pairs, std::size_t stride, double* to) {
  const double turn_re = std::cos(step), turn_im = std::sin(step);
  double re = 0, im = 0;
  for (std::size_t p = 0; p < pairs; ++p) {
    const double phase = (first + static_cast<double>(p)) * step, before = re;
    re = p % 16 == 0 ? std::cos(phase) : re * turn_re - im * turn_im;
    im = p % 16 == 0 ? std::sin(phase) : before * turn_im + im * turn_re;
    to[2 * p * stride] = re;
    to[(2 * p + 1) * stride] = im;
  }
}

}  // namespace

/// Data shared by all beams: phasors of the echoes along the array, and their pulses.
struct WindowedSum::Work {
  std::vector<double> phasor;               ///< blocks x terms x block
  std::vector<std::vector<double>> sample;  ///< per block: amplitude times pulse, real and imaginary parts interleaved
  std::vector<std::uint32_t> start, count,
      place;                   ///< per echo: first bin, number of bins, first sample within its block
  std::vector<double> energy;  ///< pulse energy per echo [Pa^2 bins]
};

WindowedSum::WindowedSum(const SonarHead& head, const Medium& medium, double cut, int threads)
    : head_(head),
      medium_(medium),
      cut_(cut),
      threads_(threads),
      axis_(head.gate, medium.sound_speed),
      shapes_(head.pulse, medium),
      u_beam_(beam_cosines(head.fan)) {
  // cos is even: elements at +y and -y form one term.
  const std::size_t n = head.array.elements();
  step_ = 2 * pi * head.array.spacing * head.pulse.centre_frequency / medium.sound_speed;
  first_place_ = element_place(n / 2, n);
  for (std::size_t m = n / 2; m < n; ++m) {
    const std::size_t opposite = n - 1 - m;
    const double w = head.array.shading[m] + (opposite == m ? 0 : head.array.shading[opposite]);
    weight_.push_back(w / static_cast<double>(n));
  }
  terms_.resize(2 * weight_.size());
  std::iota(terms_.begin(), terms_.end(), 0U);
}

void WindowedSum::prepare(const Echoes& echoes, std::size_t first, std::size_t last, Work& work) const {
  const PulseReach reach(head_.pulse, medium_.absorption, medium_.sound_speed, !echoes.doppler.empty(), cut_);
  const std::size_t count = last - first, blocks = (count + block - 1) / block;
  work.phasor.resize(blocks * terms_.size() * block);
  work.sample.resize(blocks);
  for (auto* numbers : {&work.start, &work.count, &work.place}) numbers->assign(blocks * block, 0);
  work.energy.assign(blocks * block, 0);
  parallel_blocks(count, block, threads_, [&](std::size_t begin, std::size_t end) {
    double* phasor = work.phasor.data() + begin * terms_.size();
    std::vector<double>& sample = work.sample[begin / block];
    sample.clear();
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = first + k;
      const auto [from, to] = axis_.around(echoes.delay[i], reach.at(echoes.delay[i]));
      work.start[k] = static_cast<std::uint32_t>(from);
      work.count[k] = static_cast<std::uint32_t>(to - from);
      work.place[k] = static_cast<std::uint32_t>(sample.size());
      const EchoEnvelope envelope = shapes_.of(echoes.delay[i], echoes.doppler_of(i));
      for (std::size_t n = from; n < to; ++n) {
        const double t = axis_.start + static_cast<double>(n) * axis_.step - echoes.delay[i];
        const std::complex<double> g = echoes.amplitude[i] * envelope.at(t);
        sample.push_back(g.real());
        sample.push_back(g.imag());
        work.energy[k] += std::norm(g);
      }
      write_phasors(first_place_, step_ * echoes.u[i], weight_.size(), block, phasor + k - begin);
    }
  });
}

void WindowedSum::add(const Work& work, std::size_t first_beam, std::size_t last_beam, ComplexGrid& pressure,
                      std::vector<double>& incoherent) const {
  const std::size_t terms = terms_.size();
  std::vector<double> steering((last_beam - first_beam) * terms);
  for (std::size_t b = first_beam; b < last_beam; ++b) {
    double* of_beam = steering.data() + (b - first_beam) * terms;
    write_phasors(first_place_, step_ * u_beam_[b], weight_.size(), 1, of_beam);
    for (std::size_t k = 0; k < terms; ++k) of_beam[k] *= weight_[k / 2];
  }
  for (std::size_t e = 0; e < work.sample.size(); ++e)
    for (std::size_t b = first_beam; b < last_beam; ++b) {
      // The pattern of one beam for all echoes of the block (E10), then their pulses (E12).
      const std::size_t first = e * block;
      double response[block];
      kernels::interpolate(steering.data() + (b - first_beam) * terms, terms_.data(), terms,
                           work.phasor.data() + first * terms, block, block, response);
      kernels::add_pulses(response, {work.start.data() + first, work.count.data() + first, work.place.data() + first},
                          work.sample[e].data(), block,
                          reinterpret_cast<double*>(&pressure(static_cast<Eigen::Index>(b), 0)));
      for (std::size_t k = 0; k < block; ++k) incoherent[b] += response[k] * response[k] * work.energy[first + k];
    }
}

WindowedImage WindowedSum::image(const Echoes& echoes) const {
  const std::size_t beams = u_beam_.size(), bins = axis_.bins, chunk = echoes_at_once();
  WindowedImage result{ComplexGrid(beams, bins)};
  std::vector<double> coherent(beams / beams_at_once + 1, 0), incoherent(beams, 0);
  Work work;
  for (std::size_t first = 0; first == 0 || first < echoes.size(); first += chunk) {
    const std::size_t last = std::min(first + chunk, echoes.size());
    prepare(echoes, first, last, work);
    parallel_blocks(beams, beams_at_once, threads_, [&](std::size_t begin, std::size_t end) {
      const FlushDenormals flush;
      auto rows = result.pressure.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
      if (first == 0) rows.setZero();
      add(work, begin, end, result.pressure, incoherent);
      if (last == echoes.size()) coherent[begin / beams_at_once] = rows.abs2().sum();
    });
  }
  const double all = std::accumulate(incoherent.begin(), incoherent.end(), 0.0);
  if (all > 0) result.kept = std::sqrt(std::accumulate(coherent.begin(), coherent.end(), 0.0) / all);
  return result;
}

std::size_t WindowedSum::echoes_at_once() const {
  const PulseReach reach(head_.pulse, medium_.absorption, medium_.sound_speed, true, cut_);
  const double samples = std::min(2 * reach.half / axis_.step + 1, static_cast<double>(axis_.bins));
  const auto numbers = std::max(terms_.size(), 2 * static_cast<std::size_t>(samples));
  return std::max<std::size_t>(numbers_in_memory / numbers / block, 1) * block;
}

}  // namespace insonify

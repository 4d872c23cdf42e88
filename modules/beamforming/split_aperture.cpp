#include "beamforming/split_aperture.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "acoustics/echo_stream.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t fewest_elements = 8;

/// `shading` read at `count` places spread over its whole length, linear in between, with sum `count`.
std::vector<double> resampled_shading(const std::vector<double>& shading, std::size_t count) {
  const double last = static_cast<double>(shading.size()) - 1;
  std::vector<double> weights(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double place =
        std::clamp((static_cast<double>(j) + 0.5) / static_cast<double>(count) * (last + 1) - 0.5, 0.0, last);
    const auto low = std::min(static_cast<std::size_t>(place), shading.size() - 2);
    const double part = place - static_cast<double>(low);
    weights[j] = (1 - part) * shading[low] + part * shading[low + 1];
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w *= static_cast<double>(count) / sum;
  return weights;
}

/// Phase per direction cosine at a half: sound from its side comes to it earlier, by a smaller delay than the middle's.
double phase_per_cosine(const SplitAperture& split, ApertureSide side, const Medium& medium) {
  const double place = side == ApertureSide::port ? split.half_baseline : -split.half_baseline;
  return -2 * pi * split.head.pulse.centre_frequency / medium.sound_speed * place;
}

Echoes turned(const Echoes& echoes, double phase_per_u) {
  Echoes here = echoes;
  for (std::size_t i = 0; i < here.size(); ++i) here.amplitude[i] *= std::polar(1.0, phase_per_u * here.u[i]);  // (E92)
  return here;
}

/// The echoes of a stream with the phase of a half.
class TurnedEchoes final : public EchoStream {
 public:
  TurnedEchoes(const EchoStream& stream, double phase_per_u) : stream_(stream), phase_per_u_(phase_per_u) {}
  std::span<const ChunkBounds> chunks() const override { return stream_.chunks(); }
  bool moving() const override { return stream_.moving(); }
  void visit(std::size_t chunk, EchoSink& sink) const override {
    TurningSink turning(sink, phase_per_u_);
    stream_.visit(chunk, turning);
  }

 private:
  struct TurningSink final : EchoSink {
    EchoSink& next;
    double phase_per_u;
    TurningSink(EchoSink& sink, double phase) : next(sink), phase_per_u(phase) {}
    bool wants(const SurfelBounds& bounds) const override { return next.wants(bounds); }
    bool chooses_patches() const override { return next.chooses_patches(); }
    void take(const Scatterers& patches, const Echoes& echoes) override {
      next.take(patches, turned(echoes, phase_per_u));
    }
  };
  const EchoStream& stream_;
  double phase_per_u_;
};

void steer_rows(ComplexGrid& pressure, const BeamFan& fan, double phase_per_u) {
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    const double u = std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b]);
    pressure.row(static_cast<Eigen::Index>(b)) *= std::polar(1.0, -phase_per_u * u);
  }
}

}  // namespace

SplitAperture split_aperture(const SonarHead& head, const char* who) {
  require_valid(head, who);
  if (head.column || fan_rows(head.fan).size() > 1)
    fail(ErrorKind::argument, who, ": a split aperture needs one row of beams of a line array; this head has ",
         head.column ? "a planar array" : "several rows");
  const std::size_t elements = head.array.elements(), half = elements / 2;
  if (elements < fewest_elements)
    fail(ErrorKind::argument, who, ": a split aperture needs at least ", fewest_elements, " elements; this head has ",
         elements);
  SplitAperture split{head, 0};
  split.head.array.shading = resampled_shading(head.array.shading, half);
  split.half_baseline = 0.5 * head.array.spacing * static_cast<double>(elements - half);
  return split;
}

ComplexGrid half_pressure(const EchoStream& stream, const SplitAperture& split, ApertureSide side, const Medium& medium,
                          const SynthesisOptions& options) {
  const double per_u = phase_per_cosine(split, side, medium);
  if (stream.stored()) return half_pressure(*stream.stored(), split, side, medium, options);
  ComplexGrid pressure = PingSynthesizer(split.head, medium, options).pressure(TurnedEchoes(stream, per_u));
  steer_rows(pressure, split.head.fan, per_u);
  return pressure;
}

ComplexGrid half_pressure(const Echoes& echoes, const SplitAperture& split, ApertureSide side, const Medium& medium,
                          const SynthesisOptions& options) {
  const double per_u = phase_per_cosine(split, side, medium);
  ComplexGrid pressure = synthesize_gridded(turned(echoes, per_u), split.head, medium, options);
  steer_rows(pressure, split.head.fan, per_u);
  return pressure;
}

SonarHead with_one_half(const SonarHead& head, const SplitAperture& split, ApertureSide side) {
  SonarHead masked = head;
  const std::vector<double>& half = split.head.array.shading;
  const std::size_t elements = head.array.elements();
  const std::size_t first = side == ApertureSide::port ? elements - half.size() : 0;
  const double scale = static_cast<double>(elements) / static_cast<double>(half.size());
  std::fill(masked.array.shading.begin(), masked.array.shading.end(), 0.0);
  for (std::size_t m = 0; m < half.size(); ++m) masked.array.shading[first + m] = scale * half[m];
  return masked;
}

Grid<float> phase_between(const ComplexGrid& port, const ComplexGrid& starboard) {
  return (starboard * port.conjugate()).arg().cast<float>();
}

}  // namespace insonify

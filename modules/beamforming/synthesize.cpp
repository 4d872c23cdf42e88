#include "beamforming/synthesize.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "beamforming/element_series.hpp"
#include "beamforming/head_patterns.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

ComplexGrid synthesize_line(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                            const SynthesisOptions& options) {
  switch (method) {
    case SynthesisMethod::direct:
      return synthesize_direct(echoes, head, medium, options);
    case SynthesisMethod::spectrum:
      return synthesize_spectrum(echoes, head, medium, options);
    case SynthesisMethod::element_exact: {
      const ElementOptions exact{options.tolerance, Wavefront::spherical, options.threads};
      return beam_from_elements(hear_elements(echoes, head, medium, exact), head, medium, exact);
    }
    case SynthesisMethod::stamped:
      break;
  }
  return synthesize_stamped(echoes, head, medium, options);
}

/// Echoes as each row of a head hears them.
class RowEchoes {
 public:
  /// An echo is left out of a row whose response is below `part` of that of the row nearest to it; 0: never.
  RowEchoes(const Echoes& echoes, const SonarHead& head, double wavelength, const std::vector<FanRow>& rows,
            double part, int threads)
      : echoes_(echoes), head_(head), wavelength_(wavelength), threads_(threads), least_(echoes.size(), -1) {
    if (part == 0) return;
    std::vector<double> v_row;
    for (const FanRow& row : rows) v_row.push_back(std::sin(row.elevation));
    parallel_blocks(echoes.size(), block, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const double v = echoes.v[i];
        std::size_t above = std::lower_bound(v_row.begin(), v_row.end(), v) - v_row.begin();
        if (above > 0 && (above == rows.size() || v - v_row[above - 1] < v_row[above] - v)) --above;
        least_[i] = part * std::abs(RowResponse(head, wavelength, rows[above].elevation).at(v));
      }
    });
  }

  Echoes of(const FanRow& row) const {
    std::vector<double> response(echoes_.size());
    parallel_blocks(echoes_.size(), block, threads_, [&](std::size_t begin, std::size_t end) {
      RowResponse row_response(head_, wavelength_, row.elevation);
      for (std::size_t i = begin; i < end; ++i) response[i] = row_response.at(echoes_.v[i]);
    });
    Echoes heard;
    for (std::size_t i = 0; i < echoes_.size(); ++i) {
      if (std::abs(response[i]) <= least_[i]) continue;
      heard.delay.push_back(echoes_.delay[i]);
      heard.u.push_back(echoes_.u[i]);
      heard.amplitude.push_back(echoes_.amplitude[i] * response[i]);
      if (!echoes_.doppler.empty()) heard.doppler.push_back(echoes_.doppler[i]);
    }
    return heard;
  }

 private:
  static constexpr std::size_t block = 4096;
  const Echoes& echoes_;
  const SonarHead& head_;
  double wavelength_;
  int threads_;
  std::vector<double> least_;  // response below which an echo is left out of a row
};

/// The head with the beams of one row alone, as a line array.
SonarHead line_head(const SonarHead& head, const FanRow& row) {
  SonarHead line = head;
  line.column.reset();
  line.fan.row_width = 0;
  line.fan.elevation.assign(row.beams.size(), row.elevation);
  line.fan.azimuth.clear();
  for (const std::size_t b : row.beams) line.fan.azimuth.push_back(head.fan.azimuth[b]);
  return line;
}

void require_elevations(const Echoes& echoes) {
  if (echoes.v.size() != echoes.size())
    fail(ErrorKind::argument, "synthesize: echoes have ", echoes.size(), " delays and ", echoes.v.size(),
         " directions upwards (v), must be one of each for a head with several rows of beams");
}

}  // namespace

ComplexGrid synthesize(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize");
  const std::vector<FanRow> rows = fan_rows(head.fan);
  if (rows.size() == 1 && !head.column) return synthesize_line(echoes, head, medium, method, options);
  require_elevations(echoes);

  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const double part = 0.1 * options.tolerance / std::sqrt(static_cast<double>(rows.size()));
  const RowEchoes row_echoes(echoes, head, wavelength, rows, method == SynthesisMethod::direct ? 0 : part,
                             options.threads);
  ComplexGrid pressure(head.fan.beams(), head.gate.bins());
  for (const FanRow& row : rows) {
    const ComplexGrid line = synthesize_line(row_echoes.of(row), line_head(head, row), medium, method, options);
    for (std::size_t k = 0; k < row.beams.size(); ++k) pressure.row(row.beams[k]) = line.row(k);
  }
  return pressure;
}

}  // namespace insonify

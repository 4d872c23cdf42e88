// SPDX-License-Identifier: BSD-3-Clause
#include "returns/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/head_patterns.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "returns/beam_responses_internal.hpp"

namespace insonify {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// Intensity responses of the beams of a head.
class Beams {
 public:
  Beams(const SonarHead& head, const Medium& medium)
      : responses_(head, medium.sound_speed / head.pulse.centre_frequency) {
    const std::vector<FanRow> rows = fan_rows(head.fan);
    has_row_response_ = rows.size() > 1 || head.column;
    for (const FanRow& row : rows) {
      rows_.push_back({std::sin(row.elevation),
                       {},
                       RowResponse(head, medium.sound_speed / head.pulse.centre_frequency, row.elevation)});
      std::vector<double>& u = rows_.back().u;
      for (const std::size_t b : row.beams) u.push_back(std::cos(row.elevation) * std::sin(head.fan.azimuth[b]));
      std::sort(u.begin(), u.end());
    }
  }

  /// A beam of the fan: its row and direction cosine.
  struct Beam {
    std::size_t row = 0;
    double u = 0;
  };

  /// Returns the beam with the largest response among those nearest to the direction in each row.
  Beam best(double u, double v) {
    Beam best;
    double most = -1;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::vector<double>& beams = rows_[r].u;
      auto at = std::lower_bound(beams.begin(), beams.end(), u);
      if (at == beams.end() || (at != beams.begin() && u - at[-1] < *at - u)) --at;
      const Beam beam{r, *at};
      if (rows_.size() == 1) return beam;
      if (const double response = intensity(beam, u, v); response > most) most = response, best = beam;
    }
    return best;
  }

  /// Returns the integral of a beam's response over its peak, in direction cosine, over eight beam widths to either
  /// side. Grating lobes are not counted.
  double equivalent_width(double beam_width) const {
    const double step = beam_width / 64;
    double sum = 0.5 * responses_.intensity(0, 0, 0, 0);
    for (int k = 1; k < 8 * 64 && k * step < 1; ++k) sum += responses_.intensity(k * step, 0, 0, 0);
    return 2 * step * sum;
  }

  double intensity(const Beam& beam, double u, double v) {
    const double of_line = responses_.intensity(u, v, beam.u, rows_[beam.row].v);
    if (!has_row_response_) return of_line;
    const double of_row = rows_[beam.row].response.at(v);
    return of_line * of_row * of_row;
  }

 private:
  struct Row {
    double v;               ///< upward direction cosine of the beams
    std::vector<double> u;  ///< ascending
    RowResponse response;
  };
  BeamResponses responses_;
  std::vector<Row> rows_;
  bool has_row_response_ = false;  ///< false for one row of a line array
};

struct SurfelContribution {
  std::uint32_t surfel;
  Beams::Beam beam;
  double intensity = 0;                ///< mean square [Pa^2]
  double on_axis = 0;                  ///< the same in a beam of that row that looks there [Pa^2]
  double cross_section = 0, area = 0;  ///< [m^2]
  double cell = 0;                     ///< resolution cell on the surface at the first part [m^2]
  bool hit = false;
  float cosine = 0, range = 0;  ///< extremes over the parts that count as insonified
};

/// Area of a resolution cell on a surface [m^2] (E74): equivalent widths of pulse and beam.
class ResolutionCell {
 public:
  ResolutionCell(const SonarHead& head, const Medium& medium, const Beams& beams)
      : length_(energy_length(head.pulse, medium.sound_speed)), width_(beams.equivalent_width(head.fan.beam_width)) {}

  double area(double range, double cos_incidence, double u, double v) const {
    const double sine = std::sqrt(std::max(0.0, 1 - cos_incidence * cos_incidence)), ahead = 1 - u * u - v * v;
    const double along = std::min(length_ / sine, 2 * std::sqrt(2 * range * length_));
    return along * range * width_ * std::sqrt((1 - v * v) / std::max(ahead, 1e-6));
  }

 private:
  double length_, width_;
};

std::vector<SurfelContribution> surfel_contributions(const SceneCloud& scene, const Scatterers& scatterers,
                                                     const Echoes& echoes, const SonarHead& head,
                                                     const Transmission& sent, double min_response) {
  const Medium& medium = sent.medium;
  Beams beams(head, medium);
  const ResolutionCell cell(head, medium, beams);
  std::vector<std::uint32_t> position(scene.size(), none);
  std::vector<SurfelContribution> contributions;
  for (std::size_t i = 0; i < scatterers.size(); ++i) {
    const std::uint32_t surfel = scatterers.surfel[i];
    if (position[surfel] == none) {
      position[surfel] = static_cast<std::uint32_t>(contributions.size());
      contributions.push_back({surfel, beams.best(echoes.u[i], echoes.v[i])});
      contributions.back().cell = cell.area(scatterers.range[i], scatterers.cos_incidence[i], echoes.u[i], echoes.v[i]);
    }
    SurfelContribution& h = contributions[position[surfel]];
    const double range = scatterers.range[i], response = beams.intensity(h.beam, echoes.u[i], echoes.v[i]);
    const double arriving = 0.5 * std::norm(echoes.amplitude[i]) * std::exp(-4 * medium.absorption.a0 * range);
    const double cosine = scatterers.cos_incidence[i], seen_area = scatterers.projected_area[i];
    h.intensity += arriving * response;
    h.on_axis += arriving * beams.intensity({h.beam.row, echoes.u[i]}, echoes.u[i], echoes.v[i]);
    h.cross_section += cross_section(*sent.surfaces[scatterers.material[i]], {cosine, cosine, seen_area});
    if (cosine > 0) h.area += seen_area / cosine;
    if (!(response >= min_response && range >= head.gate.min_range && range <= head.gate.max_range)) continue;
    const auto r = static_cast<float>(range);
    h.range = h.hit ? std::min(h.range, r) : r;
    h.cosine = std::max(h.cosine, scatterers.cos_incidence[i]);
    h.hit = true;
  }
  return contributions;
}

}  // namespace

std::vector<CoveredSurfel> coverage_of(const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
                                       const Medium& medium, const CoverageOptions& options) {
  constexpr const char* who = "coverage_of";
  require_valid(head, who);
  require_valid(medium, who);
  require(options.min_response_db <= 0, who, "min_response_db", options.min_response_db, "dB", "<= 0");
  for (const std::uint32_t surfel : scatterers.surfel)
    if (surfel >= scene.size())
      fail(ErrorKind::argument, who, ": a scatterer is of surfel ", surfel, ", but the scene has ", scene.size());

  // A coherent amplitude of 1 is the rms amplitude of every speckle distribution.
  EchoOptions echo_options;
  echo_options.amplitude = SurfaceAmplitude::coherent;
  echo_options.threads = options.threads;
  Transmission sent{head.pulse, medium, with_patterns(echo_options, head)};
  sent.surfaces = surfaces_of(sent, scene.materials);
  const Echoes echoes = direct_echoes(scatterers, scene.materials, sent);

  std::vector<CoveredSurfel> covered;
  const double min_response = power_from_db(options.min_response_db);
  for (const SurfelContribution& h : surfel_contributions(scene, scatterers, echoes, head, sent, min_response)) {
    if (!h.hit) continue;
    const float grazing = std::asin(std::min(1.0F, h.cosine));
    CoveredSurfel& s = covered.emplace_back(CoveredSurfel{
        scene.id[h.surfel], 1, scene.origin + scene.point[h.surfel].cast<double>(), grazing, h.range, h.intensity});
    const auto level = [](double power) { return static_cast<float>(db_from_power(power)); };
    s.level_db = level(h.intensity / (micropascal * micropascal));  // (E64)
    if (!(h.area > 0)) continue;
    s.scattering_db = level(h.cross_section / h.area);  // (E74)
    s.cell_level_db = level(h.on_axis / (micropascal * micropascal) * h.cell / h.area);
  }
  std::sort(covered.begin(), covered.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return covered;
}

void add(CoveredSurfel& to, const CoveredSurfel& more) {
  // (E97)
  to.pings += more.pings;
  to.grazing_angle = std::max(to.grazing_angle, more.grazing_angle);
  to.range = std::min(to.range, more.range);
  to.intensity += more.intensity;
  to.level_db = std::max(to.level_db, more.level_db);
  to.scattering_db = std::max(to.scattering_db, more.scattering_db);
  to.cell_level_db = std::max(to.cell_level_db, more.cell_level_db);
}

void add(std::vector<CoveredSurfel>& to, const std::vector<CoveredSurfel>& more) {
  std::vector<CoveredSurfel> sum;
  sum.reserve(to.size() + more.size());
  auto a = to.begin();
  for (const CoveredSurfel& b : more) {
    for (; a != to.end() && a->id < b.id; ++a) sum.push_back(*a);
    if (a != to.end() && a->id == b.id)
      add(sum.emplace_back(*a++), b);
    else
      sum.push_back(b);
  }
  sum.insert(sum.end(), a, to.end());
  to = std::move(sum);
}

}  // namespace insonify

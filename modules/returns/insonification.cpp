#include "returns/insonification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/head_patterns.hpp"
#include "beamforming/response_table.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr const char* me = "add_ping";
constexpr std::uint32_t none = 0xffffffff;

/// What the beams of a head make of directions, as intensities.
class Beams {
 public:
  Beams(const SonarHead& head, const Medium& medium)
      : table_(head.array, medium.sound_speed / head.pulse.centre_frequency) {
    const std::vector<FanRow> rows = fan_rows(head.fan);
    weighed_ = rows.size() > 1 || head.column;
    for (const FanRow& row : rows) {
      rows_.push_back({{}, RowResponse(head, medium.sound_speed / head.pulse.centre_frequency, row.elevation)});
      std::vector<double>& u = rows_.back().u;
      for (const std::size_t b : row.beams) u.push_back(std::cos(row.elevation) * std::sin(head.fan.azimuth[b]));
      std::sort(u.begin(), u.end());
    }
  }

  /// A beam: which row, and where it looks.
  struct Beam {
    std::size_t row = 0;
    double u = 0;
  };

  /// Of the beams that are nearest in each row, the one that hears the direction best.
  Beam best(double u, double v) {
    Beam best;
    double most = -1;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const std::vector<double>& beams = rows_[r].u;
      auto at = std::lower_bound(beams.begin(), beams.end(), u);
      if (at == beams.end() || (at != beams.begin() && u - at[-1] < *at - u)) --at;
      const Beam beam{r, *at};
      if (rows_.size() == 1) return beam;
      if (const double heard = intensity(beam, u, v); heard > most) most = heard, best = beam;
    }
    return best;
  }

  double intensity(const Beam& beam, double u, double v) {
    const double of_line = table_.intensity(u - beam.u);
    if (!weighed_) return of_line;
    const double of_row = rows_[beam.row].response.at(v);
    return of_line * of_row * of_row;
  }

 private:
  struct Row {
    std::vector<double> u;  ///< ascending
    RowResponse response;
  };
  ResponseTable table_;
  std::vector<Row> rows_;
  bool weighed_ = false;  ///< whether rows have a response of their own
};

/// What one ping hears of one surfel.
struct Heard {
  std::uint32_t surfel;
  Beams::Beam beam;
  double intensity = 0;  ///< [Pa^2], mean square
  bool hit = false;
  float cosine = 0, range = 0;  ///< largest and least of the parts that count as heard
};

std::vector<Heard> strongest_beams(std::size_t surfels, const Scatterers& scatterers, const Echoes& echoes,
                                   const SonarHead& head, const Medium& medium, double least) {
  Beams beams(head, medium);
  std::vector<std::uint32_t> place(surfels, none);
  std::vector<Heard> heard;
  for (std::size_t i = 0; i < scatterers.size(); ++i) {
    const std::uint32_t surfel = scatterers.surfel[i];
    if (place[surfel] == none) {
      place[surfel] = static_cast<std::uint32_t>(heard.size());
      heard.push_back({surfel, beams.best(echoes.u[i], echoes.v[i])});
    }
    Heard& h = heard[place[surfel]];
    const double range = scatterers.range[i], response = beams.intensity(h.beam, echoes.u[i], echoes.v[i]);
    h.intensity += 0.5 * std::norm(echoes.amplitude[i]) * response * std::exp(-4 * medium.absorption.a0 * range);
    if (!(response >= least && range >= head.gate.min_range && range <= head.gate.max_range)) continue;
    const auto r = static_cast<float>(range);
    h.range = h.hit ? std::min(h.range, r) : r;
    h.cosine = std::max(h.cosine, scatterers.cos_incidence[i]);
    h.hit = true;
  }
  return heard;
}

void require_map(const Insonification& map, const SceneCloud& scene) {
  const std::size_t n = map.pings == 0 && map.hits.empty() ? 0 : scene.size();
  for (const std::size_t size : {map.hits.size(), map.level_db.size(), map.grazing_angle.size(), map.range.size()})
    if (size != n)
      fail(ErrorKind::argument, me, ": the map has ", size, " surfels, but the scene has ", scene.size(),
           "; give an empty map, or one of this scene");
}

}  // namespace

void add_ping(Insonification& map, const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
              const Medium& medium, const InsonificationOptions& options) {
  require_valid(head, me);
  require_valid(medium, me);
  require_map(map, scene);
  if (!(options.least_response_db <= 0))
    fail(ErrorKind::argument, me, ": least_response_db = ", options.least_response_db, " dB, must be <= 0");
  for (const std::uint32_t surfel : scatterers.surfel)
    if (surfel >= scene.size())
      fail(ErrorKind::argument, me, ": a scatterer is of surfel ", surfel, ", but the scene has ", scene.size());

  // A coherent amplitude of 1 is the root mean square of every law of speckle.
  EchoOptions echo_options;
  echo_options.amplitude = SurfaceAmplitude::coherent;
  echo_options.threads = options.threads;
  const Echoes echoes =
      direct_echoes(scatterers, scene.materials, head.pulse, medium, with_patterns(echo_options, head));
  const double least = power_from_db(options.least_response_db);
  const std::vector<Heard> heard = strongest_beams(scene.size(), scatterers, echoes, head, medium, least);

  // The best of all pings.
  if (map.hits.empty()) {
    map.hits.assign(scene.size(), 0);
    map.level_db.assign(scene.size(), -std::numeric_limits<float>::infinity());
    map.grazing_angle.assign(scene.size(), 0);
    map.range.assign(scene.size(), std::numeric_limits<float>::infinity());
  }
  ++map.pings;
  for (const Heard& h : heard) {
    if (!h.hit) continue;
    ++map.hits[h.surfel];
    const auto level = static_cast<float>(db_from_power(h.intensity / (micropascal * micropascal)));  // (E64)
    map.level_db[h.surfel] = std::max(map.level_db[h.surfel], level);
    map.grazing_angle[h.surfel] = std::max(map.grazing_angle[h.surfel], std::asin(std::min(1.0F, h.cosine)));
    map.range[h.surfel] = std::min(map.range[h.surfel], h.range);
  }
}

}  // namespace insonify

#include "returns/detect_soundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/sounding_columns.hpp"

namespace insonify {
namespace {

/// A detected sample of one beam.
struct Cell {
  std::uint32_t bin;
  float level_db;
  float offset = 0;  ///< of the peak from the middle of the bin [bins]
};

/// A local maximum at the peak of the parabola through its level and those of its neighbours. (E72)
Cell peak_between(float before, Cell at, float after) {
  constexpr float steepest = 24.1F;  // of a Gaussian as long as a bin, from one bin to the next; more is a null
  before = std::max(before, at.level_db - steepest);
  after = std::max(after, at.level_db - steepest);
  at.offset = 0.5F * (before - after) / (before - 2 * at.level_db + after);
  at.level_db -= 0.25F * (before - after) * at.offset;
  return at;
}

/// Returns the bins of beam b that are detections. (E19)
std::vector<Cell> detect_in_beam(const Grid<float>& level, Eigen::Index b, const std::vector<float>& strongest,
                                 const DetectionOptions& options) {
  std::vector<Cell> cells;
  const Eigen::Index bins = level.cols();
  const auto threshold = static_cast<float>(options.noise_floor_db + options.threshold_db);
  const auto margin = static_cast<float>(options.side_lobe_margin_db);
  const auto above = static_cast<float>(options.above_db);
  for (Eigen::Index n = 0; n < bins; ++n) {
    const float here = level(b, n);
    const bool found = options.all_bins
                           ? here >= above && here > -200
                           : here > threshold && here >= strongest[static_cast<std::size_t>(n)] - margin &&
                                 (n == 0 || here > level(b, n - 1)) && (n + 1 == bins || here >= level(b, n + 1));
    if (!found) continue;
    cells.push_back({static_cast<std::uint32_t>(n), here});
    if (!options.all_bins && n > 0 && n + 1 < bins)
      cells.back() = peak_between(level(b, n - 1), cells.back(), level(b, n + 1));
  }
  return cells;
}

/// Half extent of the search for contributors around a beam: in direction cosine, and in elevation [rad].
struct AngularExtent {
  double u = 0, elevation = std::numeric_limits<double>::infinity();
};

/// Echoes sorted by range bin and within a bin by direction cosine, to find the contributors of a sample.
class ContributorTable {
 public:
  ContributorTable(const Echoes& echoes, const Scatterers& scatterers, const RangeGate& gate)
      : echoes_(echoes), scatterers_(scatterers), begin_(gate.bins() + 1, 0) {
    std::vector<std::uint32_t> bin(echoes.size());
    const auto bins = static_cast<double>(gate.bins());
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      // The first and the last bin include echoes up to one bin outside the gate.
      const double n = std::floor((scatterers.range[i] - gate.min_range) / gate.bin_size);
      bin[i] = n >= -1 && n <= bins ? static_cast<std::uint32_t>(std::clamp(n, 0.0, bins - 1)) : outside;
      if (bin[i] != outside) ++begin_[bin[i] + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    order_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < echoes.size(); ++i)
      if (bin[i] != outside) order_[next[bin[i]]++] = static_cast<std::uint32_t>(i);
    for (std::size_t n = 0; n + 1 < begin_.size(); ++n)
      std::sort(order_.begin() + begin_[n], order_.begin() + begin_[n + 1], [&](std::uint32_t a, std::uint32_t b) {
        return echoes.u[a] < echoes.u[b] || (echoes.u[a] == echoes.u[b] && a < b);
      });
  }

  /// Returns the strongest echo in bins bin-1 .. bin+1 within `extent` of direction cosine u and elevation, or `none`.
  std::uint32_t strongest(std::uint32_t bin, double u, double elevation, AngularExtent extent) const {
    std::uint32_t best = none;
    double best_power = 0;
    const std::size_t first = bin > 0 ? bin - 1 : 0, last = std::min<std::size_t>(bin + 2, begin_.size() - 1);
    for (std::size_t n = first; n < last; ++n) {
      const auto end = order_.begin() + begin_[n + 1];
      auto at = std::lower_bound(order_.begin() + begin_[n], end, u - extent.u,
                                 [&](std::uint32_t i, double value) { return echoes_.u[i] < value; });
      for (; at != end && echoes_.u[*at] <= u + extent.u; ++at) {
        if (!(std::abs(scatterers_.elevation[*at] - elevation) <= extent.elevation)) continue;
        const double power = std::norm(echoes_.amplitude[*at]);
        if (power > best_power) best_power = power, best = *at;
      }
    }
    return best;
  }

  static constexpr std::uint32_t none = 0xffffffff;

 private:
  static constexpr std::uint32_t outside = 0xffffffff;
  const Echoes& echoes_;
  const Scatterers& scatterers_;
  std::vector<std::uint32_t> begin_, order_;
};

/// Search region of a beam: first its own share of the fan, so that neighbouring beams do not report the same
/// scatterer, then its whole -3 dB width. A fan of one row does not resolve elevation.
struct BeamRegion {
  double u = 0, elevation = 0;
  AngularExtent share, width;
};

/// Limits half widths to half the distance between neighbours.
void limit_to_midpoints(std::vector<std::pair<double, double*>> widths) {
  std::sort(widths.begin(), widths.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 1; k < widths.size(); ++k) {
    const double gap = (widths[k].first - widths[k - 1].first) / 2;
    *widths[k - 1].second = std::min(*widths[k - 1].second, gap);
    *widths[k].second = std::min(*widths[k].second, gap);
  }
}

std::vector<BeamRegion> beam_regions(const BeamFan& fan) {
  std::vector<BeamRegion> regions(fan.beams());
  const std::vector<FanRow> rows = fan_rows(fan);
  const double row_width = fan.row_width > 0 ? fan.row_width : fan.elevation_width;
  const bool within_elevation = rows.size() > 1 || fan.row_width > 0;
  std::vector<double> row_share(rows.size(), row_width / 2);
  std::vector<std::pair<double, double*>> row_widths;
  for (std::size_t r = 0; r < rows.size(); ++r) row_widths.emplace_back(rows[r].elevation, &row_share[r]);
  limit_to_midpoints(row_widths);

  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::pair<double, double*>> beam_widths;
    for (const std::size_t b : rows[r].beams) {
      BeamRegion& region = regions[b];
      region.u = std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b]);
      region.elevation = fan.elevation[b];
      region.share.u = region.width.u = std::sin(std::min(fan.beam_width / 2, pi / 2));
      if (within_elevation) region.share.elevation = row_share[r], region.width.elevation = row_width / 2;
      beam_widths.emplace_back(region.u, &region.share.u);
    }
    limit_to_midpoints(beam_widths);
  }
  return regions;
}

void append(Soundings& all, const Soundings& part) {
  const auto join = [](const char*, auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  join("position", all.position, part.position);
  each_column(join, all, part);
}

/// Appends the sounding of one detection, in the direction of its strongest contributor.
void add_sounding(Soundings& s, const Ping& ping, std::size_t beam, Cell cell, const Scatterers& scatterers,
                  std::uint32_t contributor) {
  const double range = ping.gate.centre(cell.bin) + static_cast<double>(cell.offset) * ping.gate.bin_size;
  const Direction direction{scatterers.azimuth[contributor], scatterers.elevation[contributor]};
  s.position.push_back(ping.world_from_head * (range * unit_vector(direction)));
  s.level_db.push_back(cell.level_db);
  s.range.push_back(static_cast<float>(range));
  s.azimuth.push_back(static_cast<float>(ping.fan.azimuth[beam]));
  s.elevation.push_back(static_cast<float>(direction.elevation));
  s.ping.push_back(static_cast<std::uint32_t>(ping.number));
  s.beam.push_back(static_cast<std::uint32_t>(beam));
  s.bin.push_back(cell.bin);
  s.material.push_back(scatterers.material[contributor]);
}

}  // namespace

Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options) {
  if (scatterers.size() != echoes.size())
    fail(ErrorKind::argument, "detect_soundings: ", scatterers.size(), " scatterers, but ", echoes.size(), " echoes");
  const std::size_t beams = ping.fan.beams();
  const Grid<float> level = level_db(ping);
  std::vector<float> strongest(ping.gate.bins(), -200);
  for (Eigen::Index n = 0; n < level.cols(); ++n) strongest[static_cast<std::size_t>(n)] = level.col(n).maxCoeff();

  // Beams are processed independently; their soundings are appended in beam order.
  const ContributorTable contributors(echoes, scatterers, ping.gate);
  const std::vector<BeamRegion> regions = beam_regions(ping.fan);
  std::vector<Soundings> of_beam(beams);
  parallel_for(beams, options.threads, [&](std::size_t b) {
    for (const Cell cell : detect_in_beam(level, static_cast<Eigen::Index>(b), strongest, options)) {
      const BeamRegion& region = regions[b];
      std::uint32_t contributor = contributors.strongest(cell.bin, region.u, region.elevation, region.share);
      if (contributor == ContributorTable::none)
        contributor = contributors.strongest(cell.bin, region.u, region.elevation, region.width);
      if (contributor != ContributorTable::none) add_sounding(of_beam[b], ping, b, cell, scatterers, contributor);
    }
  });
  Soundings all;
  for (const Soundings& part : of_beam) append(all, part);
  return all;
}

}  // namespace insonify

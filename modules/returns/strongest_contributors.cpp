#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/strongest_contributors_internal.hpp"

namespace insonify {
namespace {

/// Half extent of the search for contributors around a beam: in direction cosine, and in elevation [rad].
struct AngularExtent {
  double u = 0, elevation = std::numeric_limits<double>::infinity();
};

/// Search region of a beam: its own share of the fan, and its whole -3 dB width. A fan of one row does not resolve
/// elevation.
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

constexpr std::size_t slab_bins = 512;      // of pixels that one thread searches
constexpr std::size_t worth_filter = 4096;  // pixels of a slab: of more, nearly every part is near one

/// The pixels of bins [first, first + slab_bins): for each echo those that it may contribute to.
class SlabSearch {
 public:
  SlabSearch(const std::vector<Pixel>& pixels, const std::vector<std::size_t>& beam_begin,
             const std::vector<BeamRegion>& regions, const RangeGate& gate, std::size_t first)
      : regions_(regions),
        gate_(gate),
        bins_(static_cast<double>(gate.bins())),
        first_(first),
        end_(std::min(first + slab_bins, gate.bins())),
        begin_(end_ - first + 1, 0) {
    for (const BeamRegion& region : regions) widest_ = std::max(widest_, region.width.u);
    const auto below = [](const Pixel& p, std::size_t bin) { return p.bin < bin; };
    for (std::size_t b = 0; b + 1 < beam_begin.size(); ++b) {
      const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(beam_begin[b]),
                 to = pixels.begin() + static_cast<std::ptrdiff_t>(beam_begin[b + 1]);
      for (auto p = std::lower_bound(from, to, first_, below); p != to && p->bin < end_; ++p)
        wanted_.push_back({p->bin, p->beam, regions[b].u, static_cast<std::size_t>(p - pixels.begin())});
    }
    std::sort(wanted_.begin(), wanted_.end(), [](const Wanted& a, const Wanted& b) {
      return a.bin != b.bin ? a.bin < b.bin : a.u != b.u ? a.u < b.u : a.pixel < b.pixel;
    });
    for (const Wanted& w : wanted_) ++begin_[w.bin - first_ + 1];
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
    for (const Wanted& w : wanted_) by_u_.emplace_back(w.u, w.bin);
    std::sort(by_u_.begin(), by_u_.end());
  }

  bool empty() const { return wanted_.empty(); }
  bool overlaps(const EchoSource::Chunk& chunk) const {
    return last_bin(chunk.max_range) >= first_ && first_bin(chunk.min_range) < end_;
  }
  /// Whether a pixel is near a surfel.
  bool near(const PatchPlace& place) const {
    if (wanted_.size() > worth_filter) return true;
    const std::size_t low = first_bin(place.range - place.reach), high = last_bin(place.range + place.reach);
    const double reach = widest_ + place.reach_u;
    auto at = std::lower_bound(by_u_.begin(), by_u_.end(), std::pair<double, std::uint32_t>(place.u - reach, 0));
    for (; at != by_u_.end() && at->first <= place.u + reach; ++at)
      if (at->second >= low && at->second <= high) return true;
    return false;
  }
  /// Offers echoes as contributors of all pixels of the slab, in order.
  void offer(const Scatterers& s, const Echoes& echoes, std::vector<StrongestContributor>& found) const {
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      // The first and the last bin include echoes up to one bin outside the gate.
      const double n = std::floor((s.range[i] - gate_.min_range) / gate_.bin_size);
      if (!(n >= -1 && n <= bins_)) continue;
      const auto bin = static_cast<std::size_t>(std::clamp(n, 0.0, bins_ - 1));
      if (bin + 1 < first_ || bin > end_) continue;
      const std::size_t low = std::max(bin, first_ + 1) - 1 - first_, high = std::min(bin + 2, end_) - first_;
      for (std::size_t row = low; row < high; ++row) offer(s, echoes, i, row, found);
    }
  }

 private:
  struct Wanted {
    std::uint32_t bin, beam;
    double u;
    std::size_t pixel;
  };
  std::size_t first_bin(double range) const { return bin_of(range, -2); }
  std::size_t last_bin(double range) const { return bin_of(range, 2); }
  std::size_t bin_of(double range, double more) const {
    const double n = std::floor((range - gate_.min_range) / gate_.bin_size) + more;
    return static_cast<std::size_t>(std::clamp(n, 0.0, bins_));
  }

  void offer(const Scatterers& s, const Echoes& echoes, std::size_t i, std::size_t row,
             std::vector<StrongestContributor>& found) const {
    const auto end = wanted_.begin() + static_cast<std::ptrdiff_t>(begin_[row + 1]);
    auto at = std::lower_bound(wanted_.begin() + static_cast<std::ptrdiff_t>(begin_[row]), end, echoes.u[i] - widest_,
                               [](const Wanted& w, double u) { return w.u < u; });
    for (; at != end && at->u <= echoes.u[i] + widest_; ++at) {
      const BeamRegion& region = regions_[at->beam];
      const double du = std::abs(echoes.u[i] - region.u), up = std::abs(s.elevation[i] - region.elevation);
      if (!(du <= region.width.u && up <= region.width.elevation)) continue;
      const bool own = du <= region.share.u && up <= region.share.elevation;
      const double power = std::norm(echoes.amplitude[i]);
      StrongestContributor& best = found[at->pixel];
      if (own == best.own_share ? power > best.power : own && power > 0)
        best = {power, own, {s.azimuth[i], s.elevation[i]}, static_cast<std::uint32_t>(s.id[i] >> 32), s.material[i]};
    }
  }

  const std::vector<BeamRegion>& regions_;
  const RangeGate& gate_;
  double bins_;
  std::size_t first_, end_;
  double widest_ = 0;
  std::vector<std::size_t> begin_;                      // of the pixels of each bin, in wanted_
  std::vector<Wanted> wanted_;                          // by bin, then direction cosine of the beam
  std::vector<std::pair<double, std::uint32_t>> by_u_;  // direction cosine and bin of each
};

}  // namespace

std::vector<StrongestContributor> strongest_contributors(const std::vector<Pixel>& pixels, const EchoSource& source,
                                                         const BeamFan& fan, const RangeGate& gate, int threads) {
  const std::vector<BeamRegion> regions = beam_regions(fan);
  std::vector<std::size_t> beam_begin(fan.beams() + 1, 0);
  for (const Pixel& p : pixels) ++beam_begin[p.beam + 1];
  for (std::size_t b = 0; b < fan.beams(); ++b) beam_begin[b + 1] += beam_begin[b];
  std::vector<StrongestContributor> found(pixels.size());
  // Each slab of bins is searched by one thread, which visits the chunks that reach into it, in order.
  parallel_for((gate.bins() + slab_bins - 1) / slab_bins, threads, [&](std::size_t slab) {
    const SlabSearch search(pixels, beam_begin, regions, gate, slab * slab_bins);
    if (search.empty()) return;
    for (std::size_t c = 0; c < source.chunks.size(); ++c)
      if (search.overlaps(source.chunks[c]))
        source.visit(
            c, [&](const PatchPlace& place) { return search.near(place); },
            [&](const Scatterers& s, const Echoes& echoes) { search.offer(s, echoes, found); });
  });
  return found;
}

}  // namespace insonify

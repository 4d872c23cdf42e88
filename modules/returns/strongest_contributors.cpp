// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "acoustics/echo_stream.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/strongest_contributors_internal.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {
namespace {

/// Half extent of the search around a beam: in direction cosine, and in elevation [rad].
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

/// Returns the number of bins that one thread searches: small enough that no thread waits long, large enough that most
/// surfels lie in one slab.
std::size_t slab_bins(const RangeGate& gate) { return std::clamp<std::size_t>(gate.bins() / 16, 64, 512); }

/// A table that shows whether a rectangle of bins and direction cosines may contain a pixel. It holds the sums over all
/// cells below and left of each.
class PixelTable {
 public:
  PixelTable(std::size_t bins, double u_low, double u_high)
      : u_low_(u_low), per_u_(columns / std::max(u_high - u_low, 1e-9)), sum_((bins + 1) * (columns + 1), 0) {}

  void count(std::size_t bin, double u) { ++sum_[(bin + 1) * (columns + 1) + column(u) + 1]; }
  void add_up() {
    for (std::size_t at = columns + 2; at < sum_.size(); ++at)
      if (at % (columns + 1) != 0) sum_[at] += sum_[at - 1] + sum_[at - columns - 1] - sum_[at - columns - 2];
  }
  /// Returns true if there may be a pixel in bins [first, end) and between two direction cosines.
  bool may_hold(std::size_t first, std::size_t end, double u_low, double u_high) const {
    const std::size_t low = column(u_low), high = column(u_high) + 1;
    const std::uint32_t *below = &sum_[first * (columns + 1)], *above = &sum_[end * (columns + 1)];
    return above[high] - above[low] != below[high] - below[low];
  }

 private:
  static constexpr std::size_t columns = 512;
  std::size_t column(double u) const {
    return static_cast<std::size_t>(std::clamp((u - u_low_) * per_u_, 0.0, columns - 1.0));
  }
  double u_low_, per_u_;
  std::vector<std::uint32_t> sum_;
};

/// The pixels of bins [first, end). It offers each echo, in order, to the pixels to which it may contribute.
class SlabSearch final : public EchoSink {
 public:
  SlabSearch(const std::vector<Pixel>& pixels, const std::vector<std::size_t>& beam_begin,
             const std::vector<BeamRegion>& regions, const RangeGate& gate, std::size_t first, std::size_t end,
             const SceneCloud* scene, std::vector<StrongestContributor>& found)
      : regions_(regions),
        gate_(gate),
        bins_(static_cast<double>(gate.bins())),
        first_(first),
        end_(std::min(end, gate.bins())),
        nearest_(gate.min_range + (static_cast<double>(first_) - beside) * gate.bin_size),
        farthest_(gate.min_range + (static_cast<double>(end_) + beside) * gate.bin_size),
        scene_(scene),
        found_(found),
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
    if (empty()) return;
    const auto [low, high] =
        std::minmax_element(wanted_.begin(), wanted_.end(), [](const Wanted& a, const Wanted& b) { return a.u < b.u; });
    table_.emplace(end_ - first, low->u, high->u);
    for (const Wanted& w : wanted_) table_->count(w.bin - first_, w.u);
    table_->add_up();
  }

  bool empty() const { return wanted_.empty(); }
  bool overlaps(const ChunkBounds& chunk) const {
    return last_bin(chunk.max_range) >= first_ && first_bin(chunk.min_range) < end_;
  }
  /// Returns true if a pixel is near the surfel.
  bool wants(const SurfelBounds& s) const override {
    const std::size_t low = first_bin(s.range - s.reach), high = last_bin(s.range + s.reach);
    return may_hold(low, high + 1, s.u, widest_ + s.reach_u);
  }
  bool chooses_patches() const override { return true; }
  void take(const Scatterers& s, const Echoes& echoes) override {
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      if (!(s.range[i] >= nearest_ && s.range[i] <= farthest_)) continue;
      // The first and the last bin include echoes up to one bin outside the gate.
      const double n = std::floor((s.range[i] - gate_.min_range) / gate_.bin_size);
      if (!(n >= -1 && n <= bins_)) continue;
      const auto bin = static_cast<std::size_t>(std::clamp(n, 0.0, bins_ - 1));
      if (bin + 1 < first_ || bin > end_) continue;
      const std::size_t low = std::max(bin, first_ + 1) - 1 - first_, high = std::min(bin + 2, end_) - first_;
      if (!may_hold(low + first_, high + first_, echoes.u[i], widest_)) continue;
      for (std::size_t row = low; row < high; ++row) offer(s, echoes, i, row);
    }
  }

 private:
  struct Wanted {
    std::uint32_t bin, beam;
    double u;
    std::size_t pixel;
  };
  /// Returns true if there may be a pixel in bins [first, end) within `reach` of u.
  bool may_hold(std::size_t first, std::size_t end, double u, double reach) const {
    first = std::max(first, first_), end = std::min(end, end_);
    return first < end && table_->may_hold(first - first_, end - first_, u - reach, u + reach);
  }
  std::size_t first_bin(double range) const { return bin_of(range, -2); }
  std::size_t last_bin(double range) const { return bin_of(range, 2); }
  std::size_t bin_of(double range, double more) const {
    const double n = std::floor((range - gate_.min_range) / gate_.bin_size) + more;
    return static_cast<std::size_t>(std::clamp(n, 0.0, bins_));
  }

  void offer(const Scatterers& s, const Echoes& echoes, std::size_t i, std::size_t row) {
    const auto end = wanted_.begin() + static_cast<std::ptrdiff_t>(begin_[row + 1]);
    auto at = std::lower_bound(wanted_.begin() + static_cast<std::ptrdiff_t>(begin_[row]), end, echoes.u[i] - widest_,
                               [](const Wanted& w, double u) { return w.u < u; });
    for (; at != end && at->u <= echoes.u[i] + widest_; ++at) {
      const BeamRegion& region = regions_[at->beam];
      const double du = std::abs(echoes.u[i] - region.u), up = std::abs(s.elevation[i] - region.elevation);
      if (!(du <= region.width.u && up <= region.width.elevation)) continue;
      const bool own = du <= region.share.u && up <= region.share.elevation;
      const StrongestContributor offered{std::norm(echoes.amplitude[i]),
                                         own,
                                         {s.azimuth[i], s.elevation[i]},
                                         scene_ ? scene_->id[s.surfel[i]] : static_cast<std::uint32_t>(s.id[i] >> 32),
                                         s.material[i]};
      if (StrongestContributor& best = found_[at->pixel]; is_stronger(offered, best)) best = offered;
    }
  }

  static constexpr double beside = 3;  // bins that hold all echoes near the slab, whatever is rounded

  const std::vector<BeamRegion>& regions_;
  const RangeGate& gate_;
  double bins_;
  std::size_t first_, end_;
  double nearest_, farthest_;  // range of echoes [m]
  double widest_ = 0;
  const SceneCloud* scene_;
  std::vector<StrongestContributor>& found_;
  std::vector<std::size_t> begin_;  // first pixel of each bin, index into wanted_
  std::vector<Wanted> wanted_;      // by bin, then direction cosine of the beam
  std::optional<PixelTable> table_;
};

}  // namespace

std::vector<StrongestContributor> strongest_contributors(const std::vector<Pixel>& pixels, const EchoStream& stream,
                                                         const BeamFan& fan, const RangeGate& gate,
                                                         const DetectionOptions& options) {
  const std::vector<BeamRegion> regions = beam_regions(fan);
  std::vector<std::size_t> beam_begin(fan.beams() + 1, 0);
  for (const Pixel& p : pixels) ++beam_begin[p.beam + 1];
  for (std::size_t b = 0; b < fan.beams(); ++b) beam_begin[b + 1] += beam_begin[b];
  std::vector<StrongestContributor> found(pixels.size());
  const std::span<const ChunkBounds> chunks = stream.chunks();
  // Each slab of bins is searched by one thread, which visits the chunks that reach into it, in order.
  parallel_blocks(gate.bins(), slab_bins(gate), options.threads, [&](std::size_t first, std::size_t end) {
    SlabSearch search(pixels, beam_begin, regions, gate, first, end, options.scene, found);
    if (search.empty()) return;
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (search.overlaps(chunks[c])) stream.visit(c, search);
  });
  return found;
}

}  // namespace insonify

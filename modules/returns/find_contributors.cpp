// SPDX-License-Identifier: BSD-3-Clause
#include "returns/find_contributors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "beamforming/head_patterns.hpp"
#include "core/chebyshev.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "core/work_progress.hpp"
#include "returns/beam_responses_internal.hpp"
#include "returns/surfel_arrivals_internal.hpp"
#include "sonar/pulse.hpp"

// Finds the strongest contributors of every pixel (E63), a contributor being a surfel by one pair of legs:
//   1. sort the echoes that reach the gate by surfel and legs into groups (surfel_arrivals);
//   2. sample the pulse energy |A G|^2 of each echo on the bins it overlaps;
//   3. write a group's energy in a beam as sum_k B^2(u_k - u_b) energy_k(n): one term per echo or, if cheaper, one per
//      Chebyshev node in u, since B^2 is band-limited (interpolation error 1e-6);
//   4. for each beam within reach, add up the terms with tabulated B^2 and insert the group into the pixels' lists;
//   5. convert energies to shares of the pixel's total.
// Cost: terms x beams above the floor x bins per term, some 5 ns per echo and beam; parallel over beams or rows, in
// chunks of groups of bounded memory.
namespace insonify {
namespace {

/// Returns the number of Chebyshev nodes over [-half, half] that interpolate a sum of cosines of period >= `period`
/// with relative error `error`; 0 if more than `most` are needed. The error of n nodes is x^n / (2^(n-1) n!), x = 2 pi
/// half / period.
std::size_t chebyshev_nodes(double half, double period, double error, std::size_t most) {
  const double x = 2 * pi * half / period;
  double left = x;
  for (std::size_t n = 1; n <= most; ++n, left *= x / (2 * static_cast<double>(n)))
    if (left <= error) return n;
  return 0;
}

constexpr std::size_t samples_at_once = 1 << 19;  ///< pulse samples in memory
constexpr double interpolation_error = 1e-6;      ///< error of B^2 between nodes, relative to its size there
constexpr std::size_t max_nodes = 16;

/// Pulse energies of the arrivals of consecutive groups in the bins they overlap, before beams: `length` samples each.
struct Pulses {
  std::size_t first_group, last_group, first_arrival;
  std::vector<std::size_t> bin;  ///< bin of the first sample of each arrival
  std::vector<double> energy;
};

/// One term of a group: direction cosine, and the bins from `bin` (relative to the group's first) with their energies.
struct Term {
  double u;
  std::size_t bin, length, energy;
};

/// A group as a sum of terms, E(b, n) = sum B^2(u - u_b) energy(n). B^2 is a sum of cosines no faster than 2 pi / lobe,
/// so a few Chebyshev nodes represent all arrivals of a small surfel.
struct GroupTerms {
  std::size_t first_bin, bins;
  std::vector<Term> terms;
  std::vector<double> energy;
};

/// The strongest groups of every pixel found so far.
struct StrongestGroups {
  std::size_t per_pixel;
  std::vector<double> energy, total;
  std::vector<double> least;  ///< least energy kept
  std::vector<std::uint32_t> group;

  StrongestGroups(std::size_t pixels, std::size_t kept)
      : per_pixel(kept), energy(pixels * kept, 0), total(pixels, 0), least(pixels, 0), group(pixels * kept, none) {}

  /// Adds the energies of a group in `count` pixels from `first` on; negative values (interpolation error) count as 0.
  void add(std::size_t first, std::size_t count, const double* e, std::uint32_t g) {
    double *all = total.data() + first, *threshold = least.data() + first;
    for (std::size_t n = 0; n < count; ++n) all[n] += std::max(e[n], 0.0);
    for (std::size_t n = 0; n < count; ++n)
      if (e[n] > threshold[n]) threshold[n] = insert(first + n, e[n], g);
  }

 private:
  static constexpr std::uint32_t none = Contributors::none;

  double insert(std::size_t pixel, double e, std::uint32_t g) {
    double* kept = energy.data() + pixel * per_pixel;
    std::uint32_t* names = group.data() + pixel * per_pixel;
    std::size_t k = per_pixel - 1;
    for (; k > 0 && e > kept[k - 1]; --k) kept[k] = kept[k - 1], names[k] = names[k - 1];
    kept[k] = e, names[k] = g;
    return kept[per_pixel - 1];
  }
};

class Search {
 public:
  Search(const SonarHead& head, const Medium& medium, std::vector<Arrival> arrivals, const DelayBins& axis,
         const ContributorOptions& options)
      : head_(head),
        wavelength_(medium.sound_speed / head.pulse.centre_frequency),
        options_(options),
        axis_(axis),
        shapes_(head.pulse, medium),
        responses_(head, wavelength_),
        floor_(power_from_db(options.floor_db)),
        reach_(responses_.reach(floor_)),
        lobe_(responses_.lobe()),
        rows_(fan_rows(head.fan)),
        arrivals_(std::move(arrivals)),
        groups_(groups_of(arrivals_)),
        found_(head.fan.beams() * axis.bins, static_cast<std::size_t>(options.per_pixel)) {}

  /// Processes the groups in order, in chunks that fit into memory, in parallel over beams.
  void run() {
    const bool one_row = rows_.size() == 1 && !head_.column;
    ObservedLoop observed(groups_.size());
    for (std::size_t g = 0; g < groups_.size();) {
      const Pulses pulses = pulses_from(g);
      const std::size_t count = pulses.last_group - g;
      std::vector<GroupTerms> terms(one_row ? count : 0);
      if (one_row) {
        parallel_blocks(count, 64, options_.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) terms[k] = terms_of(groups_[g + k], pulses, {});
        });
        parallel_for(head_.fan.beams(), options_.threads, [&](std::size_t b) { accumulate(b, g, terms); });
      } else {
        parallel_for(rows_.size(), options_.threads, [&](std::size_t r) {
          const std::vector<double> weights = row_weights(rows_[r], pulses);
          std::vector<GroupTerms> of_row(count);
          for (std::size_t k = 0; k < count; ++k) of_row[k] = terms_of(groups_[g + k], pulses, weights);
          for (const std::size_t b : rows_[r].beams) accumulate(b, g, of_row);
        });
      }
      for (; g < pulses.last_group; ++g) observed.advance();
    }
  }

  Contributors contributors(const SceneCloud& scene) const;

 private:
  Pulses pulses_from(std::size_t first_group) const {
    Pulses p{first_group, first_group, groups_[first_group].first, {}, {}};
    const std::size_t max_arrivals = std::max<std::size_t>(1, samples_at_once / axis_.length);
    do ++p.last_group;
    while (p.last_group < groups_.size() && groups_[p.last_group].last - p.first_arrival <= max_arrivals);
    const std::size_t count = groups_[p.last_group - 1].last - p.first_arrival;
    p.bin.resize(count);
    p.energy.assign(count * axis_.length, 0);
    parallel_blocks(count, 1024, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Arrival& a = arrivals_[p.first_arrival + i];
        const EchoEnvelope envelope = shapes_.of(a.delay, a.doppler);
        const auto [low, high] = axis_.reached(a.delay);
        p.bin[i] = std::min(low, axis_.bins - axis_.length);
        for (std::size_t n = low; n < high; ++n)
          p.energy[i * axis_.length + n - p.bin[i]] = a.power * std::norm(envelope.at(axis_.at(n) - a.delay));  // (E63)
      }
    });
    return p;
  }

  /// Returns the intensity response of a row to the elevations of the arrivals.
  std::vector<double> row_weights(const FanRow& row, const Pulses& pulses) const {
    RowResponse response(head_, wavelength_, row.elevation);
    std::vector<double> weights(pulses.bin.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double weight = response.at(arrivals_[pulses.first_arrival + i].v);
      weights[i] = weight * weight < floor_ ? 0 : weight * weight;
    }
    return weights;
  }

  /// Expands a group into terms: at Chebyshev nodes or arrival by arrival, whichever is cheaper per beam.
  ///
  /// weights   response of a row to all arrivals of `pulses`; empty: all 1
  GroupTerms terms_of(const Group& group, const Pulses& pulses, const std::vector<double>& weights) const {
    const std::size_t begin = group.first - pulses.first_arrival, end = group.last - pulses.first_arrival;
    const auto [low, high] = std::minmax_element(pulses.bin.begin() + begin, pulses.bin.begin() + end);
    const std::size_t length = axis_.length, bins = *high - *low + length;
    GroupTerms result{*low, bins, {}, {}};
    const double middle = 0.5 * (group.u_low + group.u_high), half = 0.5 * (group.u_high - group.u_low);
    const std::size_t nodes = chebyshev_nodes(half, lobe_, interpolation_error, max_nodes);
    const bool interpolates = nodes > 0 && nodes * (bins + 4) < (end - begin) * (length + 4);
    result.energy.assign(interpolates ? nodes * bins : (end - begin) * length, 0);
    double share[max_nodes] = {1};
    if (interpolates)
      for (std::size_t j = 0; j < nodes; ++j)
        result.terms.push_back({middle + half * std::cos(chebyshev_angle(j, nodes)), 0, bins, j * bins});
    for (std::size_t i = begin; i < end; ++i) {
      const double u = arrivals_[pulses.first_arrival + i].u, weight = weights.empty() ? 1 : weights[i];
      const std::size_t bin = pulses.bin[i] - *low;
      if (interpolates)
        lagrange(nodes, half > 0 ? (u - middle) / half : 0, share);
      else
        result.terms.push_back({u, bin, length, (i - begin) * length});
      for (std::size_t j = 0; j < (interpolates ? nodes : 1); ++j) {
        double* to = result.energy.data() + (interpolates ? j * bins + bin : (i - begin) * length);
        for (std::size_t k = 0; k < length; ++k) to[k] += share[j] * weight * pulses.energy[i * length + k];
      }
    }
    return result;
  }

  void accumulate(std::size_t beam, std::size_t first_group, const std::vector<GroupTerms>& terms) {
    const double up = head_.fan.elevation[beam], u = std::cos(up) * std::sin(head_.fan.azimuth[beam]), v = std::sin(up);
    std::vector<double> sum;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const Group& group = groups_[first_group + k];
      const double nearest = std::max({0.0, group.u_low - u, u - group.u_high});
      if (!responses_.responds_to(nearest, std::max(group.u_high - u, u - group.u_low), reach_)) continue;
      const GroupTerms& group_terms = terms[k];
      sum.assign(group_terms.bins, 0);
      for (const Term& term : group_terms.terms) {
        const double intensity = responses_.intensity(term.u, v, u, v);
        const double* energy = group_terms.energy.data() + term.energy;
        double* to = sum.data() + term.bin;
        for (std::size_t n = 0; n < term.length; ++n) to[n] += intensity * energy[n];
      }
      found_.add(beam * axis_.bins + group_terms.first_bin, group_terms.bins, sum.data(),
                 static_cast<std::uint32_t>(first_group + k));
    }
  }

  const SonarHead& head_;
  double wavelength_;
  ContributorOptions options_;
  DelayBins axis_;
  EchoShapes shapes_;
  BeamResponses responses_;
  double floor_, reach_, lobe_;
  std::vector<FanRow> rows_;
  std::vector<Arrival> arrivals_;
  std::vector<Group> groups_;
  StrongestGroups found_;
};

Contributors Search::contributors(const SceneCloud& scene) const {
  Contributors c;
  c.beams = head_.fan.beams(), c.bins = axis_.bins, c.per_pixel = found_.per_pixel;
  const std::size_t entries = found_.energy.size();
  c.surfel.assign(entries, Contributors::none), c.id.assign(entries, Contributors::none);
  c.share.assign(entries, 0), c.elevation.assign(entries, 0);
  c.material.assign(entries, Contributors::no_material);
  c.path.assign(entries, PathKind::direct);
  if (std::any_of(groups_.begin(), groups_.end(), [](const Group& g) { return g.before != Contributors::none; }))
    c.surfel_before.assign(entries, Contributors::none);
  c.total.assign(found_.total.begin(), found_.total.end());
  parallel_blocks(entries, 1 << 16, options_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (found_.group[i] == Contributors::none) continue;
      const Group& group = groups_[found_.group[i]];
      c.surfel[i] = group.surfel;
      c.id[i] = scene.id[group.surfel];
      c.share[i] = static_cast<float>(found_.energy[i] / found_.total[i / found_.per_pixel]);  // (E63)
      c.elevation[i] = group.elevation;
      c.material[i] = scene.material[group.surfel];
      c.path[i] = group.path();
      if (!c.surfel_before.empty()) c.surfel_before[i] = group.before;
    }
  });
  return c;
}

void require_options(const SonarHead& head, const ContributorOptions& o) {
  if (o.per_pixel < 1 || o.per_pixel > 255)
    fail(ErrorKind::argument, "find_contributors", ": per_pixel = ", o.per_pixel, ", must be within 1 and 255");
  require(o.floor_db < 0 && o.floor_db >= -200, "find_contributors", "floor_db", o.floor_db, "dB", "within -200 and 0");
  const double mib = contributor_mib(head.fan.beams() * head.gate.bins(), o.per_pixel);
  if (!(mib <= o.max_mib))
    fail(ErrorKind::argument, "find_contributors", ": ", head.fan.beams(), " beams x ", head.gate.bins(), " bins x ",
         o.per_pixel, " contributors take ", std::ceil(mib), " MiB, must be at most ", o.max_mib,
         "; keep fewer contributors, or make the range gate shorter");
}

}  // namespace

double contributor_mib(std::size_t pixels, int per_pixel) {
  return static_cast<double>(pixels) * (31 * per_pixel + 20) / (1 << 20);
}

Contributors find_contributors(const SceneCloud& scene, std::span<const SurfelEchoes> echoes, const SonarHead& head,
                               const Medium& medium, const ContributorOptions& options) {
  require_valid(head, "find_contributors");
  require_valid(medium, "find_contributors");
  require_options(head, options);
  double doppler = 0;
  for (const SurfelEchoes& block : echoes) {
    require_arrivals(scene, block, "find_contributors");
    for (const double shift : block.echoes.doppler) doppler = std::max(doppler, std::abs(shift));
  }
  const DelayBins axis(head, medium, options.floor_db, doppler);
  Search search(head, medium, sorted_arrivals(echoes, axis), axis, options);
  search.run();
  return search.contributors(scene);
}

}  // namespace insonify

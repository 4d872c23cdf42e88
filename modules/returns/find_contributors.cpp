#include "returns/find_contributors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "acoustics/pulse.hpp"
#include "beamforming/head_patterns.hpp"
#include "beamforming/response_table.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/chebyshev_internal.hpp"
#include "returns/surfel_arrivals_internal.hpp"

namespace insonify {
namespace {

constexpr const char* me = "find_contributors";
constexpr std::size_t samples_at_once = 1 << 19;  ///< of pulses, in memory
constexpr double interpolation_error = 1e-6;      ///< of B^2 between nodes, relative to B^2 about there
constexpr std::size_t most_nodes = 16;

/// Energies that the arrivals of some groups leave in each bin they reach, before beams: `length` samples each.
struct Pulses {
  std::size_t first_group, last_group, first_arrival;
  std::vector<std::size_t> bin;  ///< of an arrival's first sample
  std::vector<double> energy;
};

/// A direction in which a group is heard for all its arrivals nearby, or for one alone, and the energies in the bins from
/// `bin` (after the group's first) on that count for it.
struct Look {
  double u;
  std::size_t bin, length, energy;
};

/// A group as a sum of looks, E(b, n) = sum B^2(u - u_b) energy(n). B^2 is a sum of cosines no faster than 2 pi / lobe, so
/// that a few nodes stand for all arrivals of a small surfel.
struct GroupLooks {
  std::size_t first_bin, bins;
  std::vector<Look> looks;
  std::vector<double> energy;
};

/// The strongest groups of every pixel so far.
struct StrongestGroups {
  std::size_t per_pixel;
  std::vector<double> energy, total;
  std::vector<double> least;  ///< of those kept
  std::vector<std::uint32_t> group;

  StrongestGroups(std::size_t pixels, std::size_t kept)
      : per_pixel(kept), energy(pixels * kept, 0), total(pixels, 0), least(pixels, 0), group(pixels * kept, none) {}

  /// Energies of a group in `count` pixels from `first` on; what interpolation leaves below zero is none.
  void add(std::size_t first, std::size_t count, const double* e, std::uint32_t g) {
    double *all = total.data() + first, *enough = least.data() + first;
    for (std::size_t n = 0; n < count; ++n) all[n] += std::max(e[n], 0.0);
    for (std::size_t n = 0; n < count; ++n)
      if (e[n] > enough[n]) enough[n] = insert(first + n, e[n], g);
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
        table_(head.array, wavelength_),
        floor_(power_from_db(options.floor_db)),
        reach_(table_.reach(floor_)),
        lobe_(wavelength_ / (head.array.spacing * static_cast<double>(head.array.elements()))),
        rows_(fan_rows(head.fan)),
        arrivals_(std::move(arrivals)),
        groups_(groups_of(arrivals_)),
        found_(head.fan.beams() * axis.bins, static_cast<std::size_t>(options.per_pixel)) {}

  /// Hears groups in order, as many at once as memory allows; beams are independent of each other.
  void run() {
    const bool one_row = rows_.size() == 1 && !head_.column;
    for (std::size_t g = 0; g < groups_.size();) {
      const Pulses pulses = pulses_from(g);
      const std::size_t count = pulses.last_group - g;
      std::vector<GroupLooks> looks(one_row ? count : 0);
      if (one_row) {
        parallel_blocks(count, 64, options_.threads, [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) looks[k] = looks_at(groups_[g + k], pulses, {});
        });
        parallel_for(head_.fan.beams(), options_.threads, [&](std::size_t b) { hear(b, g, looks); });
      } else {
        parallel_for(rows_.size(), options_.threads, [&](std::size_t r) {
          const std::vector<double> weights = row_weights(rows_[r], pulses);
          std::vector<GroupLooks> of_row(count);
          for (std::size_t k = 0; k < count; ++k) of_row[k] = looks_at(groups_[g + k], pulses, weights);
          for (const std::size_t b : rows_[r].beams) hear(b, g, of_row);
        });
      }
      g = pulses.last_group;
    }
  }

  Contributors contributors(const SceneCloud& scene) const;

 private:
  Pulses pulses_from(std::size_t first_group) const {
    Pulses p{first_group, first_group, groups_[first_group].first, {}, {}};
    const std::size_t enough = std::max<std::size_t>(1, samples_at_once / axis_.length);
    do ++p.last_group;
    while (p.last_group < groups_.size() && groups_[p.last_group].last - p.first_arrival <= enough);
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

  /// What a row makes of the elevations of the arrivals.
  std::vector<double> row_weights(const FanRow& row, const Pulses& pulses) const {
    RowResponse response(head_, wavelength_, row.elevation);
    std::vector<double> weights(pulses.bin.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double weight = response.at(arrivals_[pulses.first_arrival + i].v);
      weights[i] = weight * weight < floor_ ? 0 : weight * weight;
    }
    return weights;
  }

  /// Of a group with many arrivals at a few nodes, else arrival by arrival: whatever costs a beam less.
  ///
  /// weights   of all arrivals of `pulses` in a row; empty: all 1
  GroupLooks looks_at(const Group& group, const Pulses& pulses, const std::vector<double>& weights) const {
    const std::size_t begin = group.first - pulses.first_arrival, end = group.last - pulses.first_arrival;
    const auto [low, high] = std::minmax_element(pulses.bin.begin() + begin, pulses.bin.begin() + end);
    const std::size_t length = axis_.length, bins = *high - *low + length;
    GroupLooks group_looks{*low, bins, {}, {}};
    const double middle = 0.5 * (group.u_low + group.u_high), half = 0.5 * (group.u_high - group.u_low);
    const std::size_t nodes = chebyshev_nodes(half, lobe_, interpolation_error, most_nodes);
    const bool interpolates = nodes > 0 && nodes * (bins + 4) < (end - begin) * (length + 4);
    group_looks.energy.assign(interpolates ? nodes * bins : (end - begin) * length, 0);
    double share[most_nodes] = {1};
    if (interpolates)
      for (std::size_t j = 0; j < nodes; ++j)
        group_looks.looks.push_back({middle + half * std::cos(chebyshev_angle(j, nodes)), 0, bins, j * bins});
    for (std::size_t i = begin; i < end; ++i) {
      const double u = arrivals_[pulses.first_arrival + i].u, weight = weights.empty() ? 1 : weights[i];
      const std::size_t bin = pulses.bin[i] - *low;
      if (interpolates)
        lagrange(nodes, half > 0 ? (u - middle) / half : 0, share);
      else
        group_looks.looks.push_back({u, bin, length, (i - begin) * length});
      for (std::size_t j = 0; j < (interpolates ? nodes : 1); ++j) {
        double* to = group_looks.energy.data() + (interpolates ? j * bins + bin : (i - begin) * length);
        for (std::size_t k = 0; k < length; ++k) to[k] += share[j] * weight * pulses.energy[i * length + k];
      }
    }
    return group_looks;
  }

  /// Adds groups from `first_group` on to the pixels of a beam.
  void hear(std::size_t beam, std::size_t first_group, const std::vector<GroupLooks>& looks) {
    const double u = std::cos(head_.fan.elevation[beam]) * std::sin(head_.fan.azimuth[beam]);
    std::vector<double> sum;
    for (std::size_t k = 0; k < looks.size(); ++k) {
      const Group& group = groups_[first_group + k];
      const double nearest = std::max({0.0, group.u_low - u, u - group.u_high});
      if (!table_.responds_to(nearest, std::max(group.u_high - u, u - group.u_low), reach_)) continue;
      const GroupLooks& heard = looks[k];
      sum.assign(heard.bins, 0);
      for (const Look& look : heard.looks) {
        const double intensity = table_.intensity(look.u - u);
        const double* energy = heard.energy.data() + look.energy;
        double* to = sum.data() + look.bin;
        for (std::size_t n = 0; n < look.length; ++n) to[n] += intensity * energy[n];
      }
      found_.add(beam * axis_.bins + heard.first_bin, heard.bins, sum.data(),
                 static_cast<std::uint32_t>(first_group + k));
    }
  }

  const SonarHead& head_;
  double wavelength_;
  ContributorOptions options_;
  DelayBins axis_;
  EchoShapes shapes_;
  ResponseTable table_;
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
  c.surfel.assign(entries, Contributors::none);
  c.id.assign(entries, Contributors::none);
  c.share.assign(entries, 0);
  c.elevation.assign(entries, 0);
  c.material.assign(entries, Contributors::no_material);
  c.path.assign(entries, PathKind::direct);
  parallel_blocks(entries, 1 << 16, options_.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (found_.group[i] == Contributors::none) continue;
      const Group& group = groups_[found_.group[i]];
      c.surfel[i] = group.surfel;
      c.id[i] = scene.id[group.surfel];
      c.share[i] = static_cast<float>(found_.energy[i] / found_.total[i / found_.per_pixel]);  // (E63)
      c.elevation[i] = group.elevation;
      c.material[i] = scene.material[group.surfel];
      c.path[i] = static_cast<PathKind>(group.legs.bounces());
    }
  });
  return c;
}

void require_options(const SonarHead& head, const ContributorOptions& o) {
  if (o.per_pixel < 1 || o.per_pixel > 255)
    fail(ErrorKind::argument, me, ": per_pixel = ", o.per_pixel, ", must be within 1 and 255");
  if (!(o.floor_db < 0 && o.floor_db >= -200))
    fail(ErrorKind::argument, me, ": floor_db = ", o.floor_db, " dB, must be within -200 and 0");
  const double pixels = static_cast<double>(head.fan.beams()) * static_cast<double>(head.gate.bins());
  const double mib = pixels * (31 * o.per_pixel + 16) / (1 << 20);
  if (!(mib <= o.most_mib))
    fail(ErrorKind::argument, me, ": ", head.fan.beams(), " beams x ", head.gate.bins(), " bins x ", o.per_pixel,
         " contributors take ", std::ceil(mib), " MiB, must be at most ", o.most_mib,
         "; keep fewer contributors, or make the range gate shorter");
}

}  // namespace

Contributors find_contributors(const SceneCloud& scene, std::span<const SurfelEchoes> heard, const SonarHead& head,
                               const Medium& medium, const ContributorOptions& options) {
  require_valid(head, me);
  require_valid(medium, me);
  require_options(head, options);
  double doppler = 0;
  for (const SurfelEchoes& part : heard) {
    require_arrivals(scene, part, me);
    for (const double shift : part.echoes.doppler) doppler = std::max(doppler, std::abs(shift));
  }
  const DelayBins axis(head, medium, options.floor_db, doppler);
  Search search(head, medium, sorted_arrivals(heard, axis), axis, options);
  search.run();
  return search.contributors(scene);
}

}  // namespace insonify

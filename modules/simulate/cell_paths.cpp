// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "beamforming/head_patterns.hpp"
#include "core/units.hpp"
#include "simulate/cell_paths_internal.hpp"
#include "simulate/cell_sum_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double least_of_both = 1e-3;  // part of the energy of two echoes below which they count as independent
constexpr std::uint64_t far_apart = 0x9e3779b97f4a7c15;
constexpr std::uint64_t of_double_echoes = 7;

/// Id of a path by its surface: the same for both senses.
std::uint64_t path_id(std::uint64_t surface, std::uint64_t kind, const LegPair& legs) {
  const std::uint64_t least = std::min(legs.out, legs.back), most = std::max(legs.out, legs.back);
  return surface ^ (kind << 16 | most << 8 | least) * far_apart;
}

/// Returns true if the legs come after others of the same patch: the way back changes first.
bool come_after(const LegPair& legs, const LegPair& before) {
  return std::pair(legs.out, legs.back) > std::pair(before.out, before.back);
}

void push(double delay, double u, double v, std::complex<double> amplitude, Echoes& to) {
  to.delay.push_back(delay), to.u.push_back(u), to.v.push_back(v), to.amplitude.push_back(amplitude);
}

/// Correlation of a line array's pattern over directions `apart` in their cosines, 1 at 0.
double pattern_likeness(const LineArray& array, double wavelength, double apart) {
  double like = 0, all = 0;
  for (std::size_t m = 0; m < array.shading.size(); ++m) {
    const double weight = array.shading[m] * array.shading[m];
    like += weight * std::cos(2 * pi * array.spacing / wavelength * apart * element_position(m, array.shading.size()));
    all += weight;
  }
  return like / all;
}

}  // namespace

/// The first entries of a surfel for each pair of legs, which have the energy of all its patches.
struct CellPaths::Merged {
  struct First {
    LegPair legs;
    bool both;
    std::size_t at;
  };
  std::vector<First> first{};

  /// Moves the energy of the entry at `at` to the first of its kind.
  void take(const LegPair& legs, bool both, std::size_t at, SurfaceEchoes& of) {
    const auto found =
        std::find_if(first.begin(), first.end(), [&](const First& f) { return f.legs == legs && f.both == both; });
    if (found == first.end()) return first.push_back({legs, both, at});
    of.power[found->at] += of.power[at];
    of.power[at] = 0, of.depth[at] = of.width[at] = 0;
  }
};

CellPaths::CellPaths(const SceneCloud& scene, const ResolvedPing& ping)
    : scene_(scene),
      ping_(ping),
      wavelength_(ping.sent.medium.sound_speed / ping.head.pulse.centre_frequency),
      rows_(ping.head.column || fan_rows(ping.head.fan).size() > 1) {}

void CellPaths::add(const Entry& entry, SurfaceEchoes& to) {
  const auto& [of, i, id, depth, width] = entry;
  push(of.delay[i], of.u[i], of.v[i], of.amplitude[i], to.echoes);
  to.id.push_back(id), to.power.push_back(std::norm(of.amplitude[i]));
  to.depth.push_back(static_cast<float>(depth)), to.width.push_back(static_cast<float>(width));
}

double CellPaths::likeness(const Echoes& echoes, std::size_t i, std::size_t j) const {
  const double across = pattern_likeness(ping_.head.array, wavelength_, echoes.u[i] - echoes.u[j]);
  if (!rows_) return across;
  const double middle = 0.5 * (echoes.v[i] + echoes.v[j]);
  RowResponse row(ping_.head, wavelength_, std::asin(std::clamp(middle, -1.0, 1.0)));
  const double most = row.at(middle);
  return most != 0 ? across * row.at(echoes.v[i]) * row.at(echoes.v[j]) / (most * most) : 0;
}

void CellPaths::add_both(const Entry& one, const Entry& other, SurfaceEchoes& to) const {
  const Echoes& of = one.of;
  const std::size_t i = one.index, j = other.index;
  add(one, to), add(other, to);
  const double more = 2 * (of.amplitude[i] * std::conj(of.amplitude[j])).real() * likeness(of, i, j);  // (E190)
  double &power = to.power[to.power.size() - 2], &power_back = to.power.back();
  if (std::abs(more) < least_of_both * (power + power_back)) return;
  if (more < 0) {
    power = std::max(0.0, power + 0.5 * more), power_back = std::max(0.0, power_back + 0.5 * more);
    return;
  }
  push(of.delay[i], 0.5 * (of.u[i] + of.u[j]), 0.5 * (of.v[i] + of.v[j]), std::sqrt(more), to.echoes);
  to.id.push_back(SurfaceEchoes::of_both), to.power.push_back(more);
  to.depth.push_back(static_cast<float>(one.depth)), to.width.push_back(static_cast<float>(one.width));
}

void CellPaths::add_surfel(const Multipath& bounced, std::size_t begin, std::size_t end, std::uint64_t kind,
                           const std::vector<Vector3d>& heads, SurfaceEchoes& to) const {
  const std::uint32_t surfel = bounced.surfel[begin];
  const Vector3d position = scene_.origin + scene_.point[surfel].cast<double>(),
                 normal = scene_.normal[surfel].cast<double>();
  const double reach = spread_of_disc * std::sqrt(static_cast<double>(scene_.area[surfel]) / pi);
  const auto towards = [&](std::size_t leg) { return Vector3d((heads[leg] - position).normalized()); };
  const auto entry = [&](std::size_t i, std::uint64_t piece) -> Entry {
    const LegPair legs = bounced.legs[i];
    const Vector3d middle = 0.5 * (towards(legs.out) + towards(legs.back));
    return {bounced.echoes, i, path_id(scene_.piece_id(surfel, piece), kind, legs),
            reach * (middle - normal.dot(middle) * normal).norm(), reach / (heads[legs.back] - position).norm()};
  };
  Merged merged;
  std::uint64_t piece = 0;
  for (std::size_t first = begin, last = begin; first < end; first = last, ++piece) {
    for (last = first + 1; last < end && come_after(bounced.legs[last], bounced.legs[last - 1]);) ++last;
    const auto sense = [&](const LegPair& legs) {
      const auto at = bounced.legs.begin();
      return static_cast<std::size_t>(
          std::find(at + static_cast<std::ptrdiff_t>(first), at + static_cast<std::ptrdiff_t>(last), legs) - at);
    };
    for (std::size_t i = first; i < last; ++i) {
      const LegPair legs = bounced.legs[i], reverse{legs.back, legs.out};
      const std::size_t j = legs.out == legs.back ? last : sense(reverse);
      if (j < i) continue;  // it stands with the other sense
      const std::size_t at = to.id.size();
      j < last ? add_both(entry(i, piece), entry(j, piece), to) : add(entry(i, piece), to);
      merged.take(legs, false, at, to);
      if (j < last) merged.take(reverse, false, at + 1, to);
      if (to.id.size() > at + 2) merged.take(legs, true, at + 2, to);
    }
  }
}

SurfaceEchoes CellPaths::of(const Multipath& bounced, std::uint64_t kind) const {
  std::vector<Vector3d> heads{ping_.view.world_from_head.translation()};
  for (const MirrorPlane& plane : bounced.planes)
    heads.push_back(heads[0] - 2 * plane.signedDistance(heads[0]) * plane.normal());
  SurfaceEchoes made;
  for (std::size_t begin = 0, end = 0; begin < bounced.surfel.size(); begin = end) {
    while (end < bounced.surfel.size() && bounced.surfel[end] == bounced.surfel[begin]) ++end;
    add_surfel(bounced, begin, end, kind, heads, made);
  }
  return made;
}

SurfaceEchoes CellPaths::of(const DoubleEchoes& doubles) const {
  SurfaceEchoes made;
  const std::size_t count = doubles.echoes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto entry = [&](std::size_t k) -> Entry {
      return {doubles.echoes, k, path_id(doubles.id[k], of_double_echoes, {}), 0, 0};
    };
    if (i + 1 < count && doubles.id[i + 1] == doubles.id[i])
      add_both(entry(i), entry(i + 1), made), ++i;
    else
      add(entry(i), made);
  }
  return made;
}

}  // namespace insonify

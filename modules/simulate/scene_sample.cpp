// SPDX-License-Identifier: BSD-3-Clause
// The sample that a plan is made from. Surfels are sorted by where they stand; of each kind some thousands are pinged
// by the stages of simulate_ping themselves: visibility, direct echoes (E7), the beams' patterns (E10, E14).
#include <algorithm>
#include <array>
#include <cmath>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/engine.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "simulate/received_energy.hpp"
#include "simulate/scene_sample_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_of_a_kind = 4096, words_at_once = 256;  // of 64 surfels
constexpr double nearest = 1e-2;                                   // [m]: what is nearer is left to simulate_ping

enum Kind : std::uint8_t { in_view, other_range, off_azimuth, off_elevation, elsewhere, kinds };

/// Sorts places by what the plan asks about them.
class Sorter {
 public:
  explicit Sorter(const ResolvedPing& ping)
      : sector_(insonified_sector(ping.head.fan, sampling_in_view(ping))),
        all_(widest_sector(ping)),
        gate_(ping.view.gate),
        farthest_(2 * gate_.max_range - ping.head.gate.max_range) {}

  Kind kind_of(const Eigen::Vector3d& p) const {
    const double r = p.norm();
    if (r < nearest) return elsewhere;
    const bool in_elevations = sector_.in_elevations(p);
    if (in_elevations && sector_.in_cones(p))
      return r >= gate_.min_range && r <= gate_.max_range ? in_view : r <= farthest_ ? other_range : elsewhere;
    if (r < gate_.min_range || r > gate_.max_range || !all_.holds(p)) return elsewhere;
    return in_elevations ? off_azimuth : off_elevation;
  }
  /// Returns false if all places within `radius` [m] of a place are elsewhere.
  bool may_hold(const Eigen::Vector3d& p, double radius) const { return all_.holds(p, radius); }
  RangeGate reach() const { return {nearest, farthest_, gate_.bin_size}; }
  static SamplingOptions widest(const ResolvedPing& ping) {
    SamplingOptions s = ping.view.sampling;
    s.kind = SamplingKind::surfels;
    s.scatterers_per_cell = 0;
    s.azimuth_margin = pi;
    s.elevation_half_extent = sampled_half_extent(ping.head, -400);
    return s;
  }

 private:
  static Sector widest_sector(const ResolvedPing& ping) { return insonified_sector(ping.head.fan, widest(ping)); }

  SectorBounds sector_, all_;  // the second holds the first
  const RangeGate& gate_;      // the sampled one
  double farthest_;
};

struct Sampled {
  SceneCloud scene;
  std::vector<Kind> kind;
  std::vector<double> stands_for;  ///< so many surfels
};

Sampled sampled_surfels(const PreparedScene& prepared, const ResolvedPing& ping, const Sorter& sorter) {
  const SceneCloud& scene = prepared.scene();
  const Eigen::Matrix3d to_head = ping.view.world_from_head.linear().transpose();
  const Eigen::Vector3d shift = scene.origin - ping.view.world_from_head.translation();
  const double levels = has_boundary(ping.environment) ? longest_leg(ping.environment, {}, ping.view, ping.sent) : 0;
  const double legs = std::max(levels, reach_of_legs(ping));
  const double farthest = std::max(sorter.reach().max_range, legs);
  const auto reaches = [&](const SurfelBlock& block) {
    const Eigen::Vector3d p = shift + block.centre.cast<double>();
    return p.norm() <= farthest + block.radius && (legs > 0 || sorter.may_hold(to_head * p, block.radius));
  };
  const SurfelMarks marks = prepared.marks_of(reaches, ping.options.threads);
  // Block by block, joined in the order of the scene.
  using Members = std::array<std::vector<std::uint32_t>, kinds>;
  std::vector<Members> blocks((marks.words.size() + words_at_once - 1) / words_at_once);
  parallel_blocks(marks.words.size(), words_at_once, ping.options.threads, [&](std::size_t begin, std::size_t end) {
    Members& of_block = blocks[begin / words_at_once];
    marks.for_each(begin, end, [&](std::size_t i) {
      const Eigen::Vector3d p = shift + scene.point[i].cast<double>();
      if (p.squaredNorm() > farthest * farthest) return;
      const Kind kind = sorter.kind_of(to_head * p);
      if (kind != elsewhere || legs > 0) of_block[kind].push_back(static_cast<std::uint32_t>(i));
    });
  });
  Members members;
  for (const Members& of_block : blocks)
    for (std::size_t k = 0; k < kinds; ++k) members[k].insert(members[k].end(), of_block[k].begin(), of_block[k].end());

  Sampled sampled;
  std::vector<std::uint32_t> keep;
  for (std::size_t k = 0; k < kinds; ++k) {
    const std::size_t n = members[k].size(), step = std::max<std::size_t>(1, (n + most_of_a_kind - 1) / most_of_a_kind);
    const auto count = static_cast<double>((n + step - 1 - step / 2) / step);
    for (std::size_t i = step / 2; i < n; i += step) {
      keep.push_back(members[k][i]);
      sampled.kind.push_back(static_cast<Kind>(k));
      sampled.stands_for.push_back(static_cast<double>(n) / count);
    }
  }
  sampled.scene = subset(scene, keep);
  sampled.scene.part_of.reset();
  for (std::size_t i = 0; i < keep.size(); ++i) sampled.scene.area[i] *= static_cast<float>(sampled.stands_for[i]);
  return sampled;
}

/// Returns the part of its energy that a pulse from range r [m] beyond the gate still has inside it: a Gaussian, cut
/// where the sampled ranges end.
double left_in_gate(const ResolvedPing& ping, double r) {
  const RangeGate &gate = ping.head.gate, &sampled = ping.view.gate;
  const double reach = sampled.max_range - gate.max_range;
  const double gap = r > gate.max_range ? r - gate.max_range : gate.min_range - r;
  if (gap <= 0) return 1;
  return std::pow(0.5 * ping.options.synthesis.tolerance, 2 * std::pow(gap / reach, 2));
}

/// Returns true if beams are formed of all frequencies of the pulse, or may be as far as the options say.
bool may_have_true_delays(const ResolvedPing& ping) {
  const auto& [method, tolerance, true_delays, phases] = ping.options.synthesis;
  if (engine_of(method).replaceable) return true_delays != Choice::never && !ping.head.column;
  return receives_whole_band(method);
}

/// The energy that beams receive of a surfel, spread over its disc if it may be split: parts of it reach beyond the
/// middle's u.
class ReceivedOfDisc {
 public:
  explicit ReceivedOfDisc(const ResolvedPing& ping)
      : received_(ping.head, ping.sent.medium.sound_speed / ping.head.pulse.centre_frequency, 0,
                  may_have_true_delays(ping)),
        to_head_(ping.view.world_from_head.linear().transpose()),
        split_(ping.view.sampling.scatterers_per_cell > 0 && ping.view.sampling.kind == SamplingKind::surfels) {}

  /// area [m^2]; normal in the world; u and v of the middle.
  double at(double u, double v, double range, double area, const Eigen::Vector3f& normal) {
    const double middle = received_.at(u, v), across = std::sqrt(std::max(0.0, 1 - u * u));
    if (!split_ || across < 1e-6) return middle;
    // Along the direction in which u grows, the disc is as wide as its tilt leaves it.
    const double ahead = std::sqrt(std::max(0.0, 1 - u * u - v * v));
    const Eigen::Vector3d along = (Eigen::Vector3d::UnitY() - u * Eigen::Vector3d(ahead, u, v)) / across;
    const double tilt = (to_head_ * normal.cast<double>()).dot(along);
    const double reach = std::sqrt(area / pi) / range * across * std::sqrt(std::max(0.0, 1 - tilt * tilt));
    constexpr double positions[] = {0.4, 0.8}, chords[] = {0.917, 0.6};
    double sum = middle, parts = 1;
    for (const int k : {0, 1}) {
      for (const double side : {-reach, reach}) sum += chords[k] * received_.at(u + side * positions[k], v);
      parts += 2 * chords[k];
    }
    return sum / parts;
  }

 private:
  ReceivedEnergy received_;
  Eigen::Matrix3d to_head_;
  bool split_;
};

}  // namespace

SceneSample sample_scene(const PreparedScene& prepared, const ResolvedPing& ping) {
  const Sorter sorter(ping);
  Sampled sampled = sampled_surfels(prepared, ping, sorter);
  const View& view = ping.view;
  Scatterers patches =
      find_scatterers(sampled.scene, view.world_from_head, view.fan, sorter.reach(), Sorter::widest(ping)).scatterers;
  Transmission mean_power = ping.sent;
  mean_power.echo_options.amplitude = SurfaceAmplitude::mean_power;
  const Medium& medium = ping.sent.medium;
  const Echoes echoes = direct_echoes(patches, sampled.scene.materials, mean_power);

  // Energies and numbers, by where the echoes come from.
  SceneSample s;
  ReceivedOfDisc received(ping);
  const bool with_off_azimuth = ping.options.sampling.outer_azimuths != Choice::never;
  if (with_off_azimuth) s.power_off_azimuth.assign(patches.size(), 0);
  double* const energies[] = {&s.in_view, &s.other_ranges, &s.off_azimuth, &s.off_elevation};
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const std::uint32_t surfel = patches.surfel[i];
    const Kind kind = sampled.kind[surfel];
    s.energy.push_back(0);
    s.power.push_back(0);
    if (kind == elsewhere) continue;
    const double r = patches.range[i], times = sampled.stands_for[surfel];
    const double power =
        std::norm(echoes.amplitude[i]) * std::exp(-4 * medium.absorption.a0 * r) * left_in_gate(ping, r);
    const double energy = power * received.at(echoes.u[i], std::sin(patches.elevation[i]), r,
                                              sampled.scene.area[surfel] / times, sampled.scene.normal[surfel]);
    *energies[kind] += energy;
    if (kind == off_azimuth && with_off_azimuth) s.power_off_azimuth[i] = power;
    if (kind != in_view) continue;
    s.energy.back() = energy;
    s.power.back() = power;
  }
  s.scene = std::move(sampled.scene);
  s.positions = std::move(patches);
  return s;
}

SceneSample sample_of(const Scatterers& positions, const Echoes& echoes, const ResolvedPing& ping) {
  const Medium& medium = ping.sent.medium;
  const RangeGate& gate = ping.head.gate;
  ReceivedEnergy received(ping.head, medium.sound_speed / ping.head.pulse.centre_frequency);
  SceneSample s;
  s.positions = positions;
  s.doppler = echoes.doppler;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double r = positions.range[i];
    const bool in_gate = r >= gate.min_range && r <= gate.max_range;
    s.power.push_back(in_gate ? std::norm(echoes.amplitude[i]) * std::exp(-4 * medium.absorption.a0 * r) : 0);
    s.energy.push_back(s.power[i] * received.at(echoes.u[i], std::sin(positions.elevation[i])));
    s.in_view += s.energy[i];
  }
  return s;
}

}  // namespace insonify

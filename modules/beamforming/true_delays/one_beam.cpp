// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "beamforming/true_delays/one_beam_internal.hpp"
#include "core/parallel.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

constexpr double most_work = 1e9;   // samples of pulses in all tables: some seconds
constexpr double most_bytes = 3e8;  // of all tables
constexpr double longest = 256;     // bins of a stretch

/// Range from which on tables keep the tolerance: nearer, focusing spreads the frequencies of the outermost elements
/// [m].
double nearest_range(const SonarHead& head, const Medium& medium, double tolerance) {
  const double aperture = length_of(head.array);
  const double moved = aperture * std::sqrt(head.pulse.centre_frequency / (8 * head.pulse.bandwidth));
  const PulseReach reach(head.pulse, medium.absorption, medium.sound_speed, false, pulse_cut(tolerance));
  return std::max(1.5 * aperture, moved / std::sqrt(0.3)) + medium.sound_speed * reach.half;
}

double nearest_bin(const SonarHead& head, const Medium& medium, double tolerance) {
  const double bin = (nearest_range(head, medium, tolerance) - head.gate.min_range) / head.gate.bin_size;
  return std::max(0.0, std::ceil(bin));
}

/// Length over which weights must fade so that elements between them receive nothing from beyond |u| [m].
double fade_for(double u, const SonarHead& head, const Medium& medium) {
  constexpr double wavelengths = 6.5;  // held by tests
  return wavelengths * medium.sound_speed / (head.pulse.centre_frequency * u);
}

/// |u| from which on the ends of the array count alone; 1: they never do.
double split_for(const SonarHead& head, const Medium& medium, double widest) {
  constexpr double least = 0.1, farthest = 0.5;
  const double aperture = length_of(head.array);
  const double split = std::max(least, 2.2 * fade_for(1, head, medium) / std::max(aperture, 1e-9));
  return split < std::min(farthest, widest) && std::abs(head.fan.azimuth.front()) < 1e-12 ? split : 1;
}

}  // namespace

BeamTables::BeamTables(BeamTableSizes sizes, double nearest) : sizes_(std::move(sizes)) {
  const auto bins = static_cast<double>(sizes_.axis.bins);
  edge_ = {nearest};
  // A response from beyond the gate may reach back into it.
  while (edge_.back() < bins + guard_ || edge_.size() == 1) {
    const BeamTableSizes::Span span = sizes_.span_from(edge_.back());
    const double range = sizes_.range_of(span.first);
    const double late =
        std::max(std::abs(sizes_.lateness(range, sizes_.widest)), std::abs(sizes_.lateness(range, -sizes_.widest)));
    guard_ = std::max(guard_, BeamTable::guard(sizes_, span) + std::ceil(late / sizes_.axis.step));
    edge_.push_back(span.last);
    span_.push_back(span);
    work_ += BeamTable::work(sizes_, span);
    bytes_ += BeamTable::bytes(sizes_, span);
    table_.emplace_back(), shifted_.emplace_back();
  }
}

const BeamTable& BeamTables::at(double bin, bool shifted) const {
  const auto after = std::upper_bound(edge_.begin(), edge_.end() - 1, bin);
  const auto number = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - edge_.begin()) - 1);
  return (shifted ? shifted_ : table_)[number].get(
      [&] { return std::make_unique<BeamTable>(sizes_, span_[number], shifted ? BeamTableSizes::shifted : 0); });
}

OneBeam::OneBeam(const SonarHead& head, const Medium& medium, double tolerance, double widest, double split)
    : split_(split),
      whole_(BeamTableSizes(head, medium, tolerance, std::min(split, widest), ArraySection::whole(head.array)),
             nearest_bin(head, medium, tolerance)),
      guard_(whole_.guard()),
      stretches_{TimeAxis(head.gate, medium.sound_speed), {}} {
  if (split < widest) {
    end_ = std::make_unique<BeamTables>(
        BeamTableSizes(head, medium, tolerance, widest, ArraySection::end(head.array, fade_for(split, head, medium))),
        whole_.edges().front());
    guard_ = std::max(guard_, end_->guard());
  }
  // Stretches end where tables do.
  std::vector<double> ends = whole_.edges();
  if (end_) ends.insert(ends.end(), end_->edges().begin(), end_->edges().end());
  std::sort(ends.begin(), ends.end());
  std::vector<double>& edge = stretches_.edge;
  edge = {std::min(-guard_, ends.front()), ends.front()};
  for (const double end : ends)
    while (edge.back() < end) edge.push_back(std::min(edge.back() + longest, end));
}

std::unique_ptr<const OneBeam> OneBeam::make(const SonarHead& head, const Medium& medium, double tolerance,
                                             double widest) {
  if (head.fan.beams() != 1 || !is_gaussian(head.pulse)) return nullptr;
  std::unique_ptr<const OneBeam> one(new OneBeam(head, medium, tolerance, widest, split_for(head, medium, widest)));
  const double work = one->whole_.work() + (one->end_ ? one->end_->work() : 0),
               bytes = one->whole_.bytes() + (one->end_ ? one->end_->bytes() : 0);
  return work <= most_work && bytes <= most_bytes ? std::move(one) : nullptr;
}

void OneBeam::add_image(const EchoFeed& feed, int threads, ComplexGrid& pressure) const {
  // Stretches share bins: each has an image of its own, and they are added in order.
  const std::vector<double>& edge = stretches_.edge;
  std::vector<std::vector<std::complex<double>>> images(stretches_.size() - 1);
  const auto begin_of = [&](std::size_t k) { return static_cast<std::ptrdiff_t>(edge[k + 1] - guard_); };
  parallel_for(images.size(), threads, [&](std::size_t k) {
    const auto bins = static_cast<std::ptrdiff_t>(edge[k + 2] + guard_) - begin_of(k);
    // Tables by whether echoes move, asked for once.
    std::array<const BeamTable*, 2> whole{}, end{};
    const auto table = [&](const BeamTables& tables, std::array<const BeamTable*, 2>& known, bool shifted) {
      if (!known[shifted]) known[shifted] = &tables.at(edge[k + 1], shifted);
      return known[shifted];
    };
    feed.visit(k + 1, [&](const Echoes& echoes, std::span<const std::uint32_t> list) {
      images[k].resize(static_cast<std::size_t>(bins));
      for (const std::uint32_t i : list) {
        const double u = echoes.u[i], doppler = echoes.doppler_of(i);
        const bool moves = doppler != 0, in_lobes = std::abs(u) <= split_;
        const BeamTables& tables = in_lobes ? whole_ : *end_;
        auto& known = in_lobes ? whole : end;
        const BeamTable *rest = table(tables, known, false), *shifted = moves ? table(tables, known, true) : nullptr;
        rest->add(echoes.delay[i], u, echoes.amplitude[i], doppler, shifted, begin_of(k), bins, images[k].data());
        // The other end receives from u what this one does from -u.
        if (!in_lobes)
          rest->add(echoes.delay[i], -u, echoes.amplitude[i], doppler, shifted, begin_of(k), bins, images[k].data());
      }
    });
  });
  const auto bins = static_cast<std::ptrdiff_t>(pressure.cols());
  for (std::size_t k = 0; k < images.size(); ++k)
    for (std::ptrdiff_t n = 0; n < static_cast<std::ptrdiff_t>(images[k].size()); ++n)
      if (const std::ptrdiff_t bin = begin_of(k) + n; bin >= 0 && bin < bins)
        pressure(0, bin) += images[k][static_cast<std::size_t>(n)];
}

}  // namespace insonify

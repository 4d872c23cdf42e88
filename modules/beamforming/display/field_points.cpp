// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/display/field_points_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr std::uint64_t other_ring = 0xd6e8feb86659fd93;                              // difference of its id, odd
constexpr double inner_ring = 0.70710678118654752, outer_ring = 1.22474487139158905;  // radii, in that of a single ring

using Complex = std::complex<double>;

std::complex<float> product(const std::complex<float>& a, const std::complex<float>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

/// Discs of some echoes (kernels::Discs), and the numbers of these among those in cells.
struct FieldPointMaker::DiscList {
  std::vector<std::uint64_t> id;
  std::vector<std::uint32_t> number;
  std::vector<float> part;  // energy of a point, in that of its echo
  std::vector<double> place, u, re, im, root;
  std::array<std::vector<double>, 2> cycles, to_edge;
};

FieldPointMaker::FieldPointMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const CellOptions& options)
    : plan_(plan),
      surface_(surface),
      options_(options),
      per_cell_length_(1 / plan.cell_length),
      edge_(static_cast<float>(plan.fields.edge)) {}

void FieldPointMaker::add(std::size_t begin, std::size_t end, const std::vector<std::uint32_t>& slot,
                          UninitializedVector<CellEcho>& echoes, PlacedPoints& points) const {
  if (!options_.speckle) return;
  DiscList discs;
  std::vector<std::size_t> single;
  for (std::size_t i = begin; i < end; ++i) {
    if (slot[i] >= echoes.size() || surface_.echoes.amplitude[i] == Complex(0)) continue;
    if (i < surface_.disc.size() && !surface_.disc[i].is_point())
      list_disc(i, slot[i], discs);
    else
      single.push_back(i);
  }
  points.reserve(5 * discs.id.size() + 2 * single.size());
  add_discs(discs, echoes, points);
  add_single(single, slot, echoes, points);
}

double FieldPointMaker::place_of(std::size_t i) const {
  return (plan_.pulse.metres_per_s() * surface_.echoes.delay[i] - plan_.first_range) * per_cell_length_;
}

double FieldPointMaker::energy_of(std::size_t i) const {
  return plan_.pulse.energy(plan_.pulse.metres_per_s() * surface_.echoes.delay[i]) * per_cell_length_ *
         std::norm(surface_.echoes.amplitude[i]);
}

void FieldPointMaker::list_disc(std::size_t i, std::uint32_t number, DiscList& discs) const {
  const Complex amplitude = surface_.echoes.amplitude[i];
  const EchoDisc& disc = surface_.disc[i];
  const double per_size = 1 / std::sqrt(std::norm(amplitude)), place = place_of(i), energy = energy_of(i);
  const auto add_ring = [&](std::uint64_t id, double radius, double part) {
    discs.id.push_back(id), discs.number.push_back(number);
    discs.place.push_back(place), discs.u.push_back(surface_.echoes.u[i]);
    discs.re.push_back(amplitude.real() * per_size), discs.im.push_back(amplitude.imag() * per_size);
    discs.root.push_back(std::sqrt(part * energy)), discs.part.push_back(static_cast<float>(part));
    for (const std::size_t axis : {0, 1}) {
      discs.cycles[axis].push_back(radius * plan_.cycles_per_metre * static_cast<double>(disc.range[axis]));
      discs.to_edge[axis].push_back(radius * static_cast<double>(disc.u[axis]));
    }
  };
  constexpr double of_point = 1.0 / static_cast<double>(kernels::points_of_disc);
  if (!disc.two_rings) return add_ring(surface_.id[i], 1, of_point);
  // Rings divide the disc into two of equal area.
  add_ring(surface_.id[i], inner_ring, 0.5 * of_point);
  add_ring(surface_.id[i] + other_ring, outer_ring, 0.5 * of_point);
}

void FieldPointMaker::add_single(const std::vector<std::size_t>& single, const std::vector<std::uint32_t>& slot,
                                 UninitializedVector<CellEcho>& echoes, PlacedPoints& points) const {
  std::vector<std::uint64_t> id;
  for (const std::size_t i : single) id.push_back(surface_.id[i]);
  std::vector<double> re(id.size()), im(id.size());
  random_amplitudes(options_.seed, id, re.data(), im.data());  // (E9)
  for (std::size_t k = 0; k < id.size(); ++k) {
    const std::size_t i = single[k];
    const Complex amplitude = surface_.echoes.amplitude[i];
    const auto energy = static_cast<float>(energy_of(i));
    std::complex<float>& pressure = echoes[slot[i]].pressure;
    // An entry for what both senses of a path add has no pressure of its own (E190).
    if (id[k] != SurfaceEchoes::of_both)
      pressure = std::complex<float>(amplitude / std::sqrt(std::norm(amplitude)) * Complex(re[k], im[k]));
    add_point(static_cast<float>(place_of(i)), plan_.node_of(surface_.echoes.u[i]), std::sqrt(energy) * pressure,
              energy, slot[i], points);
  }
}

void FieldPointMaker::add_discs(const DiscList& discs, UninitializedVector<CellEcho>& echoes,
                                PlacedPoints& points) const {
  const std::size_t count = discs.id.size();
  std::array<std::vector<float>, kernels::points_of_disc> re, im, place;
  std::array<std::vector<std::int32_t>, kernels::points_of_disc> node;
  kernels::DiscPoints to;
  for (std::size_t k = 0; k < kernels::points_of_disc; ++k) {
    re[k].resize(count), im[k].resize(count), place[k].resize(count), node[k].resize(count);
    to.re[k] = re[k].data(), to.im[k] = im[k].data(), to.place[k] = place[k].data(), to.node[k] = node[k].data();
  }
  kernels::draw_discs(options_.seed, discs.id.data(),
                      {discs.place.data(),
                       discs.u.data(),
                       discs.re.data(),
                       discs.im.data(),
                       discs.root.data(),
                       {discs.cycles[0].data(), discs.cycles[1].data()},
                       {discs.to_edge[0].data(), discs.to_edge[1].data()},
                       per_cell_length_ / plan_.cycles_per_metre,
                       plan_.nodes_per_u,
                       static_cast<double>(plan_.nodes - 1)},
                      count, to);
  for (std::size_t k = 0; k < count; ++k) {
    const auto root = static_cast<float>(discs.root[k]), power = root * root;
    if (!(root > 0)) continue;
    std::complex<float> sum = 0;
    for (std::size_t point = 0; point < kernels::points_of_disc; ++point) {
      const std::complex<float> pressure(re[point][k], im[point][k]);
      add_point(place[point][k], static_cast<std::size_t>(node[point][k]), pressure, power, discs.number[k], points);
      sum += pressure;
    }
    echoes[discs.number[k]].pressure += (std::sqrt(discs.part[k]) / root) * sum;
  }
}

void FieldPointMaker::add_point(float place, std::size_t node, const std::complex<float>& pressure, float power,
                                std::uint32_t number, PlacedPoints& points) const {
  if (!(place > -edge_ && place < static_cast<float>(plan_.cells) + edge_)) return;
  const std::int32_t last = static_cast<std::int32_t>(plan_.cells) - 1,
                     cell = std::min(static_cast<std::int32_t>(place), last);  // 0 if the place is before it
  std::size_t in_period = node;
  while (in_period >= plan_.period) in_period -= plan_.period;
  PlacedPoint placed{{plan_.half_positions ? product(plan_.turn[node], pressure) : pressure, power,
                      static_cast<std::uint32_t>(in_period), 0, number},
                     static_cast<std::uint32_t>(cell)};
  const float within = place - static_cast<float>(cell);
  const auto put = [&](float at, std::int32_t in) {
    placed.point.share = plan_.fields.index_at(at), placed.cell = static_cast<std::uint32_t>(in);
    points.push_back(placed);
  };
  if (within < edge_ && cell > 0) put(within + 1, cell - 1);
  put(within, cell);
  if (within > 1 - edge_ && cell < last) put(within - 1, cell + 1);
}

PointsByCell points_by_cell(const std::vector<PlacedPoints>& blocks, std::size_t cells, int threads) {
  // Where each block's points of each cell begin.
  std::vector<std::vector<std::uint32_t>> at(blocks.size());
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    at[b].assign(cells, 0);
    for (const PlacedPoint& placed : blocks[b]) ++at[b][placed.cell];
  });
  PointsByCell all;
  std::uint32_t next = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    all.first.push_back(next);
    for (auto& of_block : at) next += std::exchange(of_block[cell], next);
  }
  all.first.push_back(next);
  all.point.resize(next);
  parallel_for(blocks.size(), threads, [&](std::size_t b) {
    for (const PlacedPoint& placed : blocks[b]) all.point[at[b][placed.cell]++] = placed.point;
  });
  return all;
}

}  // namespace insonify

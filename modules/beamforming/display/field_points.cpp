// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/display/field_points_internal.hpp"
#include "core/parallel.hpp"
#include "core/positions_by_group.hpp"

namespace insonify {
namespace {

constexpr std::uint64_t other_ring = 0xd6e8feb86659fd93;                              // difference of its id, odd
constexpr double inner_ring = 0.70710678118654752, outer_ring = 1.22474487139158905;  // radii, in that of a single ring

using Complex = std::complex<double>;

std::complex<float> product(const std::complex<float>& a, const std::complex<float>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Returns a list of so many echoes of which each has so many points; none of its numbers is set.
PointList list_of(std::size_t echoes, std::size_t points) {
  PointList list;
  list.echo.resize(echoes), list.power.resize(echoes), list.points.resize(points);
  for (PointList::Points& of : list.points)
    of.re.resize(echoes), of.im.resize(echoes), of.place.resize(echoes), of.node.resize(echoes);
  return list;
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

DrawnPoints FieldPointMaker::draw(std::size_t begin, std::size_t end, const UninitializedVector<std::uint32_t>& slot,
                                  UninitializedVector<CellEcho>& echoes) const {
  DrawnPoints drawn;
  drawn.in_cell.assign(plan_.cells, 0);
  if (!options_.speckle) return drawn;
  DiscList discs;
  std::vector<std::size_t> single;
  for (std::size_t i = begin; i < end; ++i) {
    if (slot[i] >= echoes.size() || surface_.echoes.amplitude[i] == Complex(0)) continue;
    if (i < surface_.disc.size() && !surface_.disc[i].is_point())
      list_disc(i, slot[i], discs);
    else
      single.push_back(i);
  }
  drawn.discs = draw_discs(discs, echoes), drawn.single = draw_single(single, slot, echoes);
  count(drawn.discs, drawn.in_cell), count(drawn.single, drawn.in_cell);
  return drawn;
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

PointList FieldPointMaker::draw_single(const std::vector<std::size_t>& single,
                                       const UninitializedVector<std::uint32_t>& slot,
                                       UninitializedVector<CellEcho>& echoes) const {
  const std::size_t size = single.size();
  std::vector<std::uint64_t> id;
  for (const std::size_t i : single) id.push_back(surface_.id[i]);
  std::vector<double> re(size), im(size);
  random_amplitudes(options_.seed, id, re.data(), im.data());  // (E9)
  PointList list = list_of(size, 1);
  PointList::Points& points = list.points.front();
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t i = single[k];
    const Complex amplitude = surface_.echoes.amplitude[i];
    CellEcho& echo = echoes[slot[i]];
    // An entry for what both senses of a path add has no pressure of its own (E190).
    if (id[k] != SurfaceEchoes::of_both)
      echo.set_pressure(std::complex<float>(amplitude / std::sqrt(std::norm(amplitude)) * Complex(re[k], im[k])));
    const auto energy = static_cast<float>(energy_of(i));
    const float root = std::sqrt(energy);
    list.echo[k] = slot[i], list.power[k] = energy;
    points.re[k] = root * echo.re, points.im[k] = root * echo.im;
    points.place[k] = static_cast<float>(place_of(i));
    points.node[k] = static_cast<std::int32_t>(plan_.node_of(surface_.echoes.u[i]));
  }
  return list;
}

PointList FieldPointMaker::draw_discs(const DiscList& discs, UninitializedVector<CellEcho>& echoes) const {
  const std::size_t size = discs.id.size();
  PointList list = list_of(size, kernels::points_of_disc);
  kernels::DiscPoints to;
  for (std::size_t k = 0; k < kernels::points_of_disc; ++k) {
    PointList::Points& points = list.points[k];
    to.re[k] = points.re.data(), to.im[k] = points.im.data(), to.place[k] = points.place.data();
    to.node[k] = points.node.data();
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
                      size, to);
  for (std::size_t k = 0; k < size; ++k) {
    const auto root = static_cast<float>(discs.root[k]);
    list.echo[k] = discs.number[k], list.power[k] = root * root;
    if (!(root > 0)) continue;
    std::complex<float> sum = 0;
    for (const PointList::Points& points : list.points) sum += std::complex<float>(points.re[k], points.im[k]);
    CellEcho& echo = echoes[discs.number[k]];
    echo.set_pressure(echo.pressure() + (std::sqrt(discs.part[k]) / root) * sum);
  }
  return list;
}

template <typename Use>
void FieldPointMaker::for_each_cell(float place, const Use& use) const {
  if (!(place > -edge_ && place < static_cast<float>(plan_.cells) + edge_)) return;
  const std::int32_t last = static_cast<std::int32_t>(plan_.cells) - 1,
                     cell = std::min(static_cast<std::int32_t>(place), last);  // 0 if the place is before it
  const float within = place - static_cast<float>(cell);
  if (within < edge_ && cell > 0) use(static_cast<std::size_t>(cell - 1), within + 1);
  use(static_cast<std::size_t>(cell), within);
  if (within > 1 - edge_ && cell < last) use(static_cast<std::size_t>(cell + 1), within - 1);
}

void FieldPointMaker::count(const PointList& list, std::vector<std::size_t>& in_cell) const {
  for (std::size_t k = 0; k < list.echo.size(); ++k)
    if (list.power[k] > 0)
      for (const PointList::Points& points : list.points)
        for_each_cell(points.place[k], [&](std::size_t cell, float) { ++in_cell[cell]; });
}

void FieldPointMaker::put(const PointList& list, std::vector<std::size_t>& at,
                          UninitializedVector<FieldPoint>& points) const {
  for (std::size_t k = 0; k < list.echo.size(); ++k) {
    if (!(list.power[k] > 0)) continue;
    for (const PointList::Points& of : list.points) {
      auto node = static_cast<std::size_t>(of.node[k]);
      std::complex<float> pressure(of.re[k], of.im[k]);
      if (plan_.half_positions) pressure = product(plan_.turn[node], pressure);
      FieldPoint point{pressure.real(), pressure.imag(), list.power[k], 0, 0, list.echo[k]};
      while (node >= plan_.period) node -= plan_.period;
      point.node = static_cast<std::uint32_t>(node);
      for_each_cell(of.place[k], [&](std::size_t cell, float within) {
        point.share = plan_.fields.index_at(within);
        points[at[cell]++] = point;
      });
    }
  }
}

PointsByCell FieldPointMaker::by_cell(std::vector<DrawnPoints>& blocks) const {
  ItemsOfBlocks at;
  for (DrawnPoints& block : blocks) at.push_back(std::move(block.in_cell));
  PointsByCell all;
  all.first = positions_by_group(at, plan_.cells);
  all.point.resize(all.first.back());
  parallel_for(blocks.size(), options_.threads, [&](std::size_t b) {
    put(blocks[b].discs, at[b], all.point);
    put(blocks[b].single, at[b], all.point);
  });
  return all;
}

}  // namespace insonify

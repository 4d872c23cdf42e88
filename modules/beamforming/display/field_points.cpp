// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/display/field_points_internal.hpp"
#include "beamforming/display/point_loops_internal.hpp"
#include "core/parallel.hpp"
#include "core/positions_by_group.hpp"

namespace insonify {
namespace {

constexpr std::uint64_t other_ring = 0xd6e8feb86659fd93;                              // difference of its id, odd
constexpr double inner_ring = 0.70710678118654752, outer_ring = 1.22474487139158905;  // radii, in that of a single ring

using Complex = std::complex<double>;

/// Returns a list of so many echoes of which each has so many points; none of its numbers is set.
PointList list_of(std::size_t echoes, std::size_t points) {
  PointList list;
  list.echo.resize(echoes), list.power.resize(echoes), list.points.resize(points);
  for (PointList::Points& of : list.points)
    of.re.resize(echoes), of.im.resize(echoes), of.node.resize(echoes), of.cell.resize(echoes),
        of.in_cells.resize(echoes);
  return list;
}

// The loops below do without branches for the cell beside, which no processor could foresee.

/// Adds the number of points in each cell.
void count(const PointList& list, std::vector<std::size_t>& in_cell) {
  for (const PointList::Points& points : list.points)
    for (std::size_t k = 0; k < list.echo.size(); ++k) {
      if (!(list.power[k] > 0) || points.cell[k] < 0) continue;
      const std::int32_t cell = points.cell[k], beside = kernels::InCells::of(points.in_cells[k]).beside;
      ++in_cell[static_cast<std::size_t>(cell)];
      in_cell[static_cast<std::size_t>(cell + beside)] += beside != 0 ? 1 : 0;
    }
}

/// Sets the points of a list; at: where the next one of each cell stands.
void put(const PointList& list, std::vector<std::size_t>& at, UninitializedVector<FieldPoint>& points) {
  FieldPoint nowhere;
  for (const PointList::Points& of : list.points)
    for (std::size_t k = 0; k < list.echo.size(); ++k) {
      if (!(list.power[k] > 0) || of.cell[k] < 0) continue;
      const auto [share, share_beside, beside] = kernels::InCells::of(of.in_cells[k]);
      FieldPoint point{of.re[k], of.im[k], list.power[k], static_cast<std::uint32_t>(of.node[k]), share, list.echo[k]};
      points[at[static_cast<std::size_t>(of.cell[k])]++] = point;
      std::size_t& at_beside = at[static_cast<std::size_t>(of.cell[k] + beside)];
      FieldPoint* const copy = beside != 0 ? &points[at_beside] : &nowhere;
      at_beside += beside != 0 ? 1 : 0;
      point.share = share_beside;
      *copy = point;
    }
}

}  // namespace

/// Rings of points of some discs (kernels::Discs), and the numbers of their echoes among those in cells: so few that they
/// stay in the cache.
struct FieldPointMaker::Rings {
  static constexpr std::size_t most = 256;
  template <typename T>
  using Each = std::array<T, most>;

  std::size_t count = 0;
  Each<std::uint64_t> id;
  Each<std::uint32_t> number;
  Each<float> part;  // energy of a point, in that of its echo
  Each<double> place, u, re, im, root;
  std::array<Each<double>, 2> cycles, to_edge;
  std::array<Each<float>, kernels::points_of_disc> place_of_point;  // [cells]
};

FieldPointMaker::FieldPointMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const CellOptions& options)
    : plan_(plan), surface_(surface), options_(options), per_cell_length_(1 / plan.cell_length) {}

DrawnPoints FieldPointMaker::draw(std::size_t begin, std::size_t end, const UninitializedVector<std::uint32_t>& slot,
                                  UninitializedVector<CellEcho>& echoes) const {
  DrawnPoints drawn;
  drawn.in_cell.assign(plan_.cells, 0);
  if (!options_.speckle) return drawn;
  std::vector<std::size_t> discs, single;
  std::size_t rings = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (slot[i] >= echoes.size() || surface_.echoes.amplitude[i] == Complex(0)) continue;
    if (i < surface_.disc.size() && !surface_.disc[i].is_point())
      discs.push_back(i), rings += surface_.disc[i].two_rings ? 2 : 1;
    else
      single.push_back(i);
  }
  drawn.discs = list_of(rings, kernels::points_of_disc);
  draw_discs(discs, slot, echoes, drawn.discs);
  drawn.single = draw_single(single, slot, echoes);
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

void FieldPointMaker::draw_discs(const std::vector<std::size_t>& discs, const UninitializedVector<std::uint32_t>& slot,
                                 UninitializedVector<CellEcho>& echoes, PointList& list) const {
  Rings rings;
  std::size_t drawn = 0;
  const auto draw_listed = [&] {
    draw_rings(rings, drawn, echoes, list);
    drawn += std::exchange(rings.count, 0);
  };
  for (const std::size_t i : discs) {
    add_rings(i, slot[i], rings);
    if (rings.count + 2 > Rings::most) draw_listed();
  }
  draw_listed();
}

void FieldPointMaker::add_rings(std::size_t i, std::uint32_t number, Rings& rings) const {
  const Complex amplitude = surface_.echoes.amplitude[i];
  const EchoDisc& disc = surface_.disc[i];
  const double per_size = 1 / std::sqrt(std::norm(amplitude)), place = place_of(i), energy = energy_of(i);
  const auto add = [&](std::uint64_t id, double radius, double part) {
    const std::size_t k = rings.count++;
    rings.id[k] = id, rings.number[k] = number;
    rings.place[k] = place, rings.u[k] = surface_.echoes.u[i];
    rings.re[k] = amplitude.real() * per_size, rings.im[k] = amplitude.imag() * per_size;
    rings.root[k] = std::sqrt(part * energy), rings.part[k] = static_cast<float>(part);
    for (const std::size_t axis : {0, 1}) {
      rings.cycles[axis][k] = radius * plan_.cycles_per_metre * static_cast<double>(disc.range[axis]);
      rings.to_edge[axis][k] = radius * static_cast<double>(disc.u[axis]);
    }
  };
  constexpr double of_point = 1.0 / static_cast<double>(kernels::points_of_disc);
  if (!disc.two_rings) return add(surface_.id[i], 1, of_point);
  // Rings divide the disc into two of equal area.
  add(surface_.id[i], inner_ring, 0.5 * of_point);
  add(surface_.id[i] + other_ring, outer_ring, 0.5 * of_point);
}

void FieldPointMaker::draw_rings(Rings& rings, std::size_t at, UninitializedVector<CellEcho>& echoes,
                                 PointList& list) const {
  kernels::DiscPoints to;
  for (std::size_t k = 0; k < kernels::points_of_disc; ++k) {
    PointList::Points& points = list.points[k];
    to.re[k] = points.re.data() + at, to.im[k] = points.im.data() + at, to.node[k] = points.node.data() + at;
    to.place[k] = rings.place_of_point[k].data();
  }
  kernels::draw_discs(options_.seed, rings.id.data(),
                      {rings.place.data(),
                       rings.u.data(),
                       rings.re.data(),
                       rings.im.data(),
                       rings.root.data(),
                       {rings.cycles[0].data(), rings.cycles[1].data()},
                       {rings.to_edge[0].data(), rings.to_edge[1].data()},
                       per_cell_length_ / plan_.cycles_per_metre,
                       plan_.nodes_per_u,
                       static_cast<double>(plan_.nodes - 1)},
                      rings.count, to);
  for (std::size_t k = 0; k < rings.count; ++k) {
    const auto root = static_cast<float>(rings.root[k]);
    list.echo[at + k] = rings.number[k], list.power[at + k] = root * root;
    if (!(root > 0)) continue;
    std::complex<float> sum = 0;
    for (std::size_t point = 0; point < kernels::points_of_disc; ++point)
      sum += std::complex<float>(to.re[point][k], to.im[point][k]);
    CellEcho& echo = echoes[rings.number[k]];
    echo.set_pressure(echo.pressure() + (std::sqrt(rings.part[k]) / root) * sum);
  }
  for (std::size_t k = 0; k < kernels::points_of_disc; ++k)
    place(rings.place_of_point[k].data(), rings.count, at, list.points[k]);
}

PointList FieldPointMaker::draw_single(const std::vector<std::size_t>& single,
                                       const UninitializedVector<std::uint32_t>& slot,
                                       UninitializedVector<CellEcho>& echoes) const {
  const std::size_t size = single.size();
  std::vector<std::uint64_t> id;
  for (const std::size_t i : single) id.push_back(surface_.id[i]);
  std::vector<double> re(size), im(size);
  std::vector<float> places(size);
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
    places[k] = static_cast<float>(place_of(i));
    points.node[k] = static_cast<std::int32_t>(plan_.node_of(surface_.echoes.u[i]));
  }
  place(places.data(), size, 0, points);
  return list;
}

void FieldPointMaker::place(const float* place, std::size_t count, std::size_t at, PointList::Points& points) const {
  const FieldShares& fields = plan_.fields;
  const kernels::PlaceRule rule{
      static_cast<std::int32_t>(plan_.cells) - 1,
      static_cast<float>(fields.edge),
      fields.per_cell,
      static_cast<float>(fields.share.size() - 1),
      static_cast<std::int32_t>(plan_.period),
      plan_.half_positions ? reinterpret_cast<const float*>(plan_.turn.data()) : nullptr,
  };
  kernels::place_points(place, count, rule, points.node.data() + at, points.re.data() + at, points.im.data() + at,
                        {points.cell.data() + at, points.in_cells.data() + at});
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

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/label_row_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double least_noise = 1e-9;  // noise in the energy of a cell, of which speckle is drawn where no echo stands
constexpr double rounding = 1e-13;    // part of the louder of two cells that transforms leave in the other
constexpr double parts_per_node = 4;  // parts of a tilted surface for each node of u along it
constexpr double least_tilt = 0.25;   // change of u along a surface from which on its parts differ [nodes]
constexpr double least_of_fields = 0.9;     // least power of ground beside strong echoes, in that of its fields
constexpr double least_interference = 0.1;  // energy of a strong echo in that of a look with which it interferes

/// Looks at a position between two nodes.
double looks_at(double position, const std::vector<double>& looks) {
  const auto left = static_cast<std::size_t>(position);
  return std::lerp(looks[left], looks[left + 1], position - static_cast<double>(left));
}

}  // namespace

CellRow::CellRow(const DisplayPlan& plan, const EchoesByCell& lists, const RowReception& row,
                 const CellOptions& options)
    : plan_(plan),
      lists_(lists),
      row_(row),
      beams_(row.beams),
      options_(options),
      all_(plan.all_length),
      spectrum_(plan.all_length),
      beside_(plan.all_length),
      all_samples_(plan.all_length + guards_before + guards_behind),
      shared_(plan.period + guards_before + guards_behind),
      lags_(plan.period),
      power_(plan.period + guards_before + guards_behind),
      elements_(plan.period),
      at_elements_(plan.period),
      weighted_(plan.period),
      energy_((plan.broad + 1) * kernels::row_length(plan.subranges)),
      alike_(plan.broad + 1),
      whole_(plan.gratings.count > 0 ? plan.broad + 1 + 2 * plan.gratings.count : 0),
      noise_id_(plan.lag.size()),
      noise_re_(plan.lag.size()),
      noise_im_(plan.lag.size()) {
  const std::size_t beams = row.beams.u_beam.size();
  for (Side& side : side_) {
    side.mean.resize(beams);
    for (auto& power : side.power) power.resize(beams);
    for (auto& shared : side.shared) shared.resize(beams);
    side.looks.resize(row.beams.broad_used.size());
    for (auto& field : side.field) field.resize(plan.period + guards_before + guards_behind);
  }
  for (auto& nodes : nodes_) nodes.resize(plan.period);
  for (auto& power : power_at_) power.resize(plan.period);
  for (auto& shared : shared_at_) shared.resize(plan.period);
  for (auto& intensity : even_.intensity) intensity.resize(beams);
  for (auto* numbers : {&even_.looks, &even_.mean, &even_.strong, &drawn_}) numbers->resize(beams);
  if (row.labelled) labels_ = std::make_unique<LabelRow>(plan, lists, *row.labelled);
}

CellRow::~CellRow() = default;

void CellRow::form(std::size_t cell, const std::vector<std::size_t>& beams, Grid<double>& image) {
  const std::size_t sides = std::min<std::size_t>(2, plan_.cells - cell);
  double loudest = 0;
  for (std::size_t s = 0; s < sides; ++s) {
    list_pieces(cell + s, side_[s]);
    loudest = std::max(loudest, side_[s].energy);
  }
  for (std::size_t s = 0; s < sides; ++s)
    side_[s].noise = std::max({row_.element_noise, least_noise * side_[s].energy, rounding * loudest}) * plan_.lag[0];
  form_means(cell, sides);
  const auto write = [&](std::size_t s, const std::vector<double>& intensity) {
    for (std::size_t b = 0; b < beams.size(); ++b)
      image(static_cast<Eigen::Index>(beams[b]), static_cast<Eigen::Index>(cell + s)) = intensity[b];
  };
  if (!options_.speckle) {
    for (std::size_t s = 0; s < sides; ++s) write(s, side_[s].mean);
    return;
  }
  for (auto& nodes : power_at_) std::fill(nodes.begin(), nodes.end(), Complex(0));
  for (auto& nodes : shared_at_) std::fill(nodes.begin(), nodes.end(), 0);
  for (std::size_t s = 0; s < sides; ++s) {
    Side& side = side_[s];
    partition_strong(side);
    sum_strong(side);
    count_looks(cell + s, side);
    sum_fields(cell + s, s);
  }
  sum_powers(sides);
  for (std::size_t s = 0; s < sides; ++s) {
    draw(side_[s]);
    write(s, drawn_);
  }
}

void CellRow::list_pieces(std::size_t cell, Side& side) {
  side.even.clear(), side.strong.clear();
  side.energy = 0;
  for (std::size_t k = lists_.first[cell]; k < lists_.first[cell + 1]; ++k) {
    const EchoInCell& in = lists_.piece[k];
    const double response = row_.response.empty() ? 1 : row_.response[in.echo];
    if (response == 0) continue;
    const auto square = static_cast<float>(response * response);
    const float energy = square * in.energy;
    if (energy > 0) side.even.push_back({&lists_.echoes[in.echo], energy, static_cast<float>(response)});
    side.energy += static_cast<double>(energy);
  }
}

void CellRow::form_means(std::size_t cell, std::size_t sides) {
  if (!labels_) return sum_means(cell);
  // Shares are of the echoes of surfaces alone.
  const EchoLabels& echoes = row_.labelled->echoes;
  const bool has_water = echoes.water_begin < echoes.water_end;
  sum_means(cell, false);
  for (std::size_t s = 0; s < sides; ++s) label(cell + s, side_[s]);
  if (has_water) sum_means(cell);
}

void CellRow::label(std::size_t cell, Side& side) {
  labels_->start(cell);
  for (const Piece& piece : side.even) labels_->add(*piece.echo, piece.energy);
  labels_->finish(side.mean, row_.element_noise * plan_.lag[0]);
}

void CellRow::add_surface(const CellEcho& echo, double energy, const CellEdges::Edge& near, const CellEdges::Edge& far,
                          double* at) const {
  const double nodes_per_metre = static_cast<double>(std::abs(echo.slope)) * plan_.nodes_per_u;
  if (static_cast<double>(echo.half_depth) * nodes_per_metre < least_tilt)
    return add_box(echo.u, half_of_box(static_cast<double>(echo.half_width) * echo.half_width), energy, at);
  // Parts of a tilted surface have directions of their own (E189).
  std::array<CellEdges::Part, CellEdges::most_parts> parts;
  const std::size_t count =
      plan_.edges.parts_between(near, far, echo.range, echo.half_depth, parts_per_node * nodes_per_metre, parts);
  const double along = echo.slope * parts[0].half, across = echo.across;
  const double half = half_of_box(across * across + along * along);
  for (std::size_t k = 0; k < count; ++k)
    add_box(echo.u + echo.slope * parts[k].middle, half, energy * parts[k].share, at);
}

double CellRow::half_of_box(double square) const {
  // The kernel takes away the variance of two boxes of a node: that of nodes, and one that is added here.
  return std::sqrt(square * plan_.nodes_per_u * plan_.nodes_per_u + 0.25);
}

void CellRow::add_box(double u, double half, double energy, double* at) const {
  const double position = std::clamp((u + 1) * plan_.nodes_per_u, 0.0, static_cast<double>(plan_.nodes));
  const double low = std::max(position - half, -0.5) + 1,
               high = std::min(position + half, static_cast<double>(plan_.nodes) + 0.5) + 1;
  const double density = energy / (high - low);
  // Each node gets how much more it has than the one before; the first and the last node are met in part.
  const auto first = static_cast<std::size_t>(low), last = static_cast<std::size_t>(high);
  const double before = density * (low - static_cast<double>(first)),
               within = density * (high - static_cast<double>(last));
  at[2 * first] += density - before, at[2 * first + 2] += before;
  at[2 * last] -= density - within, at[2 * last + 2] -= within;
}

std::vector<CellRow::Complex>& CellRow::densities(std::size_t cell, bool with_water) {
  Densities& kept = densities_[cell / 2 % densities_.size()];
  if (kept.cell == cell && kept.with_water == with_water) return kept.at;
  kept.cell = cell, kept.with_water = with_water;
  kept.at.assign(plan_.all_length, Complex(0));
  for (std::size_t part = 0; part < 2 && cell + part < plan_.cells; ++part) {
    const double begin = plan_.first_range + static_cast<double>(cell + part) * plan_.cell_length;
    const CellEdges::Edge near = plan_.edges.at(begin), far = plan_.edges.at(begin + plan_.cell_length);
    double* const at = reinterpret_cast<double*>(kept.at.data()) + part;
    for (std::size_t k = lists_.first[cell + part]; k < lists_.first[cell + part + 1]; ++k) {
      const EchoInCell& in = lists_.piece[k];
      const CellEcho& echo = lists_.echoes[in.echo];
      if (echo.together == 0) continue;
      const double response = row_.response.empty() ? 1 : row_.response[in.echo];
      const float energy = static_cast<float>(response * response) * in.energy;
      if (energy > 0 && (with_water || !labels_->of_water(echo))) add_surface(echo, energy, near, far, at);
    }
  }
  for (std::size_t i = 1; i < plan_.nodes + 3; ++i) kept.at[i] += kept.at[i - 1];
  return kept.at;
}

void CellRow::add_cells_beside(std::size_t cell, bool with_water) {
  static const std::vector<Complex> nothing;
  const bool is_first = cell == 0, is_last = cell + 2 >= plan_.cells;
  const std::vector<Complex>& own = densities(cell, with_water);
  const std::vector<Complex>& before = is_first ? nothing : densities(cell - 2, with_water);
  const std::vector<Complex>& behind = is_last ? nothing : densities(cell + 2, with_water);
  for (const std::size_t away : {1, 2}) {
    for (std::size_t i = 0; i < plan_.nodes + 3; ++i) {
      const Complex b = is_first ? 0 : before[i], a = is_last ? 0 : behind[i];
      all_[i] = away == 1 ? Complex(b.imag() + own[i].imag(), own[i].real() + a.real()) : b + a;
    }
    plan_.to_all.run(all_.data(), beside_.data());
    const std::vector<double>& kernel = plan_.kernel_beside[away - 1][plan_.kernel_of(cell)];
    for (std::size_t q = 0; q < kernel.size(); ++q) spectrum_[q] += beside_[q] * kernel[q];  // (E188)
  }
}

void CellRow::sum_means(std::size_t cell, bool with_water) {
  // The energies times the pattern.
  plan_.to_all.run(densities(cell, with_water).data(), spectrum_.data());
  const std::vector<double>& kernel = plan_.kernel[plan_.kernel_of(cell)];
  for (std::size_t q = 0; q < kernel.size(); ++q) spectrum_[q] *= kernel[q];
  if (!plan_.kernel_beside[0].empty()) add_cells_beside(cell, with_water);
  plan_.from_all.run(spectrum_.data(), all_samples_.data() + guards_before);
  repeat_ends(all_samples_);
  const double noise = row_.element_noise * plan_.lag[0];
  for (std::size_t b = 0; b < beams_.u_beam.size(); ++b) {
    const Complex mean = beams_.in_all[b].of(all_samples_.data());
    side_[0].mean[b] = std::max(0.0, mean.real()) + noise;  // (E181)
    side_[1].mean[b] = std::max(0.0, mean.imag()) + noise;
  }
  // Glints are so loud that what nodes of u leave of them in far side lobes would exceed all else there.
  for (Side& side : side_)
    for (const Piece& piece : side.even)
      if (piece.echo->together == 0)
        for (std::size_t b = 0; b < beams_.u_beam.size(); ++b)
          side.mean[b] += piece.energy * plan_.mean_intensity(static_cast<double>(piece.echo->u) - beams_.u_beam[b]);
}

double CellRow::heard_of(const Piece& piece, std::size_t beam) const {
  // Mean over a box by three points (Gauss and Legendre).
  const double away = static_cast<double>(piece.echo->u) - beams_.u_beam[beam],
               apart = std::sqrt(0.6) * static_cast<double>(piece.echo->half_width);
  const auto at = [&](double u) { return plan_.response.intensity(u); };
  return piece.energy * (8 * at(away) + 5 * (at(away - apart) + at(away + apart))) / 18;
}

void CellRow::draw(Side& side) {
  for (std::size_t b = 0; b < drawn_.size(); ++b) {
    even_.looks[b] = looks_at(beams_.broad_of[b], side.looks);
    even_.mean[b] = side.mean[b], even_.strong[b] = 0;
    for (std::size_t q = 0; q < field_parts; ++q)
      even_.intensity[q][b] = std::norm(Complex(beams_.in_field[b].of(side.field[q].data())));
    if (side.groups > 0) add_groups(b, side);
  }
  kernels::EvenGround ground{{}, {}, {}, even_.looks.data(), even_.mean.data(), even_.strong.data()};
  for (std::size_t q = 0; q < field_parts; ++q)
    ground.intensity[q] = even_.intensity[q].data(), ground.power[q] = side.power[q].data();
  for (std::size_t q = 0; q + 1 < field_parts; ++q) ground.shared[q] = side.shared[q].data();
  kernels::draw_looks(ground, drawn_.size(), drawn_.data());  // (E183)
}

void CellRow::add_groups(std::size_t beam, Side& side) {
  // At the end of a strong echo's lobe the mean is a small difference of two large energies; fields are right to a tenth.
  double fields = -side.noise;
  for (const auto& power : side.power) fields += power[beam];
  const double mean = std::max(even_.mean[beam], least_of_fields * fields), looks = even_.looks[beam];
  double strong = 0;
  std::size_t taken = 0;
  for (std::size_t k = 0; k < side.groups; ++k) {
    const BetweenFields& position = beams_.in_field[beam];
    Complex s = Complex(position.of(side.strong_field[k].data()));
    // A group interferes with one look of the even ground, if it is not far weaker.
    if (std::norm(s) > least_interference * mean / looks && static_cast<double>(taken + 1) < looks) {
      const std::size_t q = taken++ % field_parts;
      s += std::sqrt(mean / (looks * side.power[q][beam])) * Complex(position.of(side.field[q].data()));
    }
    strong += std::norm(s);  // (E184)
  }
  even_.strong[beam] = strong;
  even_.mean[beam] = mean;
  if (taken == 0) return;
  // Fields of which no look interferes are left for the rest of the even ground.
  for (std::size_t q = 0; q < std::min(taken, field_parts - 1); ++q)
    even_.intensity[q][beam] = 0, side.power[q][beam] = std::numeric_limits<double>::min(), side.shared[q][beam] = 0;
  const double left = looks - static_cast<double>(taken);
  even_.looks[beam] = left, even_.mean[beam] = mean * left / looks;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "support/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {

namespace {

// Returns the power of the beam steered to u_beam for a wave from u, summed over the elements.
double beam_power(const LineArray& array, double wavelength, double du) {
  double sum = 0;
  for (std::size_t m = 0; m < array.elements(); ++m)
    sum +=
        array.shading[m] * std::cos(2 * pi * array.spacing / wavelength * element_position(m, array.elements()) * du);
  return std::pow(sum / static_cast<double>(array.elements()), 2);
}

// Returns the power of all beams of each group for waves from u = -1 .. 1, in steps a twentieth of a beam or less.
Grid<double> group_powers(const SonarHead& head, double wavelength, Eigen::Index groups, Eigen::Index steps) {
  std::vector<double> table(static_cast<std::size_t>(2 * steps + 1));
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = beam_power(head.array, wavelength, 2.0 * static_cast<double>(i) / static_cast<double>(steps) - 2);
  Grid<double> powers = Grid<double>::Zero(groups, steps + 1);
  const auto beams = static_cast<Eigen::Index>(head.fan.beams());
  for (Eigen::Index b = 0; b < beams; ++b) {
    const double u_beam = std::sin(head.fan.azimuth[static_cast<std::size_t>(b)]);
    for (Eigen::Index i = 0; i <= steps; ++i) {
      const double du = 2.0 * static_cast<double>(i) / static_cast<double>(steps) - 1 - u_beam;
      powers(b * groups / beams, i) +=
          table[static_cast<std::size_t>(std::lround((du + 2) / 2 * static_cast<double>(steps)))];
    }
  }
  return powers;
}

// One cell: heights of its corners, counter-clockwise from the one nearest to the grid's origin, and how it is cut.
struct Cell {
  double a, b, c, d;
  bool falling;  // the diagonal runs from b to d

  Cell(const HeightField& f, Eigen::Index row, Eigen::Index column)
      : a(f.z(row, column)), b(f.z(row, column + 1)), c(f.z(row + 1, column + 1)), d(f.z(row + 1, column)) {
    falling = std::isnan(a) || std::isnan(c) || std::abs(b - d) < std::abs(a - c);
  }
  // Returns the height at x, y in 0 .. 1; NaN in a hole.
  double at(double x, double y) const {
    if (falling) return x + y <= 1 ? a + x * (b - a) + y * (d - a) : c + (1 - x) * (d - c) + (1 - y) * (b - c);
    return x >= y ? a + x * (b - a) + y * (c - b) : a + y * (d - a) + x * (c - d);
  }
};

constexpr double rounding = 1e-9;  // [m]

}  // namespace

Eigen::Vector3d HeightField::node(Eigen::Index row, Eigen::Index column) const {
  return {corner.x() + spacing * static_cast<double>(column), corner.y() + spacing * static_cast<double>(row),
          z(row, column)};
}

double HeightField::at(const Eigen::Vector2d& p) const {
  constexpr double nothing = -std::numeric_limits<double>::infinity();
  const Eigen::Vector2d q = (p - corner) / spacing;
  const double x = std::floor(q.x()), y = std::floor(q.y());
  if (!(x >= 0 && y >= 0 && x + 1 < static_cast<double>(z.cols()) && y + 1 < static_cast<double>(z.rows())))
    return nothing;
  const double height =
      Cell(*this, static_cast<Eigen::Index>(y), static_cast<Eigen::Index>(x)).at(q.x() - x, q.y() - y);
  return std::isnan(height) ? nothing : height;
}

std::vector<HeightField::Triangle> HeightField::triangles(Eigen::Index row, Eigen::Index column) const {
  const Eigen::Vector3d a = node(row, column), b = node(row, column + 1), c = node(row + 1, column + 1),
                        d = node(row + 1, column);
  std::vector<Triangle> both = Cell(*this, row, column).falling ? std::vector<Triangle>{{a, b, d}, {b, c, d}}
                                                                : std::vector<Triangle>{{a, b, c}, {a, c, d}};
  std::erase_if(both, [](const Triangle& t) { return !(t[0] + t[1] + t[2]).allFinite(); });
  return both;
}

bool HeightField::in_view(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const Eigen::Vector2d start = (from.head<2>() - corner) / spacing, step = (to.head<2>() - from.head<2>()) / spacing;
  const double rise = to.z() - from.z();
  std::array<Eigen::Index, 2> cell = {static_cast<Eigen::Index>(std::floor(start.x())),
                                      static_cast<Eigen::Index>(std::floor(start.y()))};
  const std::array<Eigen::Index, 2> cells = {z.cols() - 1, z.rows() - 1};
  const auto inside = [&](int k) { return cell[k] >= 0 && cell[k] < cells[k]; };
  // From one grid line to the next, along the line's parameter t.
  for (double t = 0; t < 1 && inside(0) && inside(1);) {
    int across = 0;
    double next = 1;
    for (int k = 0; k < 2; ++k) {
      if (step[k] == 0) continue;
      const double line = static_cast<double>(cell[k] + (step[k] > 0 ? 1 : 0)), reached = (line - start[k]) / step[k];
      if (reached < next) next = std::max(t, reached), across = k;
    }
    const Cell here(*this, cell[1], cell[0]);
    const auto x = [&](double at) { return start.x() + at * step.x() - static_cast<double>(cell[0]); };
    const auto y = [&](double at) { return start.y() + at * step.y() - static_cast<double>(cell[1]); };
    const auto stands = [&](double at) { return here.at(x(at), y(at)) > from.z() + at * rise + rounding; };
    if (stands(t) || stands(next)) return false;
    const auto side = [&](double at) { return here.falling ? x(at) + y(at) - 1 : x(at) - y(at); };
    const double before = side(t), after = side(next);
    if (before * after < 0 && stands(t + (next - t) * before / (before - after))) return false;
    t = next;
    cell[across] += step[across] > 0 ? 1 : -1;
  }
  return true;
}

HeightField height_field(const Eigen::Vector2d& centre, double half, double spacing,
                         const std::function<double(double, double)>& z) {
  const auto nodes = static_cast<Eigen::Index>(std::lround(2 * half / spacing)) + 1;
  HeightField field{centre.array() - half, spacing, Grid<double>(nodes, nodes)};
  for (Eigen::Index j = 0; j < nodes; ++j)
    for (Eigen::Index i = 0; i < nodes; ++i)
      field.z(j, i) =
          z(field.corner.x() + spacing * static_cast<double>(i), field.corner.y() + spacing * static_cast<double>(j));
  return field;
}

std::string points_of(const HeightField& field) {
  std::ostringstream out;
  out.precision(9);
  for (Eigen::Index j = 0; j < field.z.rows(); ++j)
    for (Eigen::Index i = 0; i < field.z.cols(); ++i)
      if (!std::isnan(field.z(j, i)))
        out << field.corner.x() + field.spacing * static_cast<double>(i) << ' '
            << field.corner.y() + field.spacing * static_cast<double>(j) << ' ' << field.z(j, i) << '\n';
  return out.str();
}

double heard_by_definition(const Eigen::Vector3d& p, double cosine, double area, double lambert_mu,
                           const SonarHead& head, const Medium& medium) {
  const double r = p.norm(), alpha_db = medium.absorption.a0 / nepers_per_db;
  const double off_axis = (std::asin(p.z() / r) - head.fan.elevation.front()) / head.fan.elevation_width;
  const double level = head.pulse.source_level_db - 40 * std::log10(r) - 2 * alpha_db * r +
                       10 * std::log10(lambert_mu * cosine * cosine * area) - 40 * std::log10(2) * off_axis * off_axis;
  return std::pow(10, (level - 120) / 10);
}

Grid<double> energy_by_definition(const HeightField& field, double lambert_mu, const SonarHead& head, const Pose& pose,
                                  const Medium& medium, int cuts, Eigen::Index groups, Eigen::Index bands,
                                  bool occlusion) {
  const Eigen::Index steps = 40000, bins = static_cast<Eigen::Index>(head.gate.bins());
  const Grid<double> powers = group_powers(head, medium.sound_speed / head.pulse.centre_frequency, groups, steps);
  const Pose head_from_world = pose.inverse();

  const auto add_facet = [&](const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double area,
                             Grid<double>& energy) {
    const Eigen::Vector3d p = head_from_world * centre;
    const double r = p.norm(), cosine = normal.dot(pose.translation() - centre) / r;
    if (!(p.x() > 0 && cosine > 0 && r < head.gate.max_range + 1) ||
        (occlusion && !field.in_view(centre, pose.translation())))
      return;
    const double power = heard_by_definition(p, cosine, area, lambert_mu, head, medium);
    // Samples within the pulse, whose energy has fallen to one half at c / 2B from each other.
    const double middle = (r - head.gate.min_range) / head.gate.bin_size - 0.5;
    const double reach = medium.sound_speed / head.pulse.bandwidth / head.gate.bin_size;
    const Eigen::Index from = std::max<Eigen::Index>(0, static_cast<Eigen::Index>(std::ceil(middle - reach)));
    const Eigen::Index to = std::min(bins - 1, static_cast<Eigen::Index>(std::floor(middle + reach)));
    const auto u = static_cast<Eigen::Index>(std::lround((p.y() / r + 1) / 2 * static_cast<double>(steps)));
    for (Eigen::Index n = from; n <= to; ++n) {
      const double t = 2 * (head.gate.centre(static_cast<std::size_t>(n)) - r) / medium.sound_speed;
      const double envelope = std::exp(-std::pow(pi * head.pulse.bandwidth * t, 2) / (2 * std::log(2)));
      energy.col(n * bands / bins) += power * envelope * envelope * powers.col(u);
    }
  };

  // Both triangles of every square, cut into triangles of equal size.
  const auto add_triangle = [&](const HeightField::Triangle& t, Grid<double>& energy) {
    const Eigen::Vector3d e = (t[1] - t[0]) / cuts, f = (t[2] - t[0]) / cuts, cross = e.cross(f);
    const double area = cross.norm() / 2;
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        add_facet(t[0] + (i + 1 / 3.0) * e + (j + 1 / 3.0) * f, cross / (2 * area), area, energy);
        if (i + j + 1 < cuts) add_facet(t[0] + (i + 2 / 3.0) * e + (j + 2 / 3.0) * f, cross / (2 * area), area, energy);
      }
  };
  const auto rows = static_cast<std::size_t>(field.z.rows() - 1);
  std::vector<Grid<double>> of_row(rows, Grid<double>::Zero(groups, bands));
  parallel_for(rows, 0, [&](std::size_t row) {
    for (Eigen::Index column = 0; column + 1 < field.z.cols(); ++column)
      for (const auto& triangle : field.triangles(static_cast<Eigen::Index>(row), column))
        add_triangle(triangle, of_row[row]);
  });
  Grid<double> energy = Grid<double>::Zero(groups, bands);
  for (const Grid<double>& part : of_row) energy += part;
  return energy;
}

Grid<double> energy_of(const ComplexGridF& pressure, Eigen::Index groups, Eigen::Index bands) {
  Grid<double> energy = Grid<double>::Zero(groups, bands);
  for (Eigen::Index b = 0; b < pressure.rows(); ++b)
    for (Eigen::Index n = 0; n < pressure.cols(); ++n)
      energy(b * groups / pressure.rows(), n * bands / pressure.cols()) += std::norm(pressure(b, n)) / 2.0;
  return energy;
}

}  // namespace insonify

#include "support/height_field.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "core/units.hpp"

namespace insonify {

namespace {

// Power of the beam steered to u_beam for a wave from u, summed over the elements.
double beam_power(const LineArray& array, double wavelength, double du) {
  double sum = 0;
  for (std::size_t m = 0; m < array.elements(); ++m)
    sum += array.shading[m] * std::cos(2 * pi * array.spacing / wavelength * element_place(m, array.elements()) * du);
  return std::pow(sum / static_cast<double>(array.elements()), 2);
}

// Power of all beams of each group for waves from u = -1 .. 1, in steps a twentieth of a beam or less.
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

// True if no part of the field stands on the straight line from `head` to a facet at `p`.
bool in_view(const HeightField& field, const Eigen::Vector3d& head, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = p - head;
  const double across = d.head<2>().norm(), step = 0.4 * field.spacing;
  for (double s = step; s < across; s += step) {
    const Eigen::Vector3d q = p - d * (s / across);
    if (field.at(q.head<2>()) > q.z() + 1e-9) return false;
  }
  return true;
}

}  // namespace

double HeightField::at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d q = (p - corner) / spacing;
  const double x = std::floor(q.x()), y = std::floor(q.y());
  if (!(x >= 0 && y >= 0 && x + 1 < static_cast<double>(z.cols()) && y + 1 < static_cast<double>(z.rows())))
    return -std::numeric_limits<double>::infinity();
  const auto i = static_cast<Eigen::Index>(x), j = static_cast<Eigen::Index>(y);
  const double a = q.x() - x, b = q.y() - y;
  // The diagonal runs from node (j, i + 1) to node (j + 1, i).
  if (a + b <= 1) return z(j, i) + a * (z(j, i + 1) - z(j, i)) + b * (z(j + 1, i) - z(j, i));
  return z(j + 1, i + 1) + (1 - a) * (z(j + 1, i) - z(j + 1, i + 1)) + (1 - b) * (z(j, i + 1) - z(j + 1, i + 1));
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
      out << field.corner.x() + field.spacing * static_cast<double>(i) << ' '
          << field.corner.y() + field.spacing * static_cast<double>(j) << ' ' << field.z(j, i) << '\n';
  return out.str();
}

Grid<double> energy_by_definition(const HeightField& field, double lambert_mu, const SonarHead& head, const Pose& pose,
                                  const Medium& medium, int cuts, Eigen::Index groups, Eigen::Index bands) {
  const Eigen::Index steps = 40000, bins = static_cast<Eigen::Index>(head.gate.bins());
  const Grid<double> powers = group_powers(head, medium.sound_speed / head.pulse.centre_frequency, groups, steps);
  const double alpha_db = medium.absorption.a0 / nepers_per_db;
  Grid<double> energy = Grid<double>::Zero(groups, bands);
  const Pose head_from_world = pose.inverse();

  const auto add_facet = [&](const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double area) {
    const Eigen::Vector3d p = head_from_world * centre;
    const double r = p.norm(), cosine = normal.dot(pose.translation() - centre) / r;
    if (!(p.x() > 0 && cosine > 0 && r < head.gate.max_range + 1) || !in_view(field, pose.translation(), centre))
      return;
    const double off_axis = (std::asin(p.z() / r) - head.fan.elevation.front()) / head.fan.elevation_width;
    const double level = head.pulse.source_level_db - 40 * std::log10(r) - 2 * alpha_db * r +
                         10 * std::log10(lambert_mu * cosine * cosine * area) -
                         40 * std::log10(2) * off_axis * off_axis;
    const double power = std::pow(10, (level - 120) / 10);
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
  const auto add_triangle = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d e = (b - a) / cuts, f = (c - a) / cuts, cross = e.cross(f);
    const double area = cross.norm() / 2;
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; i + j < cuts; ++j) {
        add_facet(a + (i + 1 / 3.0) * e + (j + 1 / 3.0) * f, cross / (2 * area), area);
        if (i + j + 1 < cuts) add_facet(a + (i + 2 / 3.0) * e + (j + 2 / 3.0) * f, cross / (2 * area), area);
      }
  };
  const auto node = [&](Eigen::Index j, Eigen::Index i) {
    return Eigen::Vector3d(field.corner.x() + field.spacing * static_cast<double>(i),
                           field.corner.y() + field.spacing * static_cast<double>(j), field.z(j, i));
  };
  for (Eigen::Index j = 0; j + 1 < field.z.rows(); ++j)
    for (Eigen::Index i = 0; i + 1 < field.z.cols(); ++i) {
      add_triangle(node(j, i), node(j, i + 1), node(j + 1, i));
      add_triangle(node(j + 1, i + 1), node(j + 1, i), node(j, i + 1));
    }
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

// SPDX-License-Identifier: BSD-3-Clause
#include "support/rough_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "core/units.hpp"

namespace insonify {

namespace {

struct Wave {
  double kx, ky, phase, height;
};

std::vector<Wave> waves(double shortest) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Wave> all(80);
  for (Wave& w : all) {
    const double length = 0.1 * std::pow(20, uniform(random)), angle = 2 * pi * uniform(random);
    w = {2 * pi / length * std::cos(angle), 2 * pi / length * std::sin(angle), 2 * pi * uniform(random), 0.02 * length};
    if (length < shortest) w.height = 0;
  }
  return all;
}

// Returns a step of `height` about x = 0 with a slope of 70 degrees.
double step(double x, double height) {
  const double half = 0.5 * height / std::tan(radians(70));
  return height * std::clamp(0.5 * (x / half + 1), 0.0, 1.0);
}

// Random caps of spheres of which 70 degrees stand out, one in each square of `side`.
class Boulders {
 public:
  explicit Boulders(double side) : side_(side) {}
  double height(double x, double y) {
    double highest = 0;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const Sphere& s = in_square(std::floor(x / side_) + i, std::floor(y / side_) + j);
        const double squared = std::pow(x - s.x, 2) + std::pow(y - s.y, 2), base = s.radius * std::cos(radians(70));
        if (squared < s.radius * s.radius) highest = std::max(highest, std::sqrt(s.radius * s.radius - squared) - base);
      }
    return highest;
  }

 private:
  struct Sphere {
    double x, y, radius;
  };
  // Each square has random numbers of its own, drawn once.
  const Sphere& in_square(double column, double row) {
    const auto [position, is_new] = spheres_.try_emplace({static_cast<int>(column), static_cast<int>(row)});
    Sphere& s = position->second;
    if (is_new) {
      std::seed_seq seed{position->first.first + 1000, position->first.second + 1000};
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform;
      s.x = (column + uniform(random)) * side_, s.y = (row + uniform(random)) * side_;
      s.radius = 0.08 + 0.2 * std::pow(uniform(random), 3);
    }
    return s;
  }
  double side_;
  std::map<std::pair<int, int>, Sphere> spheres_;
};

Eigen::Vector2d size_of(const HeightField& field) {
  return field.spacing *
         Eigen::Vector2d(static_cast<double>(field.z.cols() - 1), static_cast<double>(field.z.rows() - 1));
}

}  // namespace

HeightField rough_field(const RoughFieldOptions& o) {
  const std::vector<Wave> all = waves(o.shortest);
  Boulders boulders(o.boulders > 0 ? 1 / std::sqrt(o.boulders) : 1);
  return height_field(o.centre, o.half, o.spacing, [&](double x, double y) {
    double z = 0;
    for (const Wave& w : all) z += w.height * std::cos(w.kx * x + w.ky * y + w.phase);
    if (o.boulders > 0) z += boulders.height(x, y);
    if (o.terraces) z += step(y - 1.1 - 0.3 * std::sin(2 * x), 0.2) + step(x - 0.8 - 0.2 * std::sin(3 * y), 0.2);
    return z;
  });
}

HeightField with_holes(HeightField field, double across, double per_square_metre) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit;
  const Eigen::Vector2d size = size_of(field);
  for (int left = static_cast<int>(per_square_metre * size.prod()); left > 0; --left) {
    const Eigen::Vector2d middle = field.corner + Eigen::Vector2d(unit(random), unit(random)).cwiseProduct(size);
    for (Eigen::Index j = 0; j < field.z.rows(); ++j)
      for (Eigen::Index i = 0; i < field.z.cols(); ++i)
        if ((field.node(j, i).head<2>() - middle).norm() < across / 2)
          field.z(j, i) = std::numeric_limits<double>::quiet_NaN();
  }
  return field;
}

std::vector<Eigen::Vector3d> draw_points(const HeightField& field, const DrawOptions& o) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> off(-o.jitter, o.jitter);
  std::normal_distribution<double> noise;
  const double dx = o.spacing / std::sqrt(o.stretch), dy = o.spacing * std::sqrt(o.stretch);
  const Eigen::Vector2d size = size_of(field);
  std::vector<Eigen::Vector3d> points;
  const auto columns = std::lround(size.x() / dx), rows = std::lround(size.y() / dy);
  for (long j = 0; j <= rows; ++j)
    for (long i = 0; i <= columns; ++i) {
      const Eigen::Vector2d position = field.corner + Eigen::Vector2d((static_cast<double>(i) + off(random)) * dx,
                                                                      (static_cast<double>(j) + off(random)) * dy);
      double z = field.at(position.cwiseMin(field.corner + size * (1 - 1e-9)).cwiseMax(field.corner));
      if (o.noise > 0) z += o.noise * o.spacing * noise(random);
      if (std::isfinite(z)) points.emplace_back(position.x(), position.y(), z);
    }
  return points;
}

std::string text_of(const std::vector<Eigen::Vector3d>& points) {
  std::ostringstream out;
  out.precision(9);
  for (const Eigen::Vector3d& p : points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  return out.str();
}

}  // namespace insonify

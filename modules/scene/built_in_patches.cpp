// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/built_in_patches_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

enum ReefMaterial : std::uint16_t { coral_sand, reef_rock, coral };

constexpr double reef_length = 12;  ///< length along x and width across y [m]

/// Returns independent numbers in (0, 1) for one object of the reef.
std::array<double, 4> numbers_of(std::uint64_t seed, std::uint64_t thing, std::uint64_t part = 0) {
  return random_uniform(seed, RandomStage::scene_points, {~1ull, thing, part});
}

/// Height of the reef: two spurs along x that rise from sand, rough in every octave from 2 m to 6 cm.
class ReefBed {
 public:
  explicit ReefBed(std::uint64_t seed) {
    double wavelength = 2;
    for (std::size_t i = 0; i < waves_.size(); ++i, wavelength /= 1.28) {
      const auto u = numbers_of(seed, 0, i);
      const double turn = pi * u[0];
      waves_[i] = {2 * pi / wavelength * Vector2d(std::cos(turn), std::sin(turn)), 2 * pi * u[1], 0.03 * wavelength};
    }
  }

  double height(double x, double y) const {
    const double middle = 0.5 * std::sin(0.7 * x);
    const double spur =
        std::exp(-std::pow((y - 2.2 - middle) / 1.5, 2)) + 0.8 * std::exp(-std::pow((y + 2.6 + middle) / 1.2, 2));
    const double rise = 0.5 + 0.5 * std::tanh((x - 3) / 1.2);
    const double rock = std::clamp(1.4 * spur * rise, 0.0, 1.0);
    double roughness = 0;
    for (const Wave& w : waves_) roughness += w.height * std::sin(w.vector.dot(Vector2d(x, y)) + w.phase);
    return -5 + 1.6 * spur * rise + 0.02 * std::sin(14 * x + 2 * std::sin(1.3 * y)) * (1 - rock) + rock * roughness;
  }

 private:
  struct Wave {
    Vector2d vector{};
    double phase = 0, height = 0;
  };
  std::array<Wave, 15> waves_{};
};

Patch bed_patch(const ReefBed& bed, double low, double high, ReefMaterial material) {
  return {[bed, low, high](double u, double v) {
            const double x = low + (high - low) * u, y = reef_length * (v - 0.5);
            return Vector3d(x, y, bed.height(x, y));
          },
          material};
}

/// Returns a lump with meandering grooves.
Patch massive_coral(const Vector3d& centre, double radius, double phase) {
  Patch lump = ellipsoid(centre, {radius, radius, 0.75 * radius});
  lump.at = [ball = lump.at, centre, phase](double u, double v) {
    const Vector3d p = ball(u, v) - centre;
    const Vector3d at = 9 / p.norm() * p + Vector3d::Constant(phase);
    return Vector3d(centre + p * (1 + 0.03 * std::sin(at.x() + 2 * std::sin(at.y())) * std::sin(at.z() + at.y())));
  };
  return lump;
}

void add_branching_coral(std::vector<Patch>& patches, const Vector3d& foot, double height, std::uint64_t seed,
                         std::uint64_t thing) {
  constexpr int branches = 14;
  for (std::uint64_t i = 0; i < branches; ++i) {
    const auto u = numbers_of(seed, thing, i + 1);
    const double turn = 2 * pi * (static_cast<double>(i) + u[0]) / branches, lean = 0.15 + 0.75 * u[1];
    const Vector3d axis(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
    patches.push_back(cylinder(foot, height * (0.7 + 0.3 * u[2]) * axis, 0.018));
  }
}

void add_table_coral(std::vector<Patch>& patches, const Vector3d& foot, double radius) {
  patches.push_back(cylinder(foot - Vector3d(0, 0, 0.1), {0, 0, 0.1 + 0.6 * radius}, 0.12 * radius));
  patches.push_back(ellipsoid(foot + Vector3d(0, 0, 0.6 * radius), {radius, radius, 0.04}));
}

void add_corals(std::vector<Patch>& patches, const ReefBed& bed, std::uint64_t seed) {
  constexpr std::uint64_t colonies = 42;
  for (std::uint64_t thing = 1; thing <= colonies; ++thing) {
    const auto u = numbers_of(seed, thing);
    // Corals grow on the spurs, where sand does not bury them.
    const double x = 3 + 8.5 * u[0], side = thing % 3 == 0 ? -2.6 : 2.2;
    const double y = side + (side > 0 ? 0.5 : -0.5) * std::sin(0.7 * x) + 2 * (u[1] - 0.5);
    const Vector3d foot(x, y, bed.height(x, y));
    const std::size_t before = patches.size();
    if (thing % 3 == 1)
      add_branching_coral(patches, foot, 0.25 + 0.2 * u[2], seed, thing);
    else if (thing % 7 == 0)
      add_table_coral(patches, foot, 0.35 + 0.35 * u[2]);
    else
      patches.push_back(massive_coral(foot, 0.12 + 0.3 * u[2] * u[2], 10 * u[3]));
    for (std::size_t p = before; p < patches.size(); ++p) patches[p].material = coral, patches[p].density = 2;
  }
}

enum RiverMaterial : std::uint16_t { river_sand, boulder };

constexpr double tile_length = 8, tile_width = 4;  ///< size of the bed's tiles along x and across [m]
constexpr int tiles_along = 5, tiles_across = 4;
constexpr double bank = 0.5 * tile_width * tiles_across;  ///< distance of the bed's edges from the middle [m]

/// Returns independent numbers in (0, 1) for one object of the river.
std::array<double, 4> river_numbers(std::uint64_t seed, std::uint64_t thing) {
  return random_uniform(seed, RandomStage::scene_points, {~2ull, thing, 0});
}

/// Height of the bed: dunes steeper downstream, ripples on them, four pits, and banks that rise a metre to either side.
class RiverBed {
 public:
  explicit RiverBed(std::uint64_t seed) : phase_(river_numbers(seed, 0)) {
    for (std::size_t i = 0; i < pits_.size(); ++i) {
      const auto u = river_numbers(seed, 1 + i);
      pits_[i] = {Vector2d(4 + 32 * u[0], 10 * (u[1] - 0.5)), 0.5 + 0.5 * u[2], 0.8 + 0.6 * u[3]};
    }
  }

  double height(double x, double y) const {
    const double crest = x + 1.2 * std::sin(0.25 * y + 2 * pi * phase_[0]) + 0.5 * std::sin(0.6 * y);
    const double turn = 2 * pi * (crest / 6 + phase_[1]);
    const double dune = -0.2 * (std::sin(turn) + 0.35 * std::sin(2 * turn) + 0.13 * std::sin(3 * turn));
    const double ripple = 0.012 * std::sin(2 * pi * (crest + 0.1 * std::sin(3 * y)) / 0.35 + 2 * pi * phase_[2]);
    double pits = 0;
    for (const Pit& pit : pits_)
      pits += pit.depth * std::exp(-(Vector2d(x, y) - pit.centre).squaredNorm() / (pit.radius * pit.radius));
    return -5.6 + std::pow(y / bank, 4) + dune + ripple - pits;
  }

 private:
  struct Pit {
    Vector2d centre = Vector2d::Zero();
    double depth = 0, radius = 1;
  };
  std::array<double, 4> phase_;
  std::array<Pit, 4> pits_{};
};

/// Returns the bed over a rectangle of the level plane. `level` maps the unit square to the rectangle.
template <typename Level>
Patch bed_over(const RiverBed& bed, const Level& level) {
  return facing_away_from({0, 0, -1000}, {[bed, level](double u, double v) {
                                            const Vector2d p = level(u, v);
                                            return Vector3d(p.x(), p.y(), bed.height(p.x(), p.y()));
                                          },
                                          river_sand});
}

/// Adds a tile with an elliptic gap as four patches, each between a quarter of the gap's edge and a side of the tile.
void add_tile_with_gap(std::vector<Patch>& patches, const RiverBed& bed, const Vector2d& middle, const Vector2d& gap,
                       const Vector2d& radii) {
  const Vector2d half(tile_length / 2, tile_width / 2);
  for (int side = 0; side < 4; ++side) {
    const Eigen::Rotation2Dd quarter(0.5 * pi * side);
    patches.push_back(bed_over(bed, [=](double u, double v) -> Vector2d {
      const double across = 2 * v - 1, turn = 0.25 * pi * across;
      const Vector2d edge = gap + radii.cwiseProduct(quarter * Vector2d(std::cos(turn), std::sin(turn)));
      return edge + u * (middle + half.cwiseProduct(quarter * Vector2d(1, across)) - edge);
    }));
  }
}

void add_boulder(std::vector<Patch>& patches, const RiverBed& bed, const Vector2d& at, double radius) {
  patches.push_back(
      ellipsoid({at.x(), at.y(), bed.height(at.x(), at.y()) + 0.3 * radius}, {radius, 0.85 * radius, 0.7 * radius}));
  patches.back().material = boulder;
  patches.back().density = 2;
}

}  // namespace

std::vector<Patch> reef_patches(std::uint64_t seed) {
  const ReefBed bed(seed);
  std::vector<Patch> patches = {bed_patch(bed, 0, 2, coral_sand), bed_patch(bed, 2, reef_length, reef_rock)};
  add_corals(patches, bed, seed);
  return patches;
}

std::vector<Material> reef_materials() {
  // Orders of magnitude at imaging frequencies, as in the harbour: sand and rock of APL-UW TR 9407; not calibrated.
  return {{"coral_sand", power_from_db(-21)}, {"reef_rock", power_from_db(-12)}, {"coral", power_from_db(-10)}};
}

std::vector<Patch> river_patches(std::uint64_t seed) {
  const RiverBed bed(seed);
  std::vector<Patch> patches;
  for (int i = 0; i < tiles_along; ++i)
    for (int j = 0; j < tiles_across; ++j) {
      const auto u = river_numbers(seed, 100 + static_cast<std::uint64_t>(tiles_across * i + j));
      const Vector2d middle((i + 0.5) * tile_length, (j + 0.5) * tile_width - bank);
      const Vector2d gap = middle + Vector2d(2 * (u[0] - 0.5), 2 * (u[1] - 0.5));
      const double radius = 0.3 + 0.5 * u[2];
      add_boulder(patches, bed, gap - Vector2d(1.2 * radius, 0), radius);
      if (u[3] < 0.4) {  // the boulder stood between the bed behind it and the scanner
        add_tile_with_gap(patches, bed, middle, gap, {1.3 * radius, 0.9 * radius});
      } else {
        const Vector2d corner = middle - 0.5 * Vector2d(tile_length, tile_width);
        patches.push_back(bed_over(bed, [corner](double a, double b) -> Vector2d {
          return corner + Vector2d(tile_length * a, tile_width * b);
        }));
      }
    }
  return patches;
}

std::vector<Material> river_materials() {
  // Orders of magnitude, as in the reef: sand and rock of APL-UW TR 9407; not calibrated.
  return {{"river_sand", power_from_db(-20)}, {"boulder", power_from_db(-10)}};
}

}  // namespace insonify

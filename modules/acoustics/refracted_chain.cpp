// SPDX-License-Identifier: BSD-3-Clause
// Rays by tilted planes through a profile. Between bounces they are eigenrays; the bounces are where travel time does not
// change if they are moved along their planes (Fermat). Steps:
//   1. Newton's method from the straight way: first with the second derivatives of straight pieces, then with those of
//      the rays, by differences
//   2. level: stationary phase over all planes, with the same second derivatives
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "acoustics/refract_paths.hpp"
#include "acoustics/refracted_chain_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using Tangents = Eigen::Matrix<double, 3, 2>;

constexpr double shortest_piece = 1e-3, close_enough = 1e-7;  // [m]
constexpr int most_steps = 24, steps_between_derivatives = 4;

class ChainSearch {
 public:
  ChainSearch(const RefractedLegs& rays, std::span<const Boundary* const> planes, std::vector<Vector3d> bounces,
              const Vector3d& position)
      : rays_(rays), planes_(planes), bounces_(std::move(bounces)), position_(position) {
    for (const Boundary* plane : planes_) tangents_.push_back(across_way(plane->normal));
  }

  /// The ray, if the search ends.
  std::optional<RefractedChain> find() {
    for (std::size_t k = 0; k <= planes_.size(); ++k)
      if (!(piece_length(k) > shortest_piece)) return std::nullopt;
    straight_ = straight_length();
    Eigen::MatrixXd second = straight_derivatives();
    for (int step = 1; step <= most_steps; ++step) {
      const auto slope = slopes(bounces_);
      if (!slope) return std::nullopt;
      const Eigen::VectorXd moved = -second.partialPivLu().solve(*slope);
      if (!moved.allFinite() || moved.norm() > straight_) return std::nullopt;
      move(bounces_, moved);
      if (moved.norm() < close_enough) return chain();
      if (step % steps_between_derivatives == 0) {
        const auto derivatives = ray_derivatives();
        if (!derivatives) return std::nullopt;
        second = *derivatives;
      }
    }
    return std::nullopt;
  }

 private:
  using Positions = std::vector<Vector3d>;

  Vector3d node(const Positions& bounces, std::size_t k) const {
    return k == 0 ? Vector3d(Vector3d::Zero()) : k > bounces.size() ? position_ : bounces[k - 1];
  }
  double piece_length(std::size_t k) const { return (node(bounces_, k + 1) - node(bounces_, k)).norm(); }
  double straight_length() const {
    double sum = 0;
    for (std::size_t k = 0; k <= planes_.size(); ++k) sum += piece_length(k);
    return sum;
  }
  void move(Positions& bounces, const Eigen::VectorXd& by) const {
    for (std::size_t k = 0; k < bounces.size(); ++k)
      bounces[k] += tangents_[k] * by.segment<2>(2 * static_cast<Eigen::Index>(k));
  }
  std::optional<std::vector<RayPiece>> pieces(const Positions& bounces) const {
    std::vector<RayPiece> all;
    for (std::size_t k = 0; k <= bounces.size(); ++k) {
      const auto piece = rays_.between(node(bounces, k), node(bounces, k + 1));
      if (!piece) return std::nullopt;
      all.push_back(*piece);
    }
    return all;
  }

  /// First derivatives of the apparent length by the positions of the bounces on their planes.
  std::optional<Eigen::VectorXd> slopes(const Positions& bounces) const {
    const auto ray = pieces(bounces);
    if (!ray) return std::nullopt;
    Eigen::VectorXd slope(2 * bounces.size());
    for (std::size_t k = 0; k < bounces.size(); ++k)
      slope.segment<2>(2 * static_cast<Eigen::Index>(k)) =
          tangents_[k].transpose() * ((*ray)[k].arrives - (*ray)[k + 1].leaves) / rays_.relative_speed(bounces[k]);
    return slope;
  }

  /// Second derivatives of the length of straight pieces.
  Eigen::MatrixXd straight_derivatives() const {
    const auto n = static_cast<Eigen::Index>(planes_.size());
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    for (Eigen::Index k = 0; k <= n; ++k) {
      const auto piece = static_cast<std::size_t>(k);
      const Vector3d way = node(bounces_, piece + 1) - node(bounces_, piece), along = way.normalized();
      const Eigen::Matrix3d across_over_length = (Eigen::Matrix3d::Identity() - along * along.transpose()) / way.norm();
      for (const Eigen::Index i : {k - 1, k})
        for (const Eigen::Index j : {k - 1, k}) {
          if (std::min(i, j) < 0 || std::max(i, j) >= n) continue;
          second.block<2, 2>(2 * i, 2 * j) += (i == j ? 1 : -1) * tangents_[static_cast<std::size_t>(i)].transpose() *
                                              across_over_length * tangents_[static_cast<std::size_t>(j)];
        }
    }
    return second;
  }

  /// Returns the derivatives of the rays, or none where a piece has no ray.
  std::optional<Eigen::MatrixXd> ray_derivatives() const {
    double step = 0.05;
    for (std::size_t k = 0; k <= planes_.size(); ++k) step = std::min(step, 1e-2 * piece_length(k));
    const auto n = 2 * static_cast<Eigen::Index>(planes_.size());
    Eigen::MatrixXd second(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      Positions ahead = bounces_, behind = bounces_;
      move(ahead, step * Eigen::VectorXd::Unit(n, k)), move(behind, -step * Eigen::VectorXd::Unit(n, k));
      const auto there = slopes(ahead), here = slopes(behind);
      if (!there || !here) return std::nullopt;
      second.col(k) = (*there - *here) / (2 * step);
    }
    return second;
  }

  std::optional<RefractedChain> chain() const {
    const auto ray = pieces(bounces_);
    const auto second = ray_derivatives();
    if (!ray || !second) return std::nullopt;
    RefractedChain found;
    double apparent = 0, pressure = 1 / std::sqrt(std::abs(second->determinant()));
    for (std::size_t k = 0; k < ray->size(); ++k) {
      apparent += (*ray)[k].apparent;
      pressure *= (*ray)[k].pressure / piece_length(k);
      if (k == bounces_.size()) break;
      const double cosine = std::abs(planes_[k]->normal.dot((*ray)[k].arrives));
      pressure *= cosine / rays_.relative_speed(bounces_[k]);  // (E177)
      found.meets.push_back((*ray)[k].arrives);
    }
    found.sent = ray->front().leaves;
    found.leg = {apparent * found.sent, ray->back().arrives, std::min(apparent * pressure, std::sqrt(most_focusing))};
    found.bounces = bounces_;
    return found;
  }

  const RefractedLegs& rays_;
  std::span<const Boundary* const> planes_;
  Positions bounces_;
  Vector3d position_;
  std::vector<Tangents> tangents_;
  double straight_ = 0;
};

}  // namespace

double RefractedChain::grazing_on(const Boundary& plane, std::size_t k) const {
  return std::asin(std::min(1.0, std::abs(plane.normal.dot(meets[k]))));
}

std::optional<RefractedChain> refracted_chain(const RefractedLegs& rays, std::span<const Boundary* const> planes,
                                              std::vector<Vector3d> bounces, const Vector3d& position) {
  return ChainSearch(rays, planes, std::move(bounces), position).find();
}

}  // namespace insonify

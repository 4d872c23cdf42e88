// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>

#include "acoustics/shape_fits_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t most_neighbourhoods = 2000, neighbours_of_one = 24, terms_of_quadratic = 6;
constexpr double one_side = 0.5;  // cosine between the normals of a neighbourhood
constexpr double float_step = 0x1p-23, size_step = 2e-5;
constexpr double median_of_chi = 0.963;  // of the mean square of 18 normal numbers
constexpr int trims = 6;                 // fits, each without the surfels that stray from the one before

/// Returns the mean square residual, per degree of freedom, of the heights of points along `up` from their quadratic.
double left_by_quadratic(const std::vector<Vector3d>& points, const Vector3d& up) {
  const Vector3d right = up.unitOrthogonal(), ahead = up.cross(right);
  double size = 0;
  for (const Vector3d& p : points) size = std::max(size, p.norm());
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, Eigen::Dynamic, terms_of_quadratic> terms(rows, terms_of_quadratic);
  Eigen::VectorXd height(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Vector3d p = points[static_cast<std::size_t>(k)] / size;
    const double x = right.dot(p), y = ahead.dot(p);
    terms.row(k) << 1, x, y, x * x, x * y, y * y;
    height[k] = up.dot(p) * size;
  }
  const Eigen::ColPivHouseholderQR<decltype(terms)> fit(terms);
  return (height - terms * fit.solve(height)).squaredNorm() / static_cast<double>(rows - fit.rank());
}

/// A fit of nearly all members, from which those that stray farther than noise does are left out step by step.
/// `fit` makes a shape of a part, `off` gives the distance of a surfel. The surfels are empty if too few remain.
template <typename Fit, typename Off>
auto trimmed(const SurfelGroup& group, const SurfelNoise& noise, const Fit& fit, const Off& off) {
  SurfelGroup kept = group;
  auto shape = fit(kept);
  for (int turn = 0; turn < trims && shape; ++turn) {
    const double reach = std::max(noise.reach(), turn + 2 < trims ? 2.5 * std::sqrt(shape->mean_square) : 0);
    SurfelGroup nearer = group.where([&](auto s) { return std::abs(off(*shape, s)) <= reach; });
    const bool converged = nearer.members == kept.members;
    kept.members = std::move(nearer.members);
    if (converged && turn + 2 >= trims) break;
    if (kept.members.size() < fewest_surfels) return std::pair(decltype(shape){}, SurfelGroup{group.scene, {}});
    shape = fit(kept);
  }
  if (shape) kept.members = group.where([&](auto s) { return std::abs(off(*shape, s)) <= noise.reach(); }).members;
  return std::pair(shape, kept);
}

double mean_square_of(const SurfelGroup& group, const auto& residual) {
  double sum = 0;
  for (const std::uint32_t s : group.members) sum += group.scene.area[s] * std::pow(residual(s), 2);
  return sum / group.area();
}

/// Least squares of |x|^2 = 2 x . c + (r^2 - |c|^2) in the directions `across`.
template <int n>
RoundBody linear_round(const SurfelGroup& group, const Eigen::Matrix<double, 3, n>& across) {
  using Row = Eigen::Matrix<double, n + 1, 1>;
  Eigen::Matrix<double, n + 1, n + 1> left = Eigen::Matrix<double, n + 1, n + 1>::Zero();
  Row right = Row::Zero();
  const Vector3d middle = group.middle();
  for (const std::uint32_t s : group.members) {
    const Eigen::Matrix<double, n, 1> x = across.transpose() * (group.point(s) - middle);
    Row row;
    row << 2 * x, 1;
    left += group.scene.area[s] * row * row.transpose();
    right += group.scene.area[s] * x.squaredNorm() * row;
  }
  const Row found = left.ldlt().solve(right);
  RoundBody body;
  body.centre = middle + across * found.template head<n>();
  body.radius = std::sqrt(std::max(0.0, found[n] + found.template head<n>().squaredNorm()));
  return body;
}

/// Steps of Gauss and Newton from a body: its centre moves, its radius changes, and its axis turns.
void refine(const SurfelGroup& group, RoundBody& body) {
  constexpr int steps = 12;
  const bool turns = !body.axis.isZero();
  for (int step = 0; step < steps; ++step) {
    const Vector3d right = turns ? body.axis.unitOrthogonal() : Vector3d(1, 0, 0),
                   ahead = turns ? Vector3d(body.axis.cross(right)) : Vector3d(0, 1, 0);
    Eigen::Matrix<double, 5, 5> left = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> down = Eigen::Matrix<double, 5, 1>::Zero();
    for (const std::uint32_t s : group.members) {
      const Vector3d away = body.away(group.point(s));
      const double distance = away.norm();
      if (!(distance > 0)) continue;
      const Vector3d out = away / distance;
      const double along = body.axis.dot(group.point(s) - body.centre);
      Eigen::Matrix<double, 5, 1> slope;
      if (turns)
        slope << -out.dot(right), -out.dot(ahead), -1, -along * out.dot(right), -along * out.dot(ahead);
      else
        slope << -out, -1, 0;
      left += group.scene.area[s] * slope * slope.transpose();
      down -= group.scene.area[s] * (distance - body.radius) * slope;
    }
    if (!turns) left(4, 4) = 1;
    const Eigen::Matrix<double, 5, 1> by = left.ldlt().solve(down);
    if (!by.allFinite()) return;
    if (turns) {
      body.centre += by[0] * right + by[1] * ahead;
      body.radius += by[2];
      body.axis = (body.axis + by[3] * right + by[4] * ahead).normalized();
    } else {
      body.centre += by.head<3>();
      body.radius += by[3];
    }
    if (by.norm() < 1e-12 * std::abs(body.radius)) return;
  }
}

std::optional<RoundBody> fitted_round(const SurfelGroup& group, const Vector3d& axis) {
  RoundBody body;
  if (axis.isZero()) {
    body = linear_round<3>(group, Matrix3d::Identity());
  } else {
    const Vector3d right = axis.unitOrthogonal();
    body = linear_round<2>(group, (Eigen::Matrix<double, 3, 2>() << right, axis.cross(right)).finished());
    body.axis = axis;
  }
  refine(group, body);
  if (!(body.radius > 0) || !std::isfinite(body.radius) || !body.centre.allFinite()) return std::nullopt;
  body.mean_square = mean_square_of(group, [&](auto s) { return body.away(group.point(s)).norm() - body.radius; });
  return body;
}

/// Mean of the squared sines between the normals of surfels and those of a body, by area.
double turned_from(const SurfelGroup& group, const RoundBody& body) {
  return mean_square_of(group,
                        [&](auto s) { return group.normal(s).cross(body.away(group.point(s)).normalized()).norm(); });
}

/// The body of which the surfels are flat facets: their planes touch one body inside it, n . x = n . c + r, at most 17
/// degrees off its own normals. Its radius is the mean of the distances.
std::optional<RoundBody> body_of_facets(const SurfelGroup& group, const SurfelNoise& noise, const Vector3d& axis) {
  constexpr double steepest = 0.9563, along = 1e-4;
  RoundBody body;
  body.axis = axis;
  const Vector3d middle = group.middle();
  Eigen::Matrix4d left = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const std::uint32_t s : group.members) {
    const Vector3d n = group.normal(s) - axis * axis.dot(group.normal(s));
    const Eigen::Vector4d row(n.x(), n.y(), n.z(), 1);
    left += group.scene.area[s] * row * row.transpose();
    right += group.scene.area[s] * n.dot(group.point(s) - middle) * row;
  }
  left.topLeftCorner<3, 3>() += group.area() * axis * axis.transpose();  // nothing says where along the axis it is
  const Eigen::Vector4d found = left.ldlt().solve(right);
  body.centre = middle + found.head<3>();
  double flat = 0;
  for (const std::uint32_t s : group.members) {
    const Vector3d away = body.away(group.point(s));
    body.radius += group.scene.area[s] * away.norm() / group.area();
    if (group.normal(s).dot(away.normalized()) >= steepest) flat += group.scene.area[s];
  }
  const double off =
      mean_square_of(group, [&](auto s) { return group.normal(s).dot(body.away(group.point(s))) - found[3]; });
  const double tilted = mean_square_of(group, [&](auto s) { return group.normal(s).dot(axis); });
  if (tilted > along || flat < explained_share * group.area() || !noise.explains(off, effective_count(group)))
    return std::nullopt;
  body.mean_square = mean_square_of(group, [&](auto s) { return body.away(group.point(s)).norm() - body.radius; });
  return body;
}

/// The body of a mesh, whose facets have normals of their own, or those of the body, which they leave by no more than
/// facets of 17 degrees do.
std::optional<RoundBody> round_mesh(const SurfelGroup& group, const SurfelNoise& noise, const Vector3d& axis) {
  constexpr double same_normals = 1e-4, least_sagitta = 0.003;
  if (auto of_facets = body_of_facets(group, noise, axis)) return of_facets;
  const auto body = fitted_round(group, axis);
  const bool is_near = body && body->mean_square < std::pow(least_sagitta * body->radius, 2);
  return is_near && turned_from(group, *body) < same_normals ? body : std::nullopt;
}

}  // namespace

SurfelNoise noise_of(const SurfelGroup& group) {
  SurfelNoise noise;
  const Vector3d middle = group.middle();
  std::vector<Eigen::Vector3f> positions;
  Eigen::AlignedBox3d box;
  float largest = 0;
  for (const std::uint32_t s : group.members) {
    positions.push_back((group.point(s) - middle).cast<float>());
    box.extend(group.point(s));
    largest = std::max(largest, group.scene.point[s].cwiseAbs().maxCoeff());
  }
  noise.rounding = std::max(float_step * static_cast<double>(largest), size_step * box.diagonal().norm());
  if (positions.size() <= terms_of_quadratic + 8) return noise;

  const SceneIndex index(positions);
  std::vector<double> left;
  std::vector<Neighbour> nearest;
  for (std::size_t k = 0; k < positions.size(); k += 1 + positions.size() / most_neighbourhoods) {
    const Vector3d normal = group.normal(group.members[k]);
    index.find_nearest(positions[k], neighbours_of_one, nearest);
    std::vector<Vector3d> around;
    Vector3d up = Vector3d::Zero();
    for (const Neighbour& n : nearest) {
      const std::uint32_t s = group.members[n.index];
      if (group.normal(s).dot(normal) < one_side) continue;
      around.push_back(group.point(s) - group.point(group.members[k]));
      up += group.normal(s);
    }
    if (around.size() > terms_of_quadratic + 8) left.push_back(left_by_quadratic(around, up.normalized()));
  }
  if (left.empty()) return noise;
  const auto half = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2);
  std::nth_element(left.begin(), half, left.end());
  noise.deviation = std::sqrt(*half / median_of_chi);
  return noise;
}

double effective_count(const SurfelGroup& group) {
  double squares = 0;
  for (const std::uint32_t s : group.members) squares += std::pow(static_cast<double>(group.scene.area[s]), 2);
  return group.area() * group.area() / squares;
}

FittedPlane plane_through(const SurfelGroup& group) {
  const Vector3d middle = group.middle();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(
      group.moments([&](auto s) -> Vector3d { return group.point(s) - middle; }));
  Vector3d normal = axes.eigenvectors().col(0), side = Vector3d::Zero();
  for (const std::uint32_t s : group.members) side += group.scene.area[s] * group.normal(s);
  if (normal.dot(side) < 0) normal = -normal;
  return {middle, normal, std::max(0.0, axes.eigenvalues()[0])};
}

std::optional<std::pair<FittedPlane, SurfelGroup>> flat_group(const SurfelGroup& group, const SurfelNoise& noise) {
  if (group.members.size() < fewest_surfels) return std::nullopt;
  auto [plane, kept] = trimmed(
      group, noise, [](const SurfelGroup& some) { return std::optional(plane_through(some)); },
      [&](const FittedPlane& p, auto s) { return p.normal.dot(group.point(s) - p.position); });
  if (!plane || kept.members.size() < fewest_surfels) return std::nullopt;
  double facing = 0;
  for (const std::uint32_t s : kept.members) facing += group.scene.area[s] * group.normal(s).dot(plane->normal);
  if (facing < 0.5 * kept.area() || !noise.explains(plane->mean_square, effective_count(kept))) return std::nullopt;
  return std::pair(*plane, kept);
}

std::optional<RoundBody> round_body(const SurfelGroup& group, const SurfelNoise& noise, const Vector3d& axis) {
  if (group.members.size() < fewest_surfels) return std::nullopt;
  const auto off = [&](const RoundBody& b, auto s) { return b.away(group.point(s)).norm() - b.radius; };
  auto [body, kept] = trimmed(
      group, noise, [&](const SurfelGroup& some) { return fitted_round(some, axis); }, off);
  const bool smooth =
      body && kept.area() >= explained_share * group.area() && noise.explains(body->mean_square, effective_count(kept));
  if (!smooth) body = round_mesh(group, noise, axis);
  if (!body) return std::nullopt;
  double outward = 0;
  for (const std::uint32_t s : group.members)
    outward += group.scene.area[s] * group.normal(s).dot(body->away(group.point(s)).normalized());
  if (outward < 0.8 * group.area()) return std::nullopt;
  return body;
}

}  // namespace insonify

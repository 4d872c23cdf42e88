// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <Eigen/Geometry>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/sample_patches_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

// Returns the normal vector d/du x d/dv by central differences; its length is the area per unit of (u, v).
Vector3d area_vector(const Patch& patch, double u, double v) {
  constexpr double h = 1e-5;
  const Vector3d along_u = (patch.at(u + h, v) - patch.at(u - h, v)) / (2 * h);
  const Vector3d along_v = (patch.at(u, v + h) - patch.at(u, v - h)) / (2 * h);
  return (patch.flip ? -1.0 : 1.0) * along_u.cross(along_v);
}

// Returns the cumulative arc length along u at equal steps of u, averaged over several lines of constant v.
std::vector<double> length_along_u(const Patch& patch) {
  constexpr int lines = 8, steps = 1024;
  std::vector<double> length = {0.0};
  for (int i = 0; i < steps; ++i) {
    double sum = 0;
    for (int j = 0; j < lines; ++j) {
      const double v = (j + 0.5) / lines, u = static_cast<double>(i) / steps;
      sum += (patch.at(u + 1.0 / steps, v) - patch.at(u, v)).norm();
    }
    length.push_back(length.back() + sum / lines);
  }
  return length;
}

// Returns the edges in u of rows of equal arc length, also on surfaces that are steep across u.
std::vector<double> row_edges(const std::vector<double>& length, std::size_t rows) {
  std::vector<double> edges = {0.0};
  std::size_t step = 0;
  for (std::size_t r = 1; r < rows; ++r) {
    const double wanted = length.back() * static_cast<double>(r) / static_cast<double>(rows);
    while (length[step + 1] < wanted) ++step;
    const double part = (wanted - length[step]) / (length[step + 1] - length[step]);
    edges.push_back((static_cast<double>(step) + part) / static_cast<double>(length.size() - 1));
  }
  edges.push_back(1.0);
  return edges;
}

// Returns the areas of the rows between `edges`, by the midpoint rule.
std::vector<double> row_areas(const Patch& patch, const std::vector<double>& edges, int steps_v) {
  std::vector<double> areas(edges.size() - 1, 0.0);
  parallel_for(areas.size(), 0, [&](std::size_t r) {
    double sum = 0;
    for (int j = 0; j < steps_v; ++j)
      sum += area_vector(patch, (edges[r] + edges[r + 1]) / 2, (j + 0.5) / steps_v).norm();
    areas[r] = sum / steps_v * (edges[r + 1] - edges[r]);
  });
  return areas;
}

// One row of surfels, jittered across the row in u, with one surfel per equal interval of v.
struct Row {
  std::size_t first = 0, count = 0;  // index of the first surfel in the whole sample, and number of surfels
};

struct PatchSampler {
  const Patch& patch;
  std::size_t part;  // index of the patch, for the random counter
  std::uint64_t seed;

  void sample(SceneCloud& scene, std::size_t at, const Row& row, std::size_t index, double low, double high) const {
    for (std::size_t k = 0; k < row.count; ++k, ++at) {
      const auto jitter = random_uniform(seed, RandomStage::scene_points, {part, index, k});
      const double u = low + (high - low) * jitter[0];
      const double v = (static_cast<double>(k) + jitter[1]) / static_cast<double>(row.count);
      const Vector3d area = area_vector(patch, u, v);
      scene.point[at] = (patch.at(u, v) - scene.origin).cast<float>();
      scene.normal[at] = area.normalized().cast<float>();
      scene.area[at] = static_cast<float>(area.norm() * (high - low) / static_cast<double>(row.count));
      scene.material[at] = patch.material;
      scene.id[at] = static_cast<std::uint32_t>(row.first + k);
    }
  }
};

// Assigns a number of surfels to each row. Rounding the running sum `wanted`, not each row, keeps the total exact.
std::vector<Row> plan_rows(const std::vector<double>& row_area, double per_area, std::size_t first, double& wanted) {
  std::vector<Row> plan;
  for (const double area : row_area) {
    wanted += area * per_area;
    const std::size_t end = std::max(first + 1, static_cast<std::size_t>(std::llround(wanted)));
    plan.push_back({first, end - first});
    first = end;
  }
  return plan;
}

// Returns the factor that makes the areas of the jittered samples add up to the area of the patch.
float area_factor(double area, double sum) { return static_cast<float>(sum > 0 ? area / sum : 1); }

void resize(SceneCloud& scene, std::size_t surfels) {
  scene.point.resize(surfels);
  scene.normal.resize(surfels);
  scene.area.resize(surfels);
  scene.material.resize(surfels);
  scene.id.resize(surfels);
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// A patch and the rows of surfels that sample it.
struct PatchPlan {
  PatchSampler sampler;
  double area = 0;
  std::vector<double> edges;
  std::vector<Row> rows;

  std::size_t first() const { return rows.front().first; }
  std::size_t end() const { return rows.back().first + rows.back().count; }

  // Writes rows [begin, to) to the scene, the first of them at index `at`; areas are not yet scaled.
  void sample(SceneCloud& scene, std::size_t begin, std::size_t to, std::size_t at) const {
    parallel_for(to - begin, 0, [&](std::size_t k) {
      const Row& row = rows[begin + k];
      sampler.sample(scene, at + row.first - rows[begin].first, row, begin + k, edges[begin + k], edges[begin + k + 1]);
    });
  }
};

// Plans the rows of all patches; the first surfel gets number `first`.
std::vector<PatchPlan> plan_patches(const std::vector<Patch>& patches, std::size_t points, std::uint64_t seed,
                                    std::size_t first) {
  std::vector<std::vector<double>> length;
  std::vector<double> area;
  double weighted_area = 0;
  for (const Patch& patch : patches) {
    length.push_back(length_along_u(patch));
    area.push_back(sum_of(row_areas(patch, row_edges(length.back(), 256), 64)));
    weighted_area += patch.density * area.back();
  }

  std::vector<PatchPlan> plans;
  double wanted = static_cast<double>(first);
  for (std::size_t part = 0; part < patches.size(); ++part) {
    const Patch& patch = patches[part];
    const double per_area = static_cast<double>(points) * patch.density / weighted_area;
    const double rows = std::max(1.0, std::round(length[part].back() * std::sqrt(per_area)));
    const std::vector<double> edges = row_edges(length[part], static_cast<std::size_t>(rows));
    plans.push_back(
        {{patch, part, seed}, area[part], edges, plan_rows(row_areas(patch, edges, 16), per_area, first, wanted)});
    first = plans.back().end();
  }
  return plans;
}

// Calls body(begin, end) for consecutive runs of rows that hold about `batch` surfels each.
template <typename Body>
void for_runs_of_rows(const PatchPlan& plan, std::size_t batch, const Body& body) {
  for (std::size_t begin = 0, end = 0; begin < plan.rows.size(); begin = end) {
    for (std::size_t held = 0; end < plan.rows.size() && held < batch; ++end) held += plan.rows[end].count;
    body(begin, end);
  }
}

}  // namespace

void sample_patches(SceneCloud& scene, const std::vector<Patch>& patches, std::size_t points, std::uint64_t seed) {
  for (const PatchPlan& plan : plan_patches(patches, points, seed, scene.size())) {
    resize(scene, plan.end());
    plan.sample(scene, 0, plan.rows.size(), plan.first());
    const auto areas = std::span(scene.area).subspan(plan.first());
    const float factor = area_factor(plan.area, std::accumulate(areas.begin(), areas.end(), 0.0));
    for (float& a : areas) a *= factor;
  }
}

void sample_patches_in_batches(const SceneCloud& like, const std::vector<Patch>& patches, std::size_t points,
                               std::uint64_t seed, std::size_t batch,
                               const std::function<void(const SceneCloud&)>& consume) {
  SceneCloud part = like;
  const auto sample = [&](const PatchPlan& plan, std::size_t begin, std::size_t end) {
    resize(part, plan.rows[end - 1].first + plan.rows[end - 1].count - plan.rows[begin].first);
    plan.sample(part, begin, end, 0);
  };
  for (const PatchPlan& plan : plan_patches(patches, points, seed, 0)) {
    double sum = 0;
    for_runs_of_rows(plan, batch, [&](std::size_t begin, std::size_t end) {
      sample(plan, begin, end);
      sum = std::accumulate(part.area.begin(), part.area.end(), sum);
    });
    const float factor = area_factor(plan.area, sum);
    for_runs_of_rows(plan, batch, [&](std::size_t begin, std::size_t end) {
      sample(plan, begin, end);
      for (float& a : part.area) a *= factor;
      consume(part);
    });
  }
}

Patch facing_away_from(const Vector3d& inside, Patch patch) {
  if (area_vector(patch, 0.5, 0.5).dot(patch.at(0.5, 0.5) - inside) < 0) patch.flip = !patch.flip;
  return patch;
}

Patch rectangle(const Vector3d& corner, const Vector3d& edge_u, const Vector3d& edge_v) {
  return {[=](double u, double v) -> Vector3d { return corner + u * edge_u + v * edge_v; }};
}

Patch cylinder(const Vector3d& base, const Vector3d& axis, double radius) {
  const Vector3d a = axis.unitOrthogonal(), b = a.cross(axis.normalized());
  return {[=](double u, double v) -> Vector3d {
    return base + u * axis + radius * (std::cos(2 * pi * v) * a + std::sin(2 * pi * v) * b);
  }};
}

Patch ellipsoid(const Vector3d& centre, const Vector3d& radii) {
  return {[=](double u, double v) -> Vector3d {
    const Vector3d unit(std::sin(pi * u) * std::cos(2 * pi * v), std::sin(pi * u) * std::sin(2 * pi * v),
                        std::cos(pi * u));
    return centre + radii.cwiseProduct(unit);
  }};
}

Patch torus(const Vector3d& centre, double radius, double tube_radius) {
  return {[=](double u, double v) -> Vector3d {
    const double across = radius + tube_radius * std::cos(2 * pi * v);
    return centre +
           Vector3d(across * std::cos(2 * pi * u), across * std::sin(2 * pi * u), tube_radius * std::sin(2 * pi * v));
  }};
}

}  // namespace insonify

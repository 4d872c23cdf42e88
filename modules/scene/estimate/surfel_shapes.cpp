// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/parallel.hpp"
#include "scene/estimate/relief_fit_internal.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {

using namespace cells;

namespace {

constexpr double least_cosine = 0.1;           // between a surface and the plane on which its cells lie
constexpr double least_seen_cosine = 0.1;      // between a surface and the direction in which it was seen
constexpr std::size_t neighbours_fitted = 16;  // neighbours of a cubic, which has ten terms
constexpr std::size_t around = 17;             // points that decide together
constexpr std::size_t compared_cells = 20000;  // largest number of cells that decide whether a cloud was seen at once
constexpr double flat_chart = 100;             // rise of a neighbour on a chart, which has none but for rounding

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vector3f on_plan(const Vector3f& point) { return {point.x(), point.y(), 0}; }

// Points as seen from above.
struct Plan {
  std::vector<std::uint32_t> points;  // all points but those that hang alone over the others
  std::vector<std::uint8_t> single;   // 1 for each point of the cloud that belongs to a height field
};

// Finds height fields, which have one height at each position: none of the four links of a point to its neighbours is
// steeper than five to one, or at most a third of those around are. Surfaces one above the other have more.
Plan find_height_fields(const Estimate& e, int threads) {
  const std::vector<Vector3f>& points = e.position;
  constexpr std::size_t links = 4;
  std::vector<Vector3f> flat;
  for (const Vector3f& p : points) flat.push_back(on_plan(p));
  const SceneIndex index(flat);
  Plan plan;
  plan.single.resize(points.size());
  std::vector<std::uint8_t> steep(points.size()), hangs(points.size());
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      index.find_nearest(flat[i], links + 1, nearest);
      const auto steeper_than = [&](float slope) {
        return static_cast<std::size_t>(std::count_if(nearest.begin(), nearest.end(), [&](const Neighbour& n) {
          const float rise = points[n.index].z() - points[i].z();
          return rise * rise > slope * slope * n.squared_distance;
        }));
      };
      steep[i] = static_cast<std::uint8_t>(steeper_than(5));
      hangs[i] = steeper_than(16) >= links;
    }
  });
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      plan.single[i] = steep[i] == 0;
      if (plan.single[i] || hangs[i]) continue;
      index.find_nearest(flat[i], around, nearest);
      std::size_t sum = 0;
      for (const Neighbour& n : nearest) sum += steep[n.index];
      plan.single[i] = 3 * sum <= links * nearest.size();
    }
  });
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (!hangs[i]) plan.points.push_back(i);
  return plan;
}

// Shape of the surface around a point, as its neighbours show it.
struct Look {
  Vector3f frame;          // normal of the plane on which the cell lies
  Vector3f relief, plane;  // normals that follow the neighbours one by one, and all of them together
  double cell = 0;         // area on that plane [m^2]
  double left_by_relief = 0, left_by_plane = 0;  // mean square residuals [m^2]
  bool charted = false;                          // true: the cell lies on the plan of a height field
};

Look look_at(const AreaEstimator& estimator, std::size_t i, const Vector3f& frame, bool charted, Workspace& work) {
  Look look{frame, frame, frame};
  look.charted = charted;
  look.cell = estimator.area(i, frame, work);
  const Vector3d up = frame.cast<double>(), right = up.unitOrthogonal(), ahead = up.cross(right);
  const auto tilted = [&](const Vector2d& slope) -> Vector3f {
    return (up - slope.x() * right - slope.y() * ahead).normalized().cast<float>();
  };
  const Vector3d facet = AreaEstimator::facet_normal(work);
  if (facet.dot(up) >= least_cosine) look.relief = facet.cast<float>();
  if (work.neighbours.size() < neighbours_fitted) return look;
  const std::span<const FlatNeighbour> all(work.neighbours), near = all.first(neighbours_fitted);
  ReliefFit cubic = fit_relief<3>(near, up), flat = fit_relief<1>(near, up);
  if (!cubic.found) cubic = fit_relief<2>(all, up), flat = fit_relief<1>(all, up);  // for three lines of a scan
  if (!cubic.found) return look;
  look.left_by_relief = cubic.misfit;
  look.left_by_plane = flat.misfit;
  if (!charted) return look;
  if (work.gaps.empty()) look.relief = tilted(cubic.slope);
  look.plane = tilted(fit_relief<1>(all, up).slope);
  return look;
}

// Returns the shapes around all points: height fields on their plan, others on the base planes.
std::vector<Look> look_at_all(const Estimate& e, const std::vector<Vector3f>& base, const AreaEstimator& estimator,
                              const ShapeOptions& options) {
  std::vector<Look> looks(e.position.size());
  const Plan plan = find_height_fields(e, options.threads);
  std::vector<Vector3f> flat, raised;
  std::vector<std::uint32_t> in_plan(e.position.size());
  for (const std::uint32_t p : plan.points) {
    in_plan[p] = static_cast<std::uint32_t>(flat.size());
    raised.push_back(e.position[p]);
    flat.push_back(on_plan(e.position[p]));
  }
  const AreaEstimator chart(flat, raised, 2 * options.neighbours, flat_chart);
  parallel_blocks(e.visit.size(), 1024, options.threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      looks[i] = plan.single[i] ? look_at(chart, in_plan[i], Vector3f::UnitZ(), true, work)
                                : look_at(estimator, i, base[i], false, work);
    }
  });
  return looks;
}

// Returns the noise of the heights of height fields (E160), from the residuals of cubics. It is the lower quartile of
// all that are no larger than noise leaves, so that steps, objects and relief do not count. Zero if it is no more than
// the rounding of coordinates.
float height_noise_of(const std::vector<Look>& looks, const std::vector<Vector3f>& positions) {
  constexpr double most = 2;               // squares of noise: 95 % of chi^2 / 7 (17 points less ten terms) lie below
  constexpr double quarter_of = 0.5924;    // lower quartile of these residuals, in squares of noise
  constexpr double float_steps = 0x1p-22;  // four steps of the largest coordinate
  std::vector<double> left;
  float largest = 0;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    if (looks[i].charted) left.push_back(looks[i].left_by_relief);
    largest = std::max(largest, positions[i].cwiseAbs().maxCoeff());
  }
  double square = 0;
  for (int n = 0; n < 3 && !left.empty(); ++n) {
    const auto quarter = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 4);
    std::nth_element(left.begin(), quarter, left.end());
    square = *quarter / quarter_of;
    std::erase_if(left, [&](double l) { return l > most * square; });
  }
  return std::sqrt(square) > float_steps * largest ? static_cast<float>(std::sqrt(square)) : 0;
}

// Chooses the normal of the relief where a cubic leaves at most half of a plane's residual, which it does not for
// noise; otherwise that of the mean plane around. Projects the cell onto the surface (E69). Strays, whose cells are far
// larger than those around, get the area that is typical there unless `keep_strays`.
void choose_shapes(const std::vector<Look>& looks, const SceneIndex& index, const ShapeOptions& options, Estimate& e,
                   std::vector<Vector3f>& normals, SurfelShapes& counts) {
  constexpr double far_larger = 16;
  std::atomic<std::size_t> strays{0}, height_field{0}, heights{0};
  const float noise = height_noise_of(looks, e.position);
  counts.height_noise.assign(looks.size(), 0);
  parallel_blocks(looks.size(), 1024, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    std::vector<double> by_relief, by_plane, cells;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      const Look& look = looks[i];
      index.find_nearest(e.position[i], around, nearest);
      by_relief.clear(), by_plane.clear(), cells.clear();
      Vector3f mean = Vector3f::Zero();
      for (const Neighbour& n : nearest) {
        const Look& other = looks[n.index];
        by_relief.push_back(other.left_by_relief), by_plane.push_back(other.left_by_plane), cells.push_back(other.cell);
        mean += other.plane.dot(look.plane) < 0 ? Vector3f(-other.plane) : other.plane;
      }
      const bool relief = 2 * median_of(by_relief) <= median_of(by_plane);
      height_field += look.charted && relief;
      heights += look.charted;
      if (look.charted && !relief) counts.height_noise[i] = noise;
      const Vector3f found = relief ? look.relief : mean.normalized();
      normals[i] = found.dot(normals[i]) < 0 ? Vector3f(-found) : found;
      e.area[i] = look.cell / std::max<double>(least_cosine, std::abs(found.dot(look.frame)));
      const double typical = median_of(cells);
      if (!(look.cell > far_larger * typical)) continue;
      ++strays;
      if (!options.keep_strays) e.area[i] = typical;
    }
  });
  counts.strays = strays;
  counts.height_field = height_field;
  counts.heights = heights;
}

// Estimates the shapes of points whose lines of sight are unknown.
void estimate_around(const ShapeOptions& options, Estimate& e, std::vector<Vector3f>& normals, SurfelShapes& counts) {
  const AreaEstimator estimator(e.position, 2 * options.neighbours, same_rough_sheet);
  choose_shapes(look_at_all(e, normals, estimator, options), estimator.index(), options, e, normals, counts);
}

// Returns the areas of the Voronoi cells of every `step`th of `neighbours`, unit vectors or points of a plan, with the
// tangent planes' normals `up`.
std::vector<double> cells_among(const AreaEstimator& estimator, const std::vector<Vector3f>& up, std::size_t step,
                                int threads) {
  std::vector<double> cells(up.size() / step);
  parallel_blocks(cells.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t i = begin; i < end; ++i) cells[i] = estimator.area(i * step, up[i * step], work);
  });
  return cells;
}

// Returns the median deviation from the median, over the median.
double spread_of(std::vector<double> cells) {
  const double typical = median_of(cells);
  for (double& cell : cells) cell = std::abs(cell - typical);
  return typical > 0 ? median_of(cells) / typical : 0;
}

// Estimates the areas of points that were all seen from one position by their cells among the directions from there (E73).
// Returns false if the cells are not `evenness` times as even there as on the plan: the cloud is a raster of heights,
// or was not seen at once.
bool estimate_seen(const Vector3d& viewpoint, double evenness, const std::vector<Vector3f>& normals,
                   const AreaOptions& options, Estimate& e) {
  std::vector<Vector3f> direction, flat;
  for (const Vector3f& p : e.position) {
    direction.push_back((p.cast<double>() - viewpoint).normalized().cast<float>());
    flat.push_back(on_plan(p));
  }
  const std::vector<Vector3f> up(flat.size(), Vector3f::UnitZ());
  const AreaEstimator seen(direction, direction, options.neighbours, flat_chart);
  const AreaEstimator charted(flat, flat, options.neighbours, flat_chart);
  const std::size_t step = 1 + flat.size() / compared_cells;
  if (spread_of(cells_among(charted, up, step, options.threads)) <
      evenness * spread_of(cells_among(seen, direction, step, options.threads)))
    return false;
  const std::vector<double> solid_angles = cells_among(seen, direction, 1, options.threads);
  for (std::size_t i = 0; i < e.area.size(); ++i) {
    const double cosine = std::max<double>(least_seen_cosine, std::abs(normals[i].dot(direction[i])));
    e.area[i] = solid_angles[i] * (e.position[i].cast<double>() - viewpoint).squaredNorm() / cosine;
  }
  return true;
}

}  // namespace

SurfelShapes estimate_surfel_shapes(std::span<const Vector3f> points, std::span<const Vector3f> base_normals,
                                    const ShapeOptions& options) {
  const AreaOptions area_options{options.neighbours, options.threads};
  require_valid(points, base_normals, area_options, "estimate_surfel_shapes");
  SurfelShapes shapes{{base_normals.begin(), base_normals.end()}, std::vector<float>(points.size(), 0.0f)};
  if (points.size() < 4) return shapes;
  Estimate e = distinct_points(points);
  std::vector<Vector3f> normals;
  for (const std::uint32_t first : e.distinct.first) normals.push_back(base_normals[first]);
  if (!options.viewpoint || !estimate_seen(*options.viewpoint, options.evenness_of_view, normals, area_options, e))
    estimate_around(options, e, normals, shapes);
  limit_cells(e.area);
  shapes.area = shared_areas(e, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) shapes.normal[i] = normals[e.distinct.position[i]];
  if (shapes.height_noise.empty()) return shapes;
  std::vector<float> noise;
  for (const std::uint32_t distinct : e.distinct.position) noise.push_back(shapes.height_noise[distinct]);
  shapes.height_noise = std::move(noise);
  return shapes;
}

}  // namespace insonify

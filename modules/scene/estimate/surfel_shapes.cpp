// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "scene/estimate/distinct_points_internal.hpp"
#include "scene/estimate/height_fields_internal.hpp"
#include "scene/estimate/relief_fit_internal.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"
#include "scene/estimate/surfel_noise.hpp"
#include "scene/estimate/surfel_noise_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {

using namespace cells;

namespace {

constexpr double least_cosine = 0.1;           // between a surface and the plane on which its cells lie
constexpr double least_seen_cosine = 0.1;      // between a surface and the direction in which it was seen
constexpr std::size_t neighbours_fitted = 16;  // neighbours of a cubic, which has ten terms
constexpr std::size_t compared_cells = 20000;  // largest number of cells that decide whether a cloud was seen at once
constexpr double flat_chart = 100;             // rise of a neighbour on a chart, which has none but for rounding

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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
  const auto of_near = relief_sums<3>(near, up);
  ReliefFit cubic = fit_relief<3>(of_near), flat = fit_relief<1>(of_near);
  if (!cubic.found) {  // for three lines of a scan
    const auto of_all = relief_sums<2>(all, up);
    cubic = fit_relief<2>(of_all), flat = fit_relief<1>(of_all);
  }
  if (!cubic.found) return look;
  look.left_by_relief = cubic.misfit;
  look.left_by_plane = flat.misfit;
  if (!charted) return look;
  if (work.gaps.empty()) look.relief = tilted(cubic.slope);
  look.plane = tilted(fit_relief<1>(relief_sums<1>(all, up)).slope);
  return look;
}

// Sets the base normals of points outside of height fields.
void find_base(const Estimate& e, const Plan& plan, const ShapeOptions& options, std::vector<Vector3f>& base) {
  std::vector<std::uint32_t> places, wanted;
  for (std::uint32_t i = 0; i < base.size(); ++i)
    if (!plan.single[i]) places.push_back(i), wanted.push_back(e.distinct.first[i]);
  if (wanted.empty()) return;
  const std::vector<Vector3f> found = options.base(wanted);
  for (std::size_t k = 0; k < found.size(); ++k) base[places[k]] = found[k];
}

// Returns the shapes around all points: height fields on their plan, others on the base planes.
std::vector<Look> look_at_all(const Estimate& e, std::vector<Vector3f>& base, const AreaEstimator& estimator,
                              const ShapeOptions& options) {
  std::vector<Look> looks(e.position.size());
  std::vector<Vector3f> flat = plan_of(e.position), raised = e.position;
  std::optional<AreaEstimator> chart(std::in_place, flat, raised, 2 * options.neighbours, flat_chart);
  const Plan plan = find_height_fields(e, flat, chart->index(), options.threads);
  if (options.base) find_base(e, plan, options, base);
  std::vector<std::uint32_t> in_plan(e.position.size());
  for (std::size_t k = 0; k < plan.points.size(); ++k) in_plan[plan.points[k]] = static_cast<std::uint32_t>(k);
  if (plan.points.size() < flat.size()) {  // what hangs over them is no neighbour of the others
    for (std::size_t k = 0; k < plan.points.size(); ++k)
      flat[k] = flat[plan.points[k]], raised[k] = raised[plan.points[k]];
    flat.resize(plan.points.size()), raised.resize(plan.points.size());
    chart.emplace(flat, raised, 2 * options.neighbours, flat_chart);
  }
  parallel_blocks(e.visit.size(), 1024, options.threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      looks[i] = plan.single[i] ? look_at(*chart, in_plan[i], Vector3f::UnitZ(), true, work)
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
  if (options.noise) counts.noise.assign(looks.size(), 0);
  parallel_blocks(looks.size(), 1024, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    std::vector<double> by_relief, by_plane, cells, distance;
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
      if (options.noise && std::ssize(nearest) > noise_neighbours)
        counts.noise[i] =
            static_cast<float>(spread_about_plane(e.position, std::span(nearest).first(noise_neighbours), distance));
      // The median is typical of them: it is far smaller if more than half are.
      const auto smaller = static_cast<std::size_t>(
          std::count_if(cells.begin(), cells.end(), [&](double cell) { return look.cell > far_larger * cell; }));
      if (smaller <= cells.size() / 2) continue;
      ++strays;
      if (!options.keep_strays) e.area[i] = median_of(cells);
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
  const std::vector<Vector3f> flat = plan_of(e.position);
  std::vector<Vector3f> direction;
  for (const Vector3f& p : e.position) {
    direction.push_back((p.cast<double>() - viewpoint).normalized().cast<float>());
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
  SurfelShapes shapes{{base_normals.begin(), base_normals.end()}, std::vector<float>(points.size(), 0.0f)};
  if (options.base) shapes.normal.resize(points.size(), Vector3f::UnitZ());
  require_valid(points, shapes.normal, area_options, "estimate_surfel_shapes");
  if (points.size() < 4) {
    if (options.base && !points.empty()) shapes.normal = options.base(all_of(points.size()));
    if (options.noise) shapes.noise.assign(points.size(), 0);
    return shapes;
  }
  Estimate e = distinct_points(points);
  std::vector<Vector3f> normals;
  for (const std::uint32_t first : e.distinct.first) normals.push_back(shapes.normal[first]);
  if (!options.viewpoint || !estimate_seen(*options.viewpoint, options.evenness_of_view, normals, area_options, e))
    estimate_around(options, e, normals, shapes);
  limit_cells(e.area);
  shapes.area = shared_areas(e, points.size());
  if (options.noise && (shapes.noise.empty() || e.position.size() < points.size()))  // copies count as neighbours
    shapes.noise = estimate_surfel_noise(points, {.threads = options.threads});
  else if (options.noise)
    shapes.noise = at_points(shapes.noise, e);
  for (std::size_t i = 0; i < points.size(); ++i) shapes.normal[i] = normals[e.distinct.position[i]];
  if (!shapes.height_noise.empty()) shapes.height_noise = at_points(shapes.height_noise, e);
  return shapes;
}

}  // namespace insonify

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/parallel.hpp"
#include "scene/surfel_area.hpp"
#include "scene/surfel_cell_internal.hpp"

namespace insonify {

using namespace cells;

namespace {

using Eigen::Matrix3d;

// Mean square distance of the first `count` neighbours from their plane.
double square_distance_from_plane(std::span<const Vector3f> points, const std::vector<Neighbour>& nearest,
                                  std::size_t count) {
  count = std::min(count, nearest.size());
  if (count < 4) return 0;
  Vector3d mean = Vector3d::Zero();
  for (std::size_t k = 0; k < count; ++k) mean += points[nearest[k].index].cast<double>();
  mean /= static_cast<double>(count);
  Matrix3d moments = Matrix3d::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3d offset = points[nearest[k].index].cast<double>() - mean;
    moments += offset * offset.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(moments, Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues()[0]) / static_cast<double>(count - 3);
}

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Whether relief, not noise, takes the points about each one off their plane: noise is as large among 9 as among 33
// neighbours, relief grows with the distance. What a line through both variances leaves for no distance at all is noise.
std::vector<std::uint8_t> find_clean(std::span<const Vector3f> points, const SceneIndex& index, int threads) {
  constexpr std::size_t few = 9, many = 33;
  std::vector<double> small(points.size()), large(points.size());
  std::vector<std::uint8_t> clean(points.size());
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t i = begin; i < end; ++i) {
      index.find_nearest(points[i], many, nearest);
      small[i] = square_distance_from_plane(points, nearest, few);
      large[i] = square_distance_from_plane(points, nearest, many);
    }
  });
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    std::vector<double> of_few, of_many;
    for (std::size_t i = begin; i < end; ++i) {
      index.find_nearest(points[i], many, nearest);
      of_few.clear(), of_many.clear();
      for (const Neighbour& n : nearest) of_few.push_back(small[n.index]), of_many.push_back(large[n.index]);
      const double near = median_of(of_few), wide = median_of(of_many);
      clean[i] = 2 * near - wide <= 0.25 * near;
    }
  });
  return clean;
}

// Points whose cell is far larger than those around them take their neighbours' area; returns how many.
std::size_t bound_strays(const SceneIndex& index, std::span<const Vector3f> points, std::vector<double>& areas,
                         int threads) {
  constexpr std::size_t around = 17;
  constexpr double far_larger = 16;
  std::vector<double> bounded = areas;
  std::vector<std::uint8_t> stray(areas.size(), 0);
  parallel_blocks(areas.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    std::vector<double> others;
    for (std::size_t i = begin; i < end; ++i) {
      index.find_nearest(points[i], around, nearest);
      others.clear();
      for (const Neighbour& n : nearest) others.push_back(areas[n.index]);
      const double typical = median_of(others);
      stray[i] = areas[i] > far_larger * typical;
      if (stray[i]) bounded[i] = typical;
    }
  });
  areas = std::move(bounded);
  return static_cast<std::size_t>(std::count(stray.begin(), stray.end(), 1));
}

}  // namespace

SurfelShapes estimate_surfel_shapes(std::span<const Vector3f> points, std::span<const Vector3f> base_normals,
                                    const AreaOptions& options) {
  require_valid(points, base_normals, options, "estimate_surfel_shapes");
  SurfelShapes shapes{{base_normals.begin(), base_normals.end()}, std::vector<float>(points.size(), 0.0f), 0};
  if (points.size() < 4) return shapes;
  constexpr double least_cosine = 0.1;  // between a facet and its base plane
  Estimate e = distinct_points(points);
  std::vector<Vector3f> normals;
  for (const std::uint32_t first : e.distinct.first) normals.push_back(base_normals[first]);
  const AreaEstimator estimator(e.position, 2 * options.neighbours, same_rough_sheet);
  const std::vector<std::uint8_t> clean = find_clean(e.position, estimator.index(), options.threads);
  parallel_blocks(e.area.size(), 4096, options.threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t d = begin; d < end; ++d) {
      e.area[d] = estimator.area(d, normals[d], work);
      if (!clean[d]) continue;
      // The cell on the base plane, on the facets (E68).
      const Vector3d facet = AreaEstimator::facet_normal(work), base = normals[d].cast<double>();
      const double cosine = facet.dot(base);
      if (!(cosine >= least_cosine)) continue;
      e.area[d] /= cosine;
      normals[d] = facet.cast<float>();
    }
  });
  limit_cells(e.area);
  shapes.strays = bound_strays(estimator.index(), e.position, e.area, options.threads);
  shapes.area = shared_areas(e, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) shapes.normal[i] = normals[e.distinct.position[i]];
  return shapes;
}

}  // namespace insonify

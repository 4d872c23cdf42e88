// SPDX-License-Identifier: BSD-3-Clause
// Effect of surfels on ways by mirrors and targets: all surfels are tested against all ways, those of one body at once
// if possible.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "acoustics/image_paths_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t surfels_of_a_test = 4096;
constexpr double most_covered = 2;  // distance of a surfel from the position that it covers, in its spacings

/// Effect of surfels on ways: they block them, or cover the position at which a target reflects.
class SurfelTests {
 public:
  SurfelTests(const SceneCloud& scene, const View& view, const std::vector<ImagePath>& paths)
      : scene_(scene), to_head_(view.world_from_head.inverse()), footprint_(view.sampling.footprint), paths_(paths) {
    for (std::size_t first = 0, end; first < paths.size(); first = end) {
      for (end = first + 1; end < paths.size() && of_one_body(paths[first], paths[end]);) ++end;
      bundles_.push_back(bundle_of(first, end));
    }
  }

  std::vector<std::uint8_t> unblocked_paths(bool occlusion, int threads) const {
    std::vector<std::atomic<std::uint8_t>> blocked(paths_.size()), covered(paths_.size());
    parallel_blocks(scene_.size(), surfels_of_a_test, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        const Vector3d p = to_head_ * (scene_.origin + scene_.point[s].cast<double>());
        const Vector3d n = to_head_.linear() * scene_.normal[s].cast<double>();
        for (const Bundle& bundle : bundles_) {
          if (is_beside(bundle, s, p)) continue;
          for (std::size_t w = bundle.first; w < bundle.end; ++w) {
            if (occlusion && !blocked[w] && blocks(paths_[w], s, p, n)) blocked[w] = 1;
            if (paths_[w].target && !covered[w] && covers(paths_[w], s, p)) covered[w] = 1;
          }
        }
      }
    });
    std::vector<std::uint8_t> open(paths_.size());
    for (std::size_t w = 0; w < paths_.size(); ++w) open[w] = !blocked[w] && (!paths_[w].target || covered[w]);
    return open;
  }

 private:
  /// Ways of one body, next to each other in the list: straight to its places and back, near one line.
  struct Bundle {
    std::size_t first, end;
    Vector3d middle = Vector3d::Zero();  ///< middle of the positions
    double radius = -1;  ///< radius of the legs about the line to the middle [m]; < 0: one way by several places
  };

  static bool of_one_body(const ImagePath& a, const ImagePath& b) {
    return a.bounces.size() == 1 && b.bounces.size() == 1 && a.target == b.target && a.by == b.by;
  }
  Bundle bundle_of(std::size_t first, std::size_t end) const {
    Bundle bundle{first, end};
    if (paths_[first].bounces.size() != 1) return bundle;
    bundle.radius = 0;
    for (std::size_t w = first; w < end; ++w) bundle.middle += paths_[w].bounces[0] / static_cast<double>(end - first);
    for (std::size_t w = first; w < end; ++w)
      bundle.radius = std::max(bundle.radius, (paths_[w].bounces[0] - bundle.middle).norm());
    return bundle;
  }

  /// Returns true if a surfel is too far from a bundle to block or cover any of its ways.
  bool is_beside(const Bundle& bundle, std::size_t s, const Vector3d& p) const {
    if (bundle.radius < 0) return false;
    const double share = std::clamp(p.dot(bundle.middle) / bundle.middle.squaredNorm(), 0.0, 1.0);
    const double reach = std::max(footprint_, most_covered) * std::sqrt(scene_.area[s]) + bundle.radius;
    return (p - share * bundle.middle).squaredNorm() > reach * reach;
  }

  bool covers(const ImagePath& path, std::size_t s, const Vector3d& p) const {
    return scene_.material[s] == path.target->material &&
           (p - path.bounces[0]).squaredNorm() < most_covered * most_covered * scene_.area[s];
  }

  bool blocks(const ImagePath& path, std::size_t s, const Vector3d& p, const Vector3d& n) const {
    for (const Boundary* mirror : path.by)
      if (mirror->holds(mirror->distance(p), mirror->normal.dot(n))) return false;
    const double reach_2 = footprint_ * footprint_ * scene_.area[s];
    Vector3d from = Vector3d::Zero();
    // A way by one bounce returns as it went out.
    const std::size_t legs = path.bounces.size() == 1 ? 1 : path.bounces.size() + 1;
    for (std::size_t k = 0; k < legs; ++k) {
      const Vector3d to = k < path.bounces.size() ? path.bounces[k] : Vector3d::Zero(), leg = to - from;
      const double fall = n.dot(leg), share = n.dot(p - from) / fall;
      // Its own surface does not hide a target.
      const double margin = path.target ? 2 * path.target->surface.thickness / leg.norm() : 1e-9;
      if (share > margin && share < 1 - margin && (from + share * leg - p).squaredNorm() < reach_2) return true;
      from = to;
    }
    return false;
  }

  const SceneCloud& scene_;
  Pose to_head_;
  double footprint_;
  const std::vector<ImagePath>& paths_;
  std::vector<Bundle> bundles_;
};

}  // namespace

std::vector<std::uint8_t> unblocked_paths(const SceneCloud& scene, const View& view,
                                          const std::vector<ImagePath>& paths, int threads) {
  return SurfelTests(scene, view, paths).unblocked_paths(view.sampling.occlusion, threads);
}

}  // namespace insonify

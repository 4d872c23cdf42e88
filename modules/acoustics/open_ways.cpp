// SPDX-License-Identifier: BSD-3-Clause
// Effect of surfels on ways by mirrors and targets: all surfels are tested against all ways, those of one body at once
// if possible.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "acoustics/image_ways_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t surfels_of_a_test = 4096;
constexpr double most_covered = 2;  // distance of a surfel from the place that it covers, in its spacings

/// Effect of surfels on ways: they block them, or cover the place at which a target reflects.
class SurfelTests {
 public:
  SurfelTests(const SceneCloud& scene, const View& view, const std::vector<ImageWay>& ways)
      : scene_(scene), to_head_(view.world_from_head.inverse()), footprint_(view.sampling.footprint), ways_(ways) {
    for (std::size_t first = 0, end; first < ways.size(); first = end) {
      for (end = first + 1; end < ways.size() && of_one_body(ways[first], ways[end]);) ++end;
      bundles_.push_back(bundle_of(first, end));
    }
  }

  /// Which ways surfels leave open.
  std::vector<std::uint8_t> open_ways(bool occlusion, int threads) const {
    std::vector<std::atomic<std::uint8_t>> blocked(ways_.size()), covered(ways_.size());
    parallel_blocks(scene_.size(), surfels_of_a_test, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        const Vector3d p = to_head_ * (scene_.origin + scene_.point[s].cast<double>());
        const Vector3d n = to_head_.linear() * scene_.normal[s].cast<double>();
        for (const Bundle& bundle : bundles_) {
          if (is_beside(bundle, s, p)) continue;
          for (std::size_t w = bundle.first; w < bundle.end; ++w) {
            if (occlusion && !blocked[w] && blocks(ways_[w], s, p, n)) blocked[w] = 1;
            if (ways_[w].target && !covered[w] && covers(ways_[w], s, p)) covered[w] = 1;
          }
        }
      }
    });
    std::vector<std::uint8_t> open(ways_.size());
    for (std::size_t w = 0; w < ways_.size(); ++w) open[w] = !blocked[w] && (!ways_[w].target || covered[w]);
    return open;
  }

 private:
  /// Ways of one body, next to each other in the list: straight to its places and back, near one line.
  struct Bundle {
    std::size_t first, end;
    Vector3d middle = Vector3d::Zero();  ///< middle of the places
    double radius = -1;  ///< radius of the legs about the line to the middle [m]; < 0: one way by several places
  };

  static bool of_one_body(const ImageWay& a, const ImageWay& b) {
    return a.bounces.size() == 1 && b.bounces.size() == 1 && a.target == b.target && a.by == b.by;
  }
  Bundle bundle_of(std::size_t first, std::size_t end) const {
    Bundle bundle{first, end};
    if (ways_[first].bounces.size() != 1) return bundle;
    bundle.radius = 0;
    for (std::size_t w = first; w < end; ++w) bundle.middle += ways_[w].bounces[0] / static_cast<double>(end - first);
    for (std::size_t w = first; w < end; ++w)
      bundle.radius = std::max(bundle.radius, (ways_[w].bounces[0] - bundle.middle).norm());
    return bundle;
  }

  /// Returns true if a surfel is too far from a bundle to block or cover any of its ways.
  bool is_beside(const Bundle& bundle, std::size_t s, const Vector3d& p) const {
    if (bundle.radius < 0) return false;
    const double part = std::clamp(p.dot(bundle.middle) / bundle.middle.squaredNorm(), 0.0, 1.0);
    const double reach = std::max(footprint_, most_covered) * std::sqrt(scene_.area[s]) + bundle.radius;
    return (p - part * bundle.middle).squaredNorm() > reach * reach;
  }

  bool covers(const ImageWay& way, std::size_t s, const Vector3d& p) const {
    return scene_.material[s] == way.target->material &&
           (p - way.bounces[0]).squaredNorm() < most_covered * most_covered * scene_.area[s];
  }

  bool blocks(const ImageWay& way, std::size_t s, const Vector3d& p, const Vector3d& n) const {
    for (const Boundary* mirror : way.by)
      if (mirror->holds(mirror->distance(p), mirror->normal.dot(n))) return false;
    const double reach_2 = footprint_ * footprint_ * scene_.area[s];
    Vector3d from = Vector3d::Zero();
    // A way by one bounce returns as it went out.
    const std::size_t legs = way.bounces.size() == 1 ? 1 : way.bounces.size() + 1;
    for (std::size_t k = 0; k < legs; ++k) {
      const Vector3d to = k < way.bounces.size() ? way.bounces[k] : Vector3d::Zero(), leg = to - from;
      const double fall = n.dot(leg), part = n.dot(p - from) / fall;
      // Its own surface does not hide a target.
      const double margin = way.target ? 2 * way.target->surface.thickness / leg.norm() : 1e-9;
      if (part > margin && part < 1 - margin && (from + part * leg - p).squaredNorm() < reach_2) return true;
      from = to;
    }
    return false;
  }

  const SceneCloud& scene_;
  Pose to_head_;
  double footprint_;
  const std::vector<ImageWay>& ways_;
  std::vector<Bundle> bundles_;
};

}  // namespace

std::vector<std::uint8_t> open_ways(const SceneCloud& scene, const View& view, const std::vector<ImageWay>& ways,
                                    int threads) {
  return SurfelTests(scene, view, ways).open_ways(view.sampling.occlusion, threads);
}

}  // namespace insonify

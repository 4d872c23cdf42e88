// SPDX-License-Identifier: BSD-3-Clause
// A way by mirrors is straight in the space that unfolds at each of them: behind the first everything stands mirrored in
// it, behind the second also in that, and so on.
#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "acoustics/edge_waves_internal.hpp"
#include "acoustics/image_paths_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using Chain = std::vector<const Boundary*>;  // mirrors one after the other

constexpr double same_position = 1e-6;  // [m]
constexpr double far = 1e6;
const ConvexPolygon everything = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};

/// The image of a position in mirrors [first, last) one after the other, the last one first.
Vector3d image(const Chain& chain, std::size_t first, std::size_t last, Vector3d position) {
  for (std::size_t k = last; k > first; --k) position = chain[k - 1]->mirrored(position);
  return position;
}

/// The aperture that the mirrors of a chain leave of a straight way, in Fresnel parameters.
class Aperture {
 public:
  Aperture(const Chain& chain, const Vector3d& end) : chain_(chain), end_(end) {}

  /// Cuts it by the edges of mirror k, which the way crosses where `crossing` says. False if nothing is left.
  bool cut_by(std::size_t k, double crossing) {
    std::vector<Vector3d> corners = chain_[k]->corners;
    for (Vector3d& corner : corners) corner = image(chain_, 0, k, corner);
    if (!corners.empty()) {
      open_ = clipped(open_, counterclockwise(fresnel_corners(corners, end_, crossing, chain_[k]->wavenumber)));
      has_edges_ = true;
    }
    // It counts in front of those that come before and after it.
    if (k > 0) cut_in_front(k, *chain_[k - 1]);
    if (k + 1 < chain_.size()) cut_in_front(k, *chain_[k + 1]);
    return !open_.empty();
  }
  std::complex<double> factor() const { return has_edges_ ? aperture_factor(open_) : 1; }

 private:
  /// Cuts it by the line in which mirror k meets another one: at the depth at which the way passes the line, so that
  /// both orders of the two cut it there, from either side.
  void cut_in_front(std::size_t k, const Boundary& other) {
    const Boundary& mirror = *chain_[k];
    const Vector3d line = mirror.normal.cross(other.normal);
    if (line.norm() < 1e-9) return;
    Eigen::Matrix3d planes;
    planes << mirror.normal.transpose(), other.normal.transpose(), line.transpose();
    const Vector3d on_both = planes.inverse() * Vector3d(-mirror.head_distance, -other.head_distance, 0);
    const Vector3d inside = on_both + other.normal - other.normal.dot(mirror.normal) * mirror.normal;
    const Vector3d position = image(chain_, 0, k, on_both), edge = image(chain_, 0, k, on_both + line) - position;
    const Vector3d ahead = end_.normalized();
    Vector3d inward = ahead.cross(edge);
    if (inward.norm() < 1e-9 * edge.norm()) return;
    inward.normalize();
    if (inward.dot(image(chain_, 0, k, inside) - position) < 0) inward = -inward;
    const Vector3d across = edge - ahead.dot(edge) * ahead;
    const double passed = ahead.dot(position) - ahead.dot(edge) * across.dot(position) / across.squaredNorm();
    const double length = end_.norm(), crossing = std::clamp(passed / length, 1e-3, 1 - 1e-3);
    open_ = clipped(open_, across_way(end_).transpose() * inward,
                    fresnel_scale(length, crossing, mirror.wavenumber) * inward.dot(position));
    has_edges_ = true;
  }

  const Chain& chain_;
  Vector3d end_;
  ConvexPolygon open_ = everything;
  bool has_edges_ = false;
};

bool find_path(const Chain& chain, ImagePath& path) {
  const Vector3d head = Vector3d::Zero();
  const std::size_t n = chain.size();
  path.outgoing = image(chain, 0, n, head);
  path.returning = image({chain.rbegin(), chain.rend()}, 0, n, head);
  if (path.outgoing.norm() < same_position) return false;
  Aperture aperture(chain, path.outgoing);
  double reached = 0;
  Vector3d at = head;
  for (std::size_t k = 0; k < n; ++k) {
    // From the last bounce towards the image of the head in the mirrors that are left.
    const Vector3d ahead = image(chain, k, n, head) - at;
    const double from = chain[k]->distance(at), fall = -chain[k]->normal.dot(ahead), share = from / fall;
    const double crossing = reached + share * (1 - reached);
    if (!(fall > 0 && crossing > 0 && crossing < 1) || !aperture.cut_by(k, crossing)) return false;
    path.factor *= chain[k]->reflection(std::asin(std::min(1.0, fall / ahead.norm())));
    path.bounces.push_back(at += share * ahead);
    reached = crossing;
  }
  path.factor *= aperture.factor();
  path.by = chain;
  return std::norm(path.factor) >= echo_floor * echo_floor;
}

/// The ways by one mirror with edges: by its specular point, its edges and its corners.
void add_paths_of_plate(const Boundary& plate, std::vector<ImagePath>& paths) {
  for (const BodyArrival& arrival : plate_arrivals(plate.corners, plate.normal, plate.wavenumber)) {
    const Vector3d image = 2 * arrival.apparent;
    ImagePath path{image, image, arrival.factor, {arrival.position}, {&plate}};
    path.rise = arrival.rise, path.least = edge_floor;
    path.scale(plate.reflection(arrival.grazing));
    if (std::norm(path.factor) >= edge_floor * edge_floor) paths.push_back(std::move(path));
  }
}

void add_paths(std::span<const Boundary> mirrors, std::size_t first, int most, Chain& chain, bool counts,
               std::vector<ImagePath>& paths) {
  for (std::size_t m = 0; m < mirrors.size() && most > 0; ++m) {
    if (!chain.empty() && chain.back() == &mirrors[m]) continue;
    chain.push_back(&mirrors[m]);
    const bool with_it = counts || m >= first;
    ImagePath path;
    if (with_it && chain.size() == 1 && !mirrors[m].corners.empty())
      add_paths_of_plate(mirrors[m], paths);
    else if (with_it && find_path(chain, path))
      paths.push_back(std::move(path));
    add_paths(mirrors, first, most - 1, chain, with_it, paths);
    chain.pop_back();
  }
}

}  // namespace

std::vector<ImagePath> image_paths(std::span<const Boundary> mirrors, std::size_t first, int most) {
  std::vector<ImagePath> paths;
  Chain chain;
  add_paths(mirrors, first, most, chain, false, paths);
  return paths;
}

}  // namespace insonify

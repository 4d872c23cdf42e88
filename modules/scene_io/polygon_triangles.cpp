// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"
#include "scene/polygon_cut.hpp"
#include "scene_io/raw_cloud_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double most_off_plane = 0.01;  // share of the size of a polygon

/// Polygons with one defect.
struct DefectivePolygons {
  std::size_t count = 0;
  Vector3d first = Vector3d::Zero();

  void add(const RawCloud& raw, const Vector3d& corner) {
    if (++count == 1) first = raw.origin + corner;
  }
  void note(RawCloud& raw, const std::string& what) const {
    if (count == 0) return;
    raw.notes.push_back(std::to_string(count) + (count == 1 ? " polygon " : " polygons ") + what +
                        printed(", the first at (%.2f, %.2f, %.2f) m", first.x(), first.y(), first.z()) +
                        ": triangulate the mesh in the program that made it");
  }
};

}  // namespace

void add_polygon(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices) {
  ++raw.triangles_in_file;
  const bool good = corners.size() >= 3 && std::all_of(corners.begin(), corners.end(), [&](std::int64_t c) {
                      return c >= 0 && static_cast<std::size_t>(c) < vertices;
                    });
  if (!good) {
    ++raw.bad_triangles;
    return;
  }
  raw.triangles_in_file += corners.size() - 3;
  if (corners.size() > 3) raw.polygon.push_back({raw.triangle.size(), corners.size() - 2});
  for (std::size_t i = 2; i < corners.size(); ++i)
    raw.triangle.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[i - 1]),
                            static_cast<std::uint32_t>(corners[i])});
}

void add_strip(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) begin = i + 1;
    if (i < begin + 2) continue;
    const std::int64_t a = corners[i - 2], b = corners[i - 1], c = corners[i];
    if (a == b || b == c || c == a) continue;
    (i - begin) % 2 == 0 ? add_polygon(raw, {a, b, c}, vertices) : add_polygon(raw, {a, c, b}, vertices);
  }
}

void cut_polygons(RawCloud& raw) {
  std::size_t tests_left = (std::size_t{1} << 28) + 100 * raw.triangle.size();  // one second, and most polygons
  DefectivePolygons warped, crossed;
  std::vector<std::uint32_t> ids;
  std::vector<Vector3d> corners;
  for (const auto& [first, triangles] : raw.polygon) {
    const auto fan = raw.triangle.begin() + static_cast<std::ptrdiff_t>(first);
    ids = {fan[0][0], fan[0][1]}, corners.clear();
    for (auto t = fan; t < fan + static_cast<std::ptrdiff_t>(triangles); ++t) ids.push_back((*t)[2]);
    for (const std::uint32_t id : ids) corners.push_back(raw.point[id].cast<double>());
    const PolygonCut cut = cut_polygon(corners, tests_left);
    if (tests_left == 0)
      fail(ErrorKind::content, raw.path, ": a polygon of ", ids.size(),
           " corners takes too long to cut into triangles; triangulate the mesh in the program that made it");
    if (cut.off_plane > most_off_plane) warped.add(raw, corners[0]);
    if (cut.crosses) crossed.add(raw, corners[0]);
    std::transform(cut.ears.begin(), cut.ears.end(), fan, [&](const std::array<int, 3>& t) {
      return std::array<std::uint32_t, 3>{ids[t[0]], ids[t[1]], ids[t[2]]};
    });
  }
  warped.note(raw, "with corners off the plane by more than 1 % of the size");
  crossed.note(raw, "whose edges cross, read as triangles from the first corner");
}

}  // namespace insonify

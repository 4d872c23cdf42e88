// SPDX-License-Identifier: BSD-3-Clause
// Tests polygons of meshes: their triangles cover them once, whatever their shape and the format of the file.
#include <numeric>
#include <random>

#include "scene_io/test_files.hpp"

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Polygon = std::vector<Vector2d>;

/// Returns the area by Gauss's formula, which counts areas to the left of the edges as positive.
double area_within(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

/// Returns true if a ray from the point crosses the edges an odd number of times.
bool is_inside(const Vector2d& p, const Polygon& polygon) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

/// Returns the corners of polygons, one after another, in a plane of some slope.
std::vector<Vector3d> corners_in_space(const std::vector<Polygon>& polygons, double slope = 0.25) {
  std::vector<Vector3d> corners;
  for (const Polygon& polygon : polygons)
    for (const Vector2d& p : polygon) corners.emplace_back(p.x(), p.y(), slope * p.x() - 5);
  return corners;
}

/// Returns a mesh of these polygons in a format.
std::string mesh_text(const std::string& extension, const std::vector<Polygon>& polygons, double slope = 0.25) {
  std::ostringstream points, faces;
  points.precision(17);
  std::size_t first = extension == ".obj" ? 1 : 0, count = 0;
  for (const Vector3d& p : corners_in_space(polygons, slope)) {
    points << (extension == ".obj" ? "v " : "") << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    ++count;
  }
  for (const Polygon& polygon : polygons) {
    faces << (extension == ".obj" ? "f" : std::to_string(polygon.size()));
    for (std::size_t i = 0; i < polygon.size(); ++i) faces << ' ' << first + i;
    faces << '\n';
    first += polygon.size();
  }
  const std::string number = std::to_string(count), polys = std::to_string(polygons.size());
  if (extension == ".obj") return points.str() + faces.str();
  if (extension == ".ply")
    return "ply\nformat ascii 1.0\nelement vertex " + number +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " + polys +
           "\nproperty list int int vertex_indices\nend_header\n" + points.str() + faces.str();
  return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS " + number + " double\n" + points.str() +
         "POLYGONS " + polys + " " + std::to_string(count + polygons.size()) + "\n" + faces.str();
}

LoadedScene load_polygons(const std::vector<Polygon>& polygons, const std::string& extension = ".obj",
                          double slope = 0.25) {
  return load_scene(own_file("a" + extension, mesh_text(extension, polygons, slope)));
}

/// Expects the mesh to have the area of the polygons; with `each`, no triangle lies outside them.
void expect_covered(const std::vector<Polygon>& polygons, const LoadedScene& loaded, double slope = 0.25,
                    bool each = true) {
  ASSERT_TRUE(loaded.mesh);
  double area = 0;
  for (const Polygon& polygon : polygons) area += std::hypot(1.0, slope) * area_within(polygon);
  EXPECT_NEAR(area_of_mesh(loaded), area, 1e-6 * area);
  for (std::size_t t = 0; each && t < loaded.mesh->triangle.size(); ++t) {
    const auto corners = corners_of(*loaded.mesh, t);
    const Vector3d middle = loaded.mesh->origin + (corners[0] + corners[1] + corners[2]) / 3;
    const bool covered = std::any_of(polygons.begin(), polygons.end(),
                                     [&](const Polygon& polygon) { return is_inside(middle.head<2>(), polygon); });
    EXPECT_TRUE(covered || area_of(corners) < 1e-6 * area) << middle.transpose();
    EXPECT_GE((corners[1] - corners[0]).cross(corners[2] - corners[0]).z(), -1e-6);
  }
}

/// Returns a tower of teeth, each of four corners.
Polygon comb(int teeth) {
  Polygon corners = {{0.0, -1.0}, {1.0 * teeth, -1.0}};
  for (int i = teeth - 1; i >= 0; --i)
    for (const Vector2d& p : Polygon{{i + 1.0, 0}, {i + 1.0, 20}, {i + 0.5, 20}, {i + 0.5, 0}}) corners.push_back(p);
  return corners;
}

/// Returns a star of rays of random length about the origin.
Polygon star(int rays, std::mt19937& random) {
  Polygon corners;
  std::uniform_real_distribution<double> length(1, 2);
  for (int i = 0; i < rays; ++i)
    corners.push_back(length(random) * Eigen::Rotation2Dd(2 * M_PI * i / rays).toRotationMatrix().col(0));
  return corners;
}

bool cross(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/// Returns random points in a random order, in which crossing edges are reversed until none is left.
Polygon tangle_free(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> position(0, 10);
  Polygon p;
  for (int i = 0; i < n; ++i) p.emplace_back(position(random), position(random));
  for (bool crossing = true; crossing;) {
    crossing = false;
    for (int i = 0; i < n; ++i)
      for (int j = i + 2; j < n; ++j)
        if (cross(p[i], p[i + 1], p[j], p[(j + 1) % n])) {
          std::reverse(p.begin() + i + 1, p.begin() + j + 1);
          crossing = true;
        }
  }
  double twice = 0;
  for (int i = 0; i < n; ++i) twice += p[i].x() * p[(i + 1) % n].y() - p[i].y() * p[(i + 1) % n].x();
  if (twice < 0) std::reverse(p.begin(), p.end());
  return p;
}

const Polygon slip = {{0, 0}, {6, 0}, {6, 5}, {4, 5}, {4, 1}, {2, 1}, {2, 5}, {0, 5}};
const Polygon arrow = {{4, -2}, {1, 0}, {4, 2}, {0, 0}};

}  // namespace

TEST(Polygons, concave_ones_have_their_area_in_every_format) {
  for (const char* extension : {".obj", ".ply", ".vtk"}) {
    SCOPED_TRACE(extension);
    const LoadedScene loaded = load_polygons({slip}, extension, 0);
    EXPECT_EQ(loaded.mesh->triangle.size(), 6U);
    EXPECT_NEAR(total_area(loaded.scene), 6 * 5 - 2 * 4, 1e-4);
    expect_covered({slip}, loaded, 0);
    expect_covered({arrow}, load_polygons({arrow}, extension));
    EXPECT_NEAR(area_within(arrow), 0.5 * 4 * 4 - 0.5 * 4 * 3, 1e-9);
  }
}

TEST(Polygons, convex_ones_are_fans_from_their_first_corner) {
  Polygon circle;
  for (int i = 0; i < 12; ++i) circle.emplace_back(std::cos(M_PI * i / 6), std::sin(M_PI * i / 6));
  circle.insert(circle.begin() + 1, 0.5 * (circle[0] + circle[1]));  // on an edge
  const LoadedScene loaded = load_polygons({circle});
  std::vector<std::array<std::uint32_t, 3>> fan;
  for (std::uint32_t i = 3; i < 13; ++i) fan.push_back({0, i - 1, i});  // (0, 1, 2) has no area
  EXPECT_EQ(loaded.mesh->triangle, fan);
  EXPECT_TRUE(loaded.report.notes.empty() || !has_note(loaded.report, "polygon"));
}

TEST(Polygons, of_any_shape_are_covered_once) {
  std::mt19937 random(1);
  std::vector<Polygon> polygons;
  for (int k = 0; k < 60; ++k) {
    polygons.push_back(k % 2 == 0 ? star(4 + k, random) : tangle_free(4 + k / 2, random));
    for (Vector2d& p : polygons.back()) p += Vector2d(30.0 * (k % 8), 30.0 * (k / 8));
  }
  const LoadedScene loaded = load_polygons(polygons, ".ply");
  expect_covered(polygons, loaded);
  EXPECT_FALSE(has_note(loaded.report, "polygon"));
}

TEST(Polygons, with_holes_collinear_and_repeated_corners_keep_their_area) {
  // A square with a square hole, which two coincident edges join to its first corner.
  const Polygon holed = {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
  EXPECT_NEAR(area_within(holed), 36 - 4, 1e-9);
  Polygon split;  // the slip, with the middles of its edges, and each corner twice
  for (std::size_t i = 0; i < slip.size(); ++i)
    for (const double part : {0.0, 0.0, 0.25, 0.5}) split.push_back(slip[i] + part * (slip[(i + 1) % 8] - slip[i]));
  // Two squares that share a corner.
  const Polygon pinched = {{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}};
  // Two holes along one cut.
  const Polygon two = {{0, 0}, {9, 0}, {9, 3}, {0, 3}, {0, 1}, {2, 1}, {2, 2}, {3, 2}, {3, 1},
                       {5, 1}, {5, 2}, {6, 2}, {6, 1}, {5, 1}, {3, 1}, {2, 1}, {0, 1}};
  EXPECT_NEAR(area_within(two), 27 - 2, 1e-9);
  std::vector<Polygon> polygons;  // from each of their corners on
  for (const Polygon& polygon : {holed, split, pinched, two})
    for (std::size_t first = 0; first < polygon.size(); ++first) {
      polygons.push_back(polygon);
      std::rotate(polygons.back().begin(), polygons.back().begin() + static_cast<int>(first), polygons.back().end());
      for (Vector2d& p : polygons.back()) p += Vector2d(16.0 * static_cast<double>(polygons.size()), 0);
    }
  const LoadedScene loaded = load_polygons(polygons);
  expect_covered(polygons, loaded);
  EXPECT_FALSE(has_note(loaded.report, "polygon"));
}

// The number of tests of corners is limited: a cutter whose time grows as the square of the corners fails.
TEST(Polygons, of_many_corners_are_cut) {
  std::mt19937 random(1);
  for (const Polygon& polygon : {comb(5000), star(20000, random)})
    expect_covered({polygon}, load_polygons({polygon}), 0.25, false);
}

TEST(Polygons, whose_edges_cross_are_noted_with_number_and_place) {
  const Polygon bow = {{1, 1}, {3, 3}, {3, 1}, {1, 4}}, even = {{1, 1}, {3, 3}, {3, 1}, {1, 3}},
                spike = {{0, 0}, {4, 0}, {4, 2}, {2.1, 2}, {2, -1}, {1.9, 2}, {0, 2}};
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) pentagram.emplace_back(std::cos(0.8 * M_PI * i), std::sin(0.8 * M_PI * i));
  for (const Polygon& polygon : {bow, even, spike, pentagram})
    EXPECT_TRUE(has_note(load_polygons({polygon}).report, "1 polygon whose edges cross"));
  const LoadedScene loaded = load_polygons({slip, bow, spike}, ".vtk", 0);
  EXPECT_TRUE(has_note(loaded.report, "2 polygons whose edges cross"));
  EXPECT_TRUE(has_note(loaded.report, "the first at (1.00, 1.00, -5.00) m"));
}

TEST(Polygons, with_a_corner_that_is_nowhere_keep_their_other_triangles) {
  for (const char* corner : {"nan 5 0", "1e308 5 0", "1e10 5 0"})
    for (int first = 0; first < 8; ++first) {
      std::string text, face = "f";
      for (int i = 0; i < 8; ++i)
        text += i == 3 ? "v " + std::string(corner) + "\n"
                       : "v " + std::to_string(slip[i].x()) + " " + std::to_string(slip[i].y()) + " 0\n";
      for (int i = 0; i < 8; ++i) face += " " + std::to_string((first + i) % 8 + 1);
      const std::string path = own_file("a.obj", text + face + "\nf 1 2 3\n");
      EXPECT_GE(area_of_mesh(load_scene(path)), 0.5 * 6 * 5) << corner << first;
    }
}

TEST(Polygons, off_their_plane_are_noted_with_number_and_place) {
  // A square whose corners lie off their plane by a height in turn; its box has a diagonal of 1.41 m.
  const auto notes = [](double height) {
    const std::string z = std::to_string(height), below = std::to_string(-height);
    return load_scene(own_file("a.obj", "v 2 0 " + z + "\nv 3 0 " + below + "\nv 3 1 " + z + "\nv 2 1 " + below +
                                            "\nf 1 2 3 4\n"))
        .report;
  };
  EXPECT_TRUE(has_note(notes(0.016), "1 polygon with corners off the plane by more than 1 %"));
  EXPECT_TRUE(has_note(notes(0.016), "the first at (2.00, 0.00, 0.02) m"));
  EXPECT_FALSE(has_note(notes(0.012), "polygon"));
}

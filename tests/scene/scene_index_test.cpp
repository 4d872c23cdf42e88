// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_index.hpp"

#include "core/parallel.hpp"
#include "support/test.hpp"

using Eigen::Vector3f;

namespace {

constexpr unsigned seed = 20240611;

struct PointSet {
  const char* name;
  std::function<std::vector<Vector3f>()> make;
};

std::vector<Vector3f> generate(std::size_t n, const std::function<Vector3f(std::mt19937&)>& draw) {
  std::mt19937 random(seed);
  std::vector<Vector3f> points(n);
  for (Vector3f& p : points) p = draw(random);
  return points;
}

float uniform(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

Vector3f anywhere(std::mt19937& r, float size) {
  return {uniform(r, -size, size), uniform(r, -size, size), uniform(r, -size, size)};
}

std::vector<PointSet> point_sets() {
  return {
      {"uniform", [] { return generate(2000, [](std::mt19937& r) { return anywhere(r, 1); }); }},
      {"wide", [] { return generate(1000, [](std::mt19937& r) { return anywhere(r, 1e5f); }); }},
      {"two clusters",
       [] {
         return generate(2000, [](std::mt19937& r) {
           return Vector3f(anywhere(r, 0.01f) + Vector3f::Constant(r() % 2 ? 5.f : -5.f));
         });
       }},
      {"directions",
       [] { return generate(2000, [](std::mt19937& r) { return Vector3f(anywhere(r, 1).normalized()); }); }},
      {"lattice",
       [] {
         std::vector<Vector3f> points;
         for (int i = 0; i < 12 * 12 * 12; ++i) points.emplace_back(i % 12, i / 12 % 12, i / 144);
         return points;
       }},
      {"duplicates",
       [] { return generate(1500, [](std::mt19937& r) { return Vector3f(static_cast<float>(r() % 3), 1, 2); }); }},
      {"one point",
       [] {
         return std::vector<Vector3f>{{1, 2, 3}};
       }},
  };
}

std::vector<Neighbour> all_distances(const std::vector<Vector3f>& points, const Vector3f& query) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vector3f d = query - points[i];
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis) sum += d[axis] * d[axis];
    all.push_back({i, sum});
  }
  std::sort(all.begin(), all.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.squared_distance < b.squared_distance; });
  return all;
}

std::vector<std::uint32_t> sorted_indices(const std::vector<Neighbour>& neighbours) {
  std::vector<std::uint32_t> indices;
  for (const Neighbour& n : neighbours) indices.push_back(n.index);
  std::sort(indices.begin(), indices.end());
  return indices;
}

}  // namespace

TEST(SceneIndex, finds_the_nearest_as_brute_force_does) {
  for (const PointSet& set : point_sets()) {
    const std::vector<Vector3f> points = set.make();
    const SceneIndex index(points);
    std::vector<Neighbour> found;
    for (std::size_t q = 0; q < 60; ++q) {
      const Vector3f query = points[q * 37 % points.size()] * (q % 2 ? 1.0f : 1.01f);
      const auto expected = all_distances(points, query);
      for (const std::size_t k : {std::size_t{1}, std::size_t{9}, points.size() + 5}) {
        index.find_nearest(query, k, found);
        ASSERT_EQ(found.size(), std::min(k, points.size())) << set.name;
        for (std::size_t i = 0; i < found.size(); ++i)
          ASSERT_EQ(found[i].squared_distance, expected[i].squared_distance) << set.name << ", neighbour " << i;
      }
    }
  }
}

TEST(SceneIndex, finds_all_within_a_radius_as_brute_force_does) {
  for (const PointSet& set : point_sets()) {
    const std::vector<Vector3f> points = set.make();
    const SceneIndex index(points);
    std::vector<Neighbour> found;
    for (std::size_t q = 0; q < 60; ++q) {
      const Vector3f query = points[q * 31 % points.size()];
      for (const float radius : {1e-4f, 0.1f, 1.0f, 3.0f, 1e5f}) {
        index.find_within(query, radius, found);
        std::vector<Neighbour> expected = all_distances(points, query);
        std::erase_if(expected, [&](const Neighbour& n) { return !(n.squared_distance < radius * radius); });
        ASSERT_EQ(sorted_indices(found), sorted_indices(expected)) << set.name << ", radius " << radius;
      }
    }
  }
}

TEST(SceneIndex, of_nothing_finds_nothing) {
  const SceneIndex index(std::span<const Vector3f>{});
  std::vector<Neighbour> found(3);
  index.find_nearest({0, 0, 0}, 4, found);
  EXPECT_TRUE(found.empty());
  index.find_within({0, 0, 0}, 4, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(index.size(), 0u);
}

TEST(SceneIndex, keeps_its_own_copy_of_the_points) {
  std::vector<Vector3f> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  SceneIndex index(points);
  points.assign(3, Vector3f(9, 9, 9));
  const SceneIndex moved = std::move(index);
  std::vector<Neighbour> found;
  moved.find_nearest({1.9f, 0, 0}, 1, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].index, 2u);
}

TEST(SceneIndex, answers_several_threads_at_once) {
  const std::vector<Vector3f> points = point_sets()[0].make();
  const SceneIndex index(points);
  std::vector<int> wrong(points.size(), 0);
  parallel_for(points.size(), 7, [&](std::size_t i) {
    std::vector<Neighbour> found;
    index.find_nearest(points[i], 1, found);
    wrong[i] = found[0].index != i;
  });
  EXPECT_EQ(std::count(wrong.begin(), wrong.end(), 1), 0);
}

TEST(SceneIndex, refuses_points_that_are_not_finite) {
  const std::vector<Vector3f> points = {{0, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}};
  EXPECT_THROW(SceneIndex{points}, Error);
}

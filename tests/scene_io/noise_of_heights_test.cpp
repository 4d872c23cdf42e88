// SPDX-License-Identifier: BSD-3-Clause
// Smooths rasters and clouds with objects on them: noise goes, and all else stays where the file has it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "support/errors.hpp"
#include "support/files.hpp"
#include "support/rough_field.hpp"

using namespace insonify;

namespace {

struct Drawing {
  double noise = 0;    // standard deviation of the heights [m]
  double cell = 0.25;  // [m]
  double off = 0;      // largest distance of points from their grid, in cells to either side
  Eigen::Vector2d slope = {0, 0};
  double level = -10;  // [m]
  int side = 70;       // cells
  unsigned seed = 1;
};

// Height over the sloping bed [m] at a position [cells].
using Shape = std::function<double(const Eigen::Vector2d&)>;

struct Heights {
  std::vector<Eigen::Vector3d> file;  // heights in the file, with noise
  std::vector<double> truth, over;    // heights without noise; over the bed
};

Heights draw_heights(const Drawing& d, const Shape& shape) {
  std::mt19937 random(d.seed);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> off(-d.off, d.off);
  Heights heights;
  for (int j = 0; j < d.side; ++j)
    for (int i = 0; i < d.side; ++i) {
      const Eigen::Vector2d cells(i + off(random), j + off(random)), position = d.cell * cells;
      heights.over.push_back(shape({i, j}));
      heights.truth.push_back(d.level + d.slope.dot(position) + heights.over.back());
      heights.file.emplace_back(position.x(), position.y(), heights.truth.back() + d.noise * noise(random));
    }
  return heights;
}

// Returns boxes, turned or not, and pits: 1 to 16 cells wide, 0.2 to 8 m high or deep.
Shape objects(int count, const Drawing& d, double lowest = 0.2, double highest = 8) {
  struct Box {
    Eigen::Vector2d middle, half;
    double turned, height;
  };
  std::mt19937 random(d.seed + 100);
  std::uniform_real_distribution<double> unit;
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  std::vector<Box> boxes;
  for (int n = 0; n < count; ++n) {
    const Eigen::Vector2d middle(std::floor(between(0, d.side)), std::floor(between(0, d.side)));
    const Eigen::Vector2d half(between(0.5, 8), between(0.5, 8));
    boxes.push_back({middle, n % 3 ? half : half.cwiseMin(0.5), n % 2 ? between(0, pi) : 0,
                     (n % 4 ? 1 : -1) * between(lowest, highest)});
  }
  return [boxes](const Eigen::Vector2d& p) {
    double height = 0;
    for (const Box& b : boxes) {
      const Eigen::Vector2d from = Eigen::Rotation2Dd(-b.turned) * (p - b.middle);
      if ((from.cwiseAbs().array() <= b.half.array()).all()) height = b.height;
    }
    return height;
  };
}

// Returns the distance of the surface from each height of the file [m].
std::vector<double> moved(const LoadedScene& loaded, const Heights& heights, double unit = 1) {
  const std::vector<Eigen::Vector3f>& points = loaded.mesh ? loaded.mesh->point : loaded.scene.point;
  EXPECT_EQ(points.size(), heights.file.size());
  std::vector<double> by;
  for (std::size_t i = 0; i < points.size(); ++i)
    by.push_back(loaded.scene.origin.z() + points[i].z() - unit * heights.file[i].z());
  return by;
}

double farthest(const std::vector<double>& moved) {
  double most = 0;
  for (const double by : moved) most = std::max(most, std::abs(by));
  return most;
}

// Returns the rms error of the heights over that in the file, where the bed is bare for five cells around.
double left_of_noise(const std::vector<double>& moved, const Heights& heights, const Drawing& d) {
  double before = 0, after = 0;
  for (int j = 5; j < d.side - 5; ++j)
    for (int i = 5; i < d.side - 5; ++i) {
      const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * d.side + x); };
      bool bare = true;
      for (int y = j - 5; y <= j + 5; ++y)
        for (int x = i - 5; x <= i + 5; ++x) bare = bare && heights.over[at(x, y)] == heights.over[at(i, j)];
      if (!bare) continue;
      const double off = heights.file[at(i, j)].z() - heights.truth[at(i, j)];
      before += off * off, after += std::pow(off + moved[at(i, j)], 2);
    }
  return std::sqrt(after / before);
}

LoadOptions with_noise(std::optional<double> noise, double unit = 1) {
  LoadOptions options;
  options.scan_noise = noise;
  options.meaning.unit = unit;
  return options;
}

LoadedScene load_heights(const Heights& heights, const LoadOptions& options = {}) {
  return load_scene(own_file("heights.xyz", text_of(heights.file)), options);
}

// Expects that no height is moved by more than noise may have moved it.
void expect_kept(const Drawing& d, const Shape& shape) {
  const Heights heights = draw_heights(d, shape);
  EXPECT_LE(farthest(moved(load_heights(heights), heights)), 3 * d.noise + 0.001);
}

std::string note_of_noise(const LoadedScene& loaded) {
  for (const std::string& note : loaded.report.notes)
    if (note.find("show noise") != std::string::npos) return note;
  return {};
}

const Shape bare = [](const Eigen::Vector2d&) { return 0.0; };

}  // namespace

TEST(NoiseOfHeights, is_taken_from_the_bed_and_not_from_what_stands_on_it) {
  unsigned seed = 0;
  for (const double noise : {0.0, 0.01, 0.03})
    for (const double degrees : {0.0, 20.0, 45.0}) {
      const Eigen::Vector2d down(std::cos(seed), std::sin(seed));
      const Drawing d{.noise = noise, .slope = std::tan(radians(degrees)) * down, .seed = ++seed};
      const Heights heights = draw_heights(d, objects(23, d));
      const std::vector<double> by = moved(load_heights(heights), heights);
      EXPECT_LE(farthest(by), 3 * noise + 0.001) << noise << " m on " << degrees << " degrees";
      if (noise > 0) {
        EXPECT_LT(left_of_noise(by, heights, d), 0.4) << noise << " m on " << degrees << " degrees";
      }
    }
}

TEST(NoiseOfHeights, leaves_low_objects_pipes_quays_and_terraces) {
  const Drawing d{.noise = 0.02, .slope = {0.05, 0.02}, .side = 48};
  expect_kept(d, objects(10, d, 0.05, 0.3));
  for (const double degrees : {0.0, 31.0, 45.0}) {
    const Eigen::Vector2d across(std::cos(radians(degrees)), std::sin(radians(degrees)));
    const auto ahead = [=](const Eigen::Vector2d& p) { return across.dot(p - Eigen::Vector2d(24.3, 24)); };
    expect_kept(d, [=](const Eigen::Vector2d& p) { return ahead(p) > 0 ? 12.0 : 0.0; });
    expect_kept(d, [=](const Eigen::Vector2d& p) { return 0.4 * std::floor(ahead(p) / 9); });
    expect_kept(d, [=](const Eigen::Vector2d& p) { return std::sqrt(std::max(0.0, 1 - std::pow(ahead(p) / 4, 2))); });
  }
}

TEST(NoiseOfHeights, is_found_in_cells_and_levels_of_any_size_and_off_a_grid) {
  const Drawing drawings[] = {{.noise = 0.002, .cell = 0.01, .side = 48},
                              {.noise = 0.3, .cell = 10, .side = 48},
                              {.noise = 0.02, .slope = {0.3, 0}, .level = 1e4, .side = 48},
                              {.noise = 0.02, .off = 0.4, .side = 48},
                              {.noise = 0.05, .cell = 2, .off = 0.4, .slope = {0.7, 0.7}, .side = 48}};
  for (const Drawing& d : drawings) {
    const Heights heights = draw_heights(d, objects(6, d, 8 * d.noise, 16 * d.cell));
    const std::vector<double> by = moved(load_heights(heights), heights);
    EXPECT_LE(farthest(by), 3 * d.noise + 0.001) << d.cell;
    EXPECT_LT(left_of_noise(by, heights, d), 0.5) << d.cell;
  }
  const Drawing millimetres{.noise = 20, .cell = 250, .level = -1e4, .side = 48};
  const Heights heights = draw_heights(millimetres, objects(6, millimetres, 200, 8000));
  EXPECT_LE(farthest(moved(load_heights(heights, with_noise({}, 0.001)), heights, 0.001)), 0.061);
}

TEST(NoiseOfHeights, is_none_on_planes_and_rough_beds_that_have_none) {
  const auto waves = [](const Eigen::Vector2d& p) {
    return 0.3 * std::sin(p.x()) * std::cos(0.7 * p.y() + 0.2 * p.x());
  };
  for (const Shape& bed : {bare, Shape(waves)})
    for (const double off : {0.0, 0.35}) {
      const Drawing d{.off = off, .slope = {0.7, 0.5}, .side = 48};
      const Shape things = objects(12, d);
      const Heights heights = draw_heights(d, [&](const Eigen::Vector2d& p) { return bed(p) + things(p); });
      const LoadedScene scene = load_heights(heights);
      EXPECT_LT(farthest(moved(scene, heights)), 1e-5) << off;
      EXPECT_EQ(note_of_noise(scene), "") << off;
    }
}

TEST(NoiseOfHeights, may_be_given_and_is_stated) {
  const Drawing d{.noise = 0.02, .side = 48};
  const Heights heights = draw_heights(d, bare);
  const LoadedScene none = load_heights(heights, with_noise(0));
  EXPECT_LT(farthest(moved(none, heights)), 1e-5);
  EXPECT_EQ(note_of_noise(none), "");

  const LoadedScene little = load_heights(heights, with_noise(0.004));
  EXPECT_LE(farthest(moved(little, heights)), 0.0121);
  EXPECT_GT(farthest(moved(load_heights(heights), heights)), 0.04);

  const std::string note = note_of_noise(load_heights(heights, with_noise(0.02)));
  EXPECT_NE(note.find(" of 2304 heights show noise, of 0.02 m standard deviation: smoothed, by at most "),
            std::string::npos)
      << note;
  const double most = std::stod(note.substr(note.find("at most ") + 8));
  EXPECT_NEAR(most, farthest(moved(load_heights(heights, with_noise(0.02)), heights)), 1e-4);
}

TEST(NoiseOfHeights, is_that_of_the_file_where_the_file_says) {
  const Drawing d{.noise = 0.02, .side = 48};
  const Heights heights = draw_heights(d, bare);
  std::string text = "x y z noise\n";
  for (std::size_t i = 0; i < heights.file.size(); ++i) {
    text += text_of({heights.file[i]});
    text.back() = ' ';
    text += i % 2 ? "0.02\n" : "0\n";
  }
  const std::vector<double> by = moved(load_scene(own_file("noise.xyz", text), with_noise(1)), heights);
  double most[2] = {0, 0};
  for (std::size_t i = 0; i < by.size(); ++i) most[i % 2] = std::max(most[i % 2], std::abs(by[i]));
  EXPECT_LT(most[0], 1e-5);
  EXPECT_GT(most[1], 0.03);
  EXPECT_LE(most[1], 0.06);
}

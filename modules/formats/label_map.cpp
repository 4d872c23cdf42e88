// SPDX-License-Identifier: BSD-3-Clause
#include "formats/label_map.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/error.hpp"

namespace insonify {
namespace {

struct LabelBounds {
  Annotation annotation;
  int right = 0, bottom = 0;
  std::array<std::size_t, 256> pixels{};  // by category
};

// Returns the run lengths of an object's mask down the columns, one column after the other.
std::vector<std::uint32_t> run_lengths(const Grid<std::uint16_t>& instance, std::uint16_t number) {
  std::vector<std::uint32_t> counts{0};
  bool inside = false;
  for (Eigen::Index column = 0; column < instance.cols(); ++column)
    for (Eigen::Index row = 0; row < instance.rows(); ++row) {
      if ((instance(row, column) == number) != inside) inside = !inside, counts.push_back(0);
      ++counts.back();
    }
  return counts;
}

using Corner = std::array<int, 2>;
enum { to_right, downwards, to_left, upwards };  // directions of sides, clockwise
constexpr int steps_x[] = {1, 0, -1, 0}, steps_y[] = {0, 1, 0, -1};

/// Returns the directions in which sides of the object leave each corner, with the object on their right.
std::map<Corner, std::array<bool, 4>> sides_of(const Grid<std::uint16_t>& instance, std::uint16_t number) {
  const auto inside = [&](Eigen::Index row, Eigen::Index column) {
    return row >= 0 && column >= 0 && row < instance.rows() && column < instance.cols() &&
           instance(row, column) == number;
  };
  std::map<Corner, std::array<bool, 4>> sides;
  for (Eigen::Index row = 0; row < instance.rows(); ++row)
    for (Eigen::Index column = 0; column < instance.cols(); ++column) {
      if (!inside(row, column)) continue;
      const int x = static_cast<int>(column), y = static_cast<int>(row);
      if (!inside(row - 1, column)) sides[{x, y}][to_right] = true;
      if (!inside(row, column + 1)) sides[{x + 1, y}][downwards] = true;
      if (!inside(row + 1, column)) sides[{x + 1, y + 1}][to_left] = true;
      if (!inside(row, column - 1)) sides[{x, y + 1}][upwards] = true;
    }
  return sides;
}

/// Removes the closed outline that begins at a corner and returns the corners where it turns. Where two outlines touch
/// it turns right, so that areas which touch only at a corner stay apart.
std::vector<int> take_line(std::map<Corner, std::array<bool, 4>>& sides, Corner at, int direction) {
  std::vector<int> line{at[0], at[1]};
  const Corner begin = at;
  const int first = direction;
  while (true) {
    sides[at][static_cast<std::size_t>(direction)] = false;
    at = {at[0] + steps_x[direction], at[1] + steps_y[direction]};
    if (at == begin && !sides[at][static_cast<std::size_t>((direction + 1) % 4)]) break;
    int next = (direction + 1) % 4;
    while (!sides[at][static_cast<std::size_t>(next)]) next = (next + 3) % 4;
    if (next != direction) line.insert(line.end(), {at[0], at[1]});
    direction = next;
  }
  if (direction == first) line.erase(line.begin(), line.begin() + 2);  // the outline does not turn at its begin
  return line;
}

/// Returns twice the area within an outline, positive if it is clockwise as seen.
long area_twice(const std::vector<int>& line) {
  long area = 0;
  for (std::size_t k = 0; k < line.size(); k += 2) {
    const std::size_t next = (k + 2) % line.size();
    area += static_cast<long>(line[k]) * line[next + 1] - static_cast<long>(line[next]) * line[k + 1];
  }
  return area;
}

}  // namespace

std::vector<std::vector<int>> outlines_of(const Grid<std::uint16_t>& instance, std::uint16_t number) {
  std::map<Corner, std::array<bool, 4>> sides = sides_of(instance, number);
  std::vector<std::vector<int>> outlines;
  for (auto& [corner, leaving] : sides)
    for (int direction = 0; direction < 4; ++direction)
      if (leaving[static_cast<std::size_t>(direction)])
        if (std::vector<int> line = take_line(sides, corner, direction); area_twice(line) > 0)
          outlines.push_back(std::move(line));
  return outlines;
}

std::vector<Annotation> annotations_of(const LabelMap& map) {
  if (map.category.rows() != map.instance.rows() || map.category.cols() != map.instance.cols())
    fail(ErrorKind::argument, "annotations_of: categories of ", map.category.rows(), " x ", map.category.cols(),
         " pixels and instances of ", map.instance.rows(), " x ", map.instance.cols(), ", must be of one size");
  std::map<std::uint16_t, LabelBounds> parts;
  for (Eigen::Index row = 0; row < map.instance.rows(); ++row)
    for (Eigen::Index column = 0; column < map.instance.cols(); ++column) {
      const std::uint16_t number = map.instance(row, column);
      if (number == 0) continue;
      const int x = static_cast<int>(column), y = static_cast<int>(row);
      const auto [at, first] = parts.try_emplace(number, LabelBounds{{number, 0, 0, x, y, 0, 0, {}}, x, y});
      LabelBounds& part = at->second;
      ++part.pixels[map.category(row, column)];
      ++part.annotation.area;
      part.annotation.left = std::min(part.annotation.left, x), part.right = std::max(part.right, x);
      part.bottom = y;
    }
  std::vector<Annotation> annotations;
  for (auto& [number, part] : parts) {
    Annotation& a = annotations.emplace_back(part.annotation);
    a.category = static_cast<std::uint8_t>(std::ranges::max_element(part.pixels) - part.pixels.begin());
    a.width = part.right - a.left + 1, a.height = part.bottom - a.top + 1;
    a.counts = run_lengths(map.instance, number);
  }
  return annotations;
}

}  // namespace insonify

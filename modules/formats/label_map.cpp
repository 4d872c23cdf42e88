#include "formats/label_map.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/error.hpp"

namespace insonify {
namespace {

struct PartBounds {
  Annotation annotation;
  int right = 0, bottom = 0;
};

// Run lengths down the columns, one column after the other.
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

std::uint16_t next_number(std::size_t parts, const char* who) {
  if (parts >= std::numeric_limits<std::uint16_t>::max())
    fail(ErrorKind::content, who, ": a picture has more than 65535 objects; ask for more pixels at least");
  return static_cast<std::uint16_t>(parts + 1);
}

}  // namespace

Grid<std::uint16_t> connected_parts(const Grid<std::uint32_t>& key, std::size_t least_pixels) {
  Grid<std::uint16_t> number = Grid<std::uint16_t>::Zero(key.rows(), key.cols());
  Grid<std::uint8_t> seen = Grid<std::uint8_t>::Zero(key.rows(), key.cols());
  std::size_t parts = 0;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> part;
  for (Eigen::Index row = 0; row < key.rows(); ++row)
    for (Eigen::Index column = 0; column < key.cols(); ++column) {
      if (seen(row, column) || key(row, column) == 0) continue;
      // Grow the part from its first pixel.
      part.assign(1, {row, column});
      seen(row, column) = 1;
      for (std::size_t i = 0; i < part.size(); ++i)
        for (Eigen::Index r = std::max<Eigen::Index>(0, part[i].first - 1);
             r <= std::min(key.rows() - 1, part[i].first + 1); ++r)
          for (Eigen::Index c = std::max<Eigen::Index>(0, part[i].second - 1);
               c <= std::min(key.cols() - 1, part[i].second + 1); ++c)
            if (!seen(r, c) && key(r, c) == key(row, column)) seen(r, c) = 1, part.emplace_back(r, c);
      if (part.size() < least_pixels) continue;
      const std::uint16_t mine = next_number(parts++, "connected_parts");
      for (const auto& [r, c] : part) number(r, c) = mine;
    }
  return number;
}

Grid<std::uint16_t> numbered_keys(const Grid<std::uint32_t>& key, std::size_t least_pixels) {
  std::map<std::uint32_t, std::size_t> pixels;
  for (const std::uint32_t k : key.reshaped())
    if (k != 0) ++pixels[k];
  std::map<std::uint32_t, std::uint16_t> number;
  for (const auto& [k, count] : pixels)
    if (count >= least_pixels) {
      const std::uint16_t next = next_number(number.size(), "numbered_keys");
      number[k] = next;
    }
  return key.unaryExpr([&](std::uint32_t k) {
    const auto found = number.find(k);
    return found == number.end() ? std::uint16_t{0} : found->second;
  });
}

std::vector<Annotation> annotations_of(const LabelMap& map) {
  if (map.category.rows() != map.instance.rows() || map.category.cols() != map.instance.cols())
    fail(ErrorKind::argument, "annotations_of: categories of ", map.category.rows(), " x ", map.category.cols(),
         " pixels and instances of ", map.instance.rows(), " x ", map.instance.cols(), ", must be of one size");
  std::map<std::uint16_t, PartBounds> parts;
  for (Eigen::Index row = 0; row < map.instance.rows(); ++row)
    for (Eigen::Index column = 0; column < map.instance.cols(); ++column) {
      const std::uint16_t number = map.instance(row, column);
      if (number == 0) continue;
      const int x = static_cast<int>(column), y = static_cast<int>(row);
      const auto [at, first] =
          parts.try_emplace(number, PartBounds{{number, map.category(row, column), 0, x, y, 0, 0, {}}, x, y});
      PartBounds& part = at->second;
      if (map.category(row, column) != part.annotation.category)
        fail(ErrorKind::argument, "annotations_of: instance ", number, " has pixels of categories ",
             int{part.annotation.category}, " and ", int{map.category(row, column)}, ", must be of one");
      ++part.annotation.area;
      part.annotation.left = std::min(part.annotation.left, x), part.right = std::max(part.right, x);
      part.bottom = y;
    }
  std::vector<Annotation> annotations;
  for (auto& [number, part] : parts) {
    Annotation& a = annotations.emplace_back(part.annotation);
    a.width = part.right - a.left + 1, a.height = part.bottom - a.top + 1;
    a.counts = run_lengths(map.instance, number);
  }
  return annotations;
}

}  // namespace insonify

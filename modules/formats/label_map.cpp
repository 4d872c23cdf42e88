#include "formats/label_map.hpp"

#include <algorithm>
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

}  // namespace

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

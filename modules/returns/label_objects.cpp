// SPDX-License-Identifier: BSD-3-Clause
#include "returns/label_objects.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace insonify {

Grid<std::uint32_t> connected_groups(const Grid<std::uint32_t>& key, std::size_t least_pixels) {
  Grid<std::uint32_t> number = Grid<std::uint32_t>::Zero(key.rows(), key.cols());
  Grid<std::uint8_t> seen = Grid<std::uint8_t>::Zero(key.rows(), key.cols());
  std::uint32_t parts = 0;
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
      ++parts;
      for (const auto& [r, c] : part) number(r, c) = parts;
    }
  return number;
}

SceneInstances number_instances(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& given) {
  constexpr std::uint32_t most_kept = 65534;
  std::set<std::uint32_t> ids;
  for (const auto& [surfel, id] : given)
    if (id != 0) ids.insert(id);
  // Give ids that are too large the lowest free numbers.
  SceneInstances all;
  std::unordered_map<std::uint32_t, std::uint32_t> number_of;
  std::uint32_t next = 1;
  for (auto id = ids.upper_bound(most_kept); id != ids.end(); ++id, ++next) {
    while (next <= most_kept && ids.contains(next)) ++next;
    number_of[*id] = next, all.renumbered[next] = *id;
    all.most = std::max(all.most, next);
  }
  for (const auto& [surfel, id] : given) {
    if (id == 0) continue;
    const std::uint32_t number = id <= most_kept ? id : number_of.at(id);
    all.of_surfel[surfel] = number;
    all.most = std::max(all.most, number);
  }
  return all;
}

Grid<std::uint32_t> number_objects(const Grid<std::uint32_t>& kind, const Grid<std::uint32_t>& id,
                                   const SceneInstances& instances, std::size_t least_pixels) {
  if (kind.rows() != id.rows() || kind.cols() != id.cols())
    fail(ErrorKind::argument, "number_objects: kinds of ", kind.rows(), " x ", kind.cols(), " pixels and ids of ",
         id.rows(), " x ", id.cols(), ", must be of one size");
  // Keep the numbers of the scene's instances; number the connected parts of the rest.
  Grid<std::uint32_t> objects = Grid<std::uint32_t>::Zero(kind.rows(), kind.cols()), rest = kind;
  std::unordered_map<std::uint32_t, std::size_t> pixels;
  for (Eigen::Index i = 0; i < kind.size(); ++i) {
    const auto found = kind(i) == 0 ? instances.of_surfel.end() : instances.of_surfel.find(id(i));
    if (found == instances.of_surfel.end()) continue;
    objects(i) = found->second, rest(i) = 0;
    ++pixels[found->second];
  }
  for (std::uint32_t& number : objects.reshaped())
    if (number != 0 && pixels.at(number) < least_pixels) number = 0;
  const Grid<std::uint32_t> connected = connected_groups(rest, least_pixels);
  return (connected > 0).select(connected + instances.most, objects);
}

ObjectKeys object_keys(const PixelLabels& labels, const SceneInstances& of_scene, double least_share) {
  if (labels.part.size() == 0) return {id_image(labels, least_share), of_scene};
  ObjectKeys keys{part_image(labels, least_share).cast<std::uint32_t>(), {}};
  const std::uint32_t most = of_scene.most;
  keys.instances.most = most + static_cast<std::uint32_t>(labels.part_labels.size());
  keys.instances.renumbered = of_scene.renumbered;
  for (std::uint32_t p = 0; p < labels.part_labels.size(); ++p)
    if (!labels.part_labels[p].empty()) keys.instances.of_surfel[p] = most + p + 1;
  if (of_scene.of_surfel.empty()) return keys;
  // Keys above those of parts are instances of surfels.
  constexpr std::uint32_t first_key = 0x10000;
  const Grid<std::uint32_t> surfel = id_image(labels, least_share);
  for (Eigen::Index i = 0; i < surfel.size(); ++i) {
    const auto of = keys.id(i) == 0 ? of_scene.of_surfel.find(surfel(i)) : of_scene.of_surfel.end();
    if (of == of_scene.of_surfel.end()) continue;
    keys.id(i) = first_key + of->second;
    keys.instances.of_surfel[first_key + of->second] = of->second;
  }
  return keys;
}

Grid<std::uint32_t> instance_image(const PixelLabels& labels, const SceneInstances& instances, double least_share) {
  const Grid<std::uint32_t> kind = material_image(labels, least_share).unaryExpr([](std::uint16_t material) {
    return material < PixelLabels::shadow ? std::uint32_t{material} + 1 : 0;
  });
  const ObjectKeys keys = object_keys(labels, instances, 0);
  return number_objects(kind, keys.id, keys.instances);
}

}  // namespace insonify

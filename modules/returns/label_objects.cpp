// SPDX-License-Identifier: BSD-3-Clause
#include "returns/label_objects.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace insonify {

Grid<std::uint32_t> connected_parts(const Grid<std::uint32_t>& key, std::size_t least_pixels) {
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

Grid<std::uint32_t> numbered_keys(const Grid<std::uint32_t>& key, std::size_t least_pixels) {
  std::map<std::uint32_t, std::size_t> pixels;
  for (const std::uint32_t k : key.reshaped())
    if (k != 0) ++pixels[k];
  std::map<std::uint32_t, std::uint32_t> number;
  for (const auto& [k, count] : pixels)
    if (count >= least_pixels) number.emplace(k, static_cast<std::uint32_t>(number.size() + 1));
  return key.unaryExpr([&](std::uint32_t k) {
    const auto found = number.find(k);
    return found == number.end() ? 0U : found->second;
  });
}

Grid<std::uint32_t> number_objects(const Grid<std::uint32_t>& kind, const Grid<std::uint32_t>& id,
                                   const SceneInstances& instances, std::size_t least_pixels) {
  if (kind.rows() != id.rows() || kind.cols() != id.cols())
    fail(ErrorKind::argument, "number_objects: kinds of ", kind.rows(), " x ", kind.cols(), " pixels and ids of ",
         id.rows(), " x ", id.cols(), ", must be of one size");
  // Instances of the scene are kept apart by kind; the rest by what touches.
  Grid<std::uint32_t> keys = Grid<std::uint32_t>::Zero(kind.rows(), kind.cols()), parts = kind;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> key_of;
  for (Eigen::Index i = 0; i < kind.size(); ++i) {
    const auto found = kind(i) == 0 ? instances.end() : instances.find(id(i));
    if (found == instances.end()) continue;
    keys(i) = key_of.try_emplace({kind(i), found->second}, static_cast<std::uint32_t>(key_of.size() + 1)).first->second;
    parts(i) = 0;
  }
  Grid<std::uint32_t> objects = numbered_keys(keys, least_pixels);
  const std::uint32_t named = objects.size() > 0 ? objects.maxCoeff() : 0;
  const Grid<std::uint32_t> connected = connected_parts(parts, least_pixels);
  return (connected > 0).select(connected + named, objects);
}

ObjectKeys object_keys(const PixelLabels& labels, const SceneInstances& of_scene, double least_share) {
  if (labels.part.size() == 0) return {id_image(labels, least_share), of_scene};
  ObjectKeys keys{part_image(labels, least_share).cast<std::uint32_t>(), {}};
  for (std::uint32_t p = 0; p < labels.part_labels.size(); ++p)
    if (!labels.part_labels[p].empty()) keys.instances[p] = p;
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/grid.hpp"

namespace insonify {

/// A part of a scene as the head of a ping sees it.
struct PartView {
  /// The least and the most of a number.
  struct Extent {
    double least = std::numeric_limits<double>::quiet_NaN(), most = std::numeric_limits<double>::quiet_NaN();
    bool operator==(const Extent&) const = default;
  };
  Eigen::Isometry3d world_from_part = Eigen::Isometry3d::Identity();
  /// Of the solid angle under which the head would see the part alone, the share that it sees; NaN: it would see
  /// nothing.
  double visible_share = std::numeric_limits<double>::quiet_NaN();
  Extent azimuth{}, elevation{}, range{};  ///< [rad], [rad], [m] of all that the head would see of the part alone
};

/// What surface every pixel of a ping shows, beams x bins.
struct PixelLabels {
  static constexpr std::uint16_t nothing = 0xffff;  ///< no surface of the scene in this cell
  static constexpr std::uint16_t shadow = 0xfffe;   ///< surface in this cell, none of which the head sees
  static constexpr std::uint32_t no_id = 0xffffffff;
  static constexpr std::uint16_t no_part = 0xffff;

  Grid<std::uint16_t> material;    ///< index into names, or nothing or shadow
  Grid<std::uint32_t> id;          ///< of the strongest surfel of that material in this cell; no_id if there is none
  Grid<float> share;               ///< of the pixel's energy that is of that material and in the main lobe; else 0
  std::vector<std::string> names;  ///< of the materials; of a scene of parts, of their labels where they have one
  Grid<std::uint16_t> part{};  ///< of that surfel, index into `part_names`; no_part if there is none. Empty: no parts
  std::vector<std::string> part_names{}, part_labels{};  ///< of all parts of the scene (ScenePart)
  std::vector<PartView> views{};                         ///< of all parts

  /// Whether there are no labels.
  bool empty() const { return material.size() == 0; }
};

/// The material of every pixel; nothing where less than `least_share` of the energy is of one material in the pixel's
/// own cell, i.e. where side lobes or multipath are stronger.
Grid<std::uint16_t> material_image(const PixelLabels& labels, double least_share = 0.5);

/// The id of the strongest surfel of every pixel, by the same rule; no_id elsewhere.
Grid<std::uint32_t> id_image(const PixelLabels& labels, double least_share = 0.5);

/// The part of the strongest surfel of every pixel, by the same rule; no_part elsewhere. Empty without parts.
Grid<std::uint16_t> part_image(const PixelLabels& labels, double least_share = 0.5);

}  // namespace insonify

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
  /// Smallest and largest value of a quantity; NaN: none.
  struct Extent {
    double least = std::numeric_limits<double>::quiet_NaN(), most = std::numeric_limits<double>::quiet_NaN();
    bool operator==(const Extent&) const = default;
  };
  /// Pose of the axes of the part's file.
  Eigen::Isometry3d world_from_part = Eigen::Isometry3d::Identity();
  /// Visible fraction of the part: the solid angle that the head sees of it, over the solid angle that it would see of
  /// the part alone. NaN: it would see nothing.
  double visible_share = std::numeric_limits<double>::quiet_NaN();
  Extent azimuth{}, elevation{},
      range{};  ///< [rad], [rad], [m] of the surface that the head would see of the part alone
  /// Extent of the azimuth of the beam that receives the part [rad]. A line array resolves cones about its axis, so
  /// this differs from `azimuth` for surfaces high above or far below. `ahead` and `port` are the extents of its
  /// position in pictures in true geometry: cosine and sine of the beam's azimuth times the range [m].
  Extent beam_azimuth{}, ahead{}, port{};
  /// Lengths over those of the part's file, and extents of the whole part along the axes of that file [m]. NaN: the
  /// part stands as captured, or is not in the scene.
  double scale = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d size = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// The surface that each pixel of a ping shows, beams x bins.
struct PixelLabels {
  static constexpr std::uint16_t nothing = 0xffff;  ///< no surface of the scene in this cell
  static constexpr std::uint16_t shadow = 0xfffe;   ///< surface in this cell, but the head sees none of it
  static constexpr std::uint32_t no_id = 0xffffffff;
  static constexpr std::uint16_t no_part = 0xffff;

  Grid<std::uint16_t> material;    ///< index into names, or nothing or shadow
  Grid<std::uint32_t> id;          ///< id of the strongest surfel of that material in this cell; no_id if there is none
  Grid<float> share;               ///< fraction of the pixel's energy from that material in the main lobe; else 0
  std::vector<std::string> names;  ///< names of materials; in a scene of parts, labels of parts replace their materials
  Grid<std::uint16_t> part{};      ///< part of that surfel, index into `part_names`; no_part: none. Empty: no parts
  std::vector<std::string> part_names{}, part_labels{};  ///< names and labels of all parts of the scene (ScenePart)
  std::vector<PartView> views{};                         ///< one per part
  /// Maps of display cells (E194, E195), else empty: the elevation from which the echo of the label's strongest surfel
  /// arrives, above the x-y plane of the head [rad], 0 without a label; the label with the most energy among the
  /// others, or nothing; and its share.
  Grid<float> elevation{};
  Grid<std::uint16_t> second{};
  Grid<float> second_share{};

  /// Returns true if there are no labels.
  bool empty() const { return material.size() == 0; }
};

/// Returns the material of every pixel. A pixel is nothing if less than `least_share` of its energy comes from one
/// material in its own cell, i.e. where side lobes or multipath are stronger.
Grid<std::uint16_t> material_image(const PixelLabels& labels, double least_share = 0.5);

/// Returns the id of the strongest surfel of every pixel, by the rule of material_image; no_id elsewhere.
Grid<std::uint32_t> id_image(const PixelLabels& labels, double least_share = 0.5);

/// Returns the part of the strongest surfel of every pixel, by the rule of material_image; no_part elsewhere. Empty if
/// the scene has no parts.
Grid<std::uint16_t> part_image(const PixelLabels& labels, double least_share = 0.5);

}  // namespace insonify

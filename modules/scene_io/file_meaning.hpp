// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/meaning_override.hpp"

namespace insonify {

/// The source of a fact about a file: the convention of its format, the file, its numbers, or the caller.
enum class MeaningOrigin { convention, file, guessed, option };

/// A fact about a file.
template <typename Value>
struct Meant {
  Value value{};
  MeaningOrigin origin = MeaningOrigin::convention;
  std::string sentence{};  ///< the fact and its source, for people; empty for conventions
};

/// A fact about a file as text.
struct MeaningItem {
  std::string name, value;
  const char* origin;  ///< "convention", "file", "guessed" or "option"
  std::string sentence;
};

/// The transformation of coordinates to the world: axis i of the world is factor[i] times axis from[i] of the file.
struct FileAxes {
  std::array<int, 3> from{0, 1, 2};
  Eigen::Vector3d factor{1, 1, 1};  ///< [m] per unit of the file

  /// Returns true if coordinates stay unchanged.
  bool is_identity() const { return *this == FileAxes{}; }
  /// Returns true if all numbers are equal.
  bool operator==(const FileAxes& other) const { return from == other.from && factor == other.factor; }
  /// Returns true if left becomes right.
  bool mirrors() const;
  /// Returns a position in the world [m].
  Eigen::Vector3d position(const Eigen::Vector3d& in_file) const {
    return {factor[0] * in_file[from[0]], factor[1] * in_file[from[1]], factor[2] * in_file[from[2]]};
  }
  /// Returns a normal of a surface in the world, as long as `in_file`.
  Eigen::Vector3d normal(const Eigen::Vector3d& in_file) const;
  /// Returns the factor by which areas grow whose normal in the file is `in_file`; zero stands for an unknown normal.
  double area_factor(const Eigen::Vector3d& in_file) const;
};

/// Facts about units, axes, signs and holes of a file. Readers set them, fill_cloud applies them, `info` shows them.
struct FileMeaning {
  Meant<double> unit{1};                              ///< [m] of one unit of the coordinates
  Meant<double> unit_z{0};                            ///< [m] of one unit of the heights; 0: that of `unit`
  Meant<bool> z_down;                                 ///< true: heights are depths
  Meant<bool> y_up;                                   ///< true: the y axis points up
  Meant<std::string> band;                            ///< band or variable of a raster that holds the heights
  Meant<std::vector<double>> no_data;                 ///< heights that mark holes [units of the file]
  Meant<std::vector<double>> valid;                   ///< lowest and highest number that is no hole; empty: all
  Meant<PointClasses> classes{PointClasses().set()};  ///< classes of points that are read
  Meant<std::string> system;  ///< coordinate system: "EPSG:32632 (WGS 84 / UTM zone 32N)", or its name
  std::string no_lengths;     ///< reason why the coordinates are no lengths, and remedy; empty if they are

  /// Returns the axes that follow from all facts.
  FileAxes axes() const;
  /// Returns true if the file marks this height [units of the file] as a hole.
  bool is_hole(double height) const {
    for (const double mark : no_data.value)
      if (height == mark || static_cast<float>(height) == static_cast<float>(mark)) return true;
    return false;
  }
  /// Replaces facts by those that the caller states.
  void override_by(const MeaningOverride& requested);
  /// Returns all facts that differ from the convention of any format, and unit and sign of z.
  std::vector<MeaningItem> items() const;
  /// Returns the sentences of facts that the file or its numbers gave.
  std::vector<std::string> notes() const;
};

}  // namespace insonify

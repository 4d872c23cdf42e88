// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bitset>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// Classes of LAS points by their numbers.
using PointClasses = std::bitset<256>;

/// Statements of a caller about the meaning of a scene file. Where a member is empty, the file decides, else the
/// convention of its format.
struct MeaningOverride {
  std::optional<double> unit;   ///< [m] of one unit of all coordinates
  std::optional<bool> z_down;   ///< true: z is a depth and counts downwards
  std::optional<bool> y_up;     ///< the y axis points up: (x, y, z) becomes (x, -z, y)
  std::string band;             ///< name, or number from 1, of the band or variable of a raster that holds the heights
  std::size_t band_number = 0;  ///< number of that band in place of `band`; 0: not given
  std::optional<std::vector<double>> no_data;  ///< heights that mark holes [units of the file]; may be none
  std::optional<PointClasses> classes;         ///< classes of LAS points that are read; others are left out
};

/// An item of MeaningOverride as the command line, TOML files and Python give it.
struct MeaningOption {
  const char* key;     ///< key in TOML files and Python
  const char* option;  ///< option of the command line
  const char* help;
  std::string (*text)(const MeaningOverride& from);  ///< returns the item as text; "": not given
  /// Sets the item; "" takes it back. Throws Error(argument) with the option, the text and what it may be.
  void (*parse)(const std::string& text, MeaningOverride& to);
  /// Sets the item by one number or more; returns false if these cannot be its value.
  bool (*take)(const std::vector<double>& numbers, MeaningOverride& to);
};
/// Returns all items.
std::span<const MeaningOption> meaning_options();

/// Returns the length [m] of a unit by its name in any case, such as "mm", "ft", "us-ft" or "US survey foot"; nothing
/// for a name that is not known.
std::optional<double> unit_named(std::string_view name);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bitset>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// Classes of LAS points by their numbers.
using PointClasses = std::bitset<256>;

/// Statements of a caller about the meaning of a scene file. Where a member is empty, the file decides, else the
/// convention of its format.
struct MeaningOverride {
  std::optional<double> unit;  ///< [m] of one unit of all coordinates
  std::optional<bool> z_down;  ///< true: z is a depth and counts downwards
  std::optional<bool> y_up;    ///< the y axis points up: (x, y, z) becomes (x, -z, y)
  std::string band;            ///< number from 1, or name, of the band or variable of a raster that holds the heights
  std::optional<std::vector<double>> no_data;  ///< heights that mark holes [units of the file]; may be none
  std::optional<PointClasses> classes;         ///< classes of LAS points that are read; others are left out
};

/// MeaningOverride as text, as the command line, TOML files and Python give it. An empty text is not given.
struct MeaningText {
  std::string unit, z, up, band, no_data, classes;
  /// Orders by text.
  auto operator<=>(const MeaningText&) const = default;
};

/// A row of the table of MeaningText.
struct MeaningOption {
  const char* key;     ///< key in TOML files and Python
  const char* option;  ///< option of the command line
  std::string MeaningText::*text;
  const char* help;
};
inline constexpr MeaningOption meaning_options[] = {
    {"unit", "--unit", &MeaningText::unit,
     "unit of the coordinates: m, mm, cm, km, ft, us-ft, or metres per unit; default: that of the file, else m"},
    {"z", "--z", &MeaningText::z, "sign of z: up, or down for depths; default: as the file says, else up"},
    {"up", "--up", &MeaningText::up, "axis of the file that points up: y or z; default: y of glTF, else z"},
    {"band", "--band", &MeaningText::band,
     "number or name of the band or variable of a raster that holds the heights; default: the one that is named "
     "as one, else 1"},
    {"nodata", "--nodata", &MeaningText::no_data,
     "heights that mark holes, as numbers with commas between them, or none; default: those of the file, and numbers "
     "such as -9999 that stand far from all others"},
    {"classes", "--classes", &MeaningText::classes,
     "classes of LAS points that are read, as numbers with commas between them, or all; default: all but noise (7 and "
     "18)"},
};

/// Returns the length [m] of a unit by its name in any case, such as "mm", "ft", "us-ft" or "US survey foot"; nothing
/// for a name that is not known.
std::optional<double> unit_named(std::string_view name);

/// Returns the statements of a text. Throws Error(argument) with the option, its value and what it may be.
MeaningOverride parse_meaning(const MeaningText& text);

}  // namespace insonify

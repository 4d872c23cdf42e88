// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "returns/soundings.hpp"

namespace insonify {

/// Name and unit of a column in files.
struct SoundingColumn {
  const char *name, *unit;
};

/// Returns the unit of a column for files with signed whole numbers, which hold -1 in place of 4294967295.
inline std::string signed_unit(const SoundingColumn& column) {
  const std::string unit = column.unit, none = std::to_string(Soundings::none);
  const std::size_t at = unit.find(none);
  return at == unit.npos ? unit : std::string(unit).replace(at, none.size(), "-1");
}

/// Calls use(SoundingColumn, column ...) for every column but position that all soundings have, in the order of files.
/// The arguments are the columns of all given soundings.
template <typename Use, typename... Some>
void each_common_column(const Use& use, Some&... soundings) {
  use(SoundingColumn{"level_db", "dB re 1 uPa"}, soundings.level_db...);
  use(SoundingColumn{"range", "m"}, soundings.range...);
  use(SoundingColumn{"azimuth", "rad, positive to port"}, soundings.azimuth...);
  use(SoundingColumn{"elevation", "rad, positive up"}, soundings.elevation...);
  use(SoundingColumn{"ping", "number"}, soundings.ping...);
  use(SoundingColumn{"beam", "number from 0"}, soundings.beam...);
  use(SoundingColumn{"bin", "number from 0"}, soundings.bin...);
  use(SoundingColumn{"true_elevation", "rad, positive up; NaN: no surfel"}, soundings.true_elevation...);
  use(SoundingColumn{"true_surfel", "id in the scene; 4294967295: none"}, soundings.true_surfel...);
  use(SoundingColumn{"true_material", "number in the scene; 4294967295: none"}, soundings.true_material...);
}

/// Optional column of soundings, last in files.
inline constexpr SoundingColumn order_column = {"true_order", "surfaces met: 1 or 2"};

/// Calls use(SoundingColumn, column) for every column but position that these soundings have.
template <typename Use, typename Those>
void each_column(const Use& use, Those& soundings) {
  each_common_column(use, soundings);
  if (!soundings.true_order.empty()) use(order_column, soundings.true_order);
}

/// Appends sounding i of `from`.
inline void append_row(Soundings& to, const Soundings& from, std::size_t i) {
  const auto append = [i](const SoundingColumn&, auto& column, const auto& source) { column.push_back(source[i]); };
  if (!from.true_order.empty() || !to.true_order.empty()) {
    to.true_order.resize(to.size(), 1);
    to.true_order.push_back(from.true_order.empty() ? 1 : from.true_order[i]);
  }
  to.position.push_back(from.position[i]);
  each_common_column(append, to, from);
}

}  // namespace insonify

#pragma once
#include <string>

#include "returns/soundings.hpp"

namespace insonify {

/// Reads soundings from a .ply that save_soundings wrote: positions in double, everything else bit for bit. Throws
/// Error(file) if it is missing or unreadable; Error(content) if it is truncated, not a binary PLY, or lacks a column,
/// naming it.
Soundings load_soundings(const std::string& path);

}  // namespace insonify

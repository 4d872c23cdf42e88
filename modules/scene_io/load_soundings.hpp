#pragma once
#include <string>

#include "returns/soundings.hpp"

namespace insonify {

/// Reads soundings back from a .ply that save_soundings wrote: positions in double, all else bit by bit. Throws
/// Error(file) if it is missing or unreadable; Error(content) if it is cut off, no binary PLY, or lacks a column, naming
/// it.
Soundings load_soundings(const std::string& path);

}  // namespace insonify

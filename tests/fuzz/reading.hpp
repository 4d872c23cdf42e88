// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fuzz/readers.hpp"

namespace insonify {

/// How the reading of a file ended.
struct Reading {
  int exit_code = 0;               ///< that of the tool; less than 0: the signal that ended the process
  double seconds = 0, waited = 0;  ///< time of the processor, and of the clock [s]
  double mib = 0;                  ///< memory [MiB]
  std::string said;                ///< what was printed

  /// Returns whether it ended with 0, 2, 3, 4 or 5, within 5 s of processor and 1 GB, and said one line, or none with 0.
  bool good() const;
};

/// Reads a file in a process of its own, with a server of readers if the reader is `apart`.
Reading read_alone(const FuzzedReader& reader, const std::filesystem::path& path);

/// Reads files one after another in one process, with one server of readers if the reader is `apart`, which forks one
/// for each file, as in the tool; where a file ends the process, another one goes on. Each process reads `first`, which
/// is whole, before its server starts: else each reader would load GDAL. `seconds` are counted by 0.01; `mib` is the
/// largest of all.
std::vector<Reading> read_in_turn(const FuzzedReader& reader, const std::filesystem::path& first,
                                  const std::vector<std::filesystem::path>& paths);

}  // namespace insonify

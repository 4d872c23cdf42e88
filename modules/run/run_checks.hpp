// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "store/run_directory.hpp"

namespace insonify {

/// Returns the optional packages that this build has, with their versions, e.g. "Embree 3, GDAL 3.6.2, Python 3.11, VTK
/// 9.1.0".
std::string built_with();

/// Writes the last file of a run, manifest.json, with built_with() and the SHA-256 of all others; what `manifest` has
/// of them already is not computed again. Throws Error(file).
void write_manifest(const RunDirectory& directory, nlohmann::ordered_json manifest);

/// The state of the files of a run or survey since it was written: those compared, and what was found.
struct RunCheck {
  std::size_t files = 0;              ///< number of files that were compared
  std::vector<std::string> problems;  ///< "cube.h5 was changed", "fan.png is missing"
};

/// Compares the files of a run with the digests in its manifest, of a survey those of finished blocks with their marks;
/// if `only` is not empty, this file of a run alone. Throws Error(content) if the folder has no digests, Error(file) if
/// a file cannot be read.
RunCheck check_run(const std::string& run, const std::string& only = {});

/// Empty, or in one line what is wrong with `file` of the run directory `run`; empty too for a cube, and for a run
/// whose manifest has no digests.
std::string integrity_problem(const std::string& run, const std::string& file);

}  // namespace insonify

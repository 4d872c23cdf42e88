// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

namespace insonify {

/// Key of a manifest.json: the SHA-256 of the files of a run, by their names relative to its folder.
inline constexpr const char* digests_key = "sha256";

/// Returns the digests in `folder`/manifest.json; empty if there is no manifest of insonify with digests. Throws
/// Error(content) for a manifest that is not a JSON object.
std::map<std::string, std::string> digests_of_run(const std::string& folder);

/// Returns the names in `folder` that do not belong to its run: files that its manifest.json does not list, links, and
/// listed files of up to 16 MiB with another SHA-256. Larger files count as unchanged. Without a manifest of insonify
/// all names are returned; none for an empty folder. Throws as digests_of_run.
std::vector<std::string> names_of_no_run(const std::string& folder);

}  // namespace insonify

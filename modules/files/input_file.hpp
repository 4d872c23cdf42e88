// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Throws Error(file) unless `path` names a regular file. It refuses a missing file, a folder, and a pipe or device,
/// which may have no end.
void require_regular_file(const std::string& path);

}  // namespace insonify

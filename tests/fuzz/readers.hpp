// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "fuzz/structured.hpp"

namespace insonify {

/// A reader of files that strangers may have made.
struct FuzzedReader {
  std::string name;       ///< name, also of its folders of seeds and regressions
  std::string extension;  ///< extension of its files, with the dot
  std::function<void(const std::string& path)> read;
  /// Damage that the format's own checks do not find; empty: bytes are damaged anywhere.
  std::function<std::string(const std::string& bytes, const DamageSource& source)> damage{};
  /// Read by HDF5, GDAL, libpng or VTK's XML, which damage may crash: programs read them by a ReaderServer.
  bool apart = false;
};

/// Returns all readers.
const std::vector<FuzzedReader>& fuzzed_readers();

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify {

/// Path of a dataset in the file, its unit for the attribute "units", and its description with signs for "long_name"
/// ("": none).
struct DatasetName {
  const char* path;
  const char* unit;
  const char* about = "";
};

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// One value of a file of data with its source.
struct SourcedNumber {
  std::string key;     ///< such as "centre_frequency_hz"
  std::string value;   ///< text of the value
  std::string status;  ///< sourced | recalled | derived | assumed | unknown | user
  std::string source;  ///< such as "datasheet DA-148-P01443-10"
};

}  // namespace insonify

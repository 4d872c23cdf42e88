// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/error.hpp"

namespace insonify {

/// Throws Error(argument) "who: key = value unit, must be rule" unless `holds`; `unit` may be "".
inline void require(bool holds, const char* who, const char* key, double value, const char* unit, const char* rule) {
  if (!holds) fail(ErrorKind::argument, who, ": ", key, " = ", value, *unit ? " " : "", unit, ", must be ", rule);
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/ping_event.hpp"

#include <cmath>

#include "core/error.hpp"

namespace insonify {

void require_valid(const PingEvent& event, const char* who) {
  require_valid(event.motion, who);
  if (!std::isfinite(event.time)) fail(ErrorKind::argument, who, ": event.time = ", event.time, ", must be finite");
}

}  // namespace insonify

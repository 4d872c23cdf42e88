// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "acoustics/motion.hpp"
#include "core/pose.hpp"

namespace insonify {

/// When and from where a ping is sent.
struct PingEvent {
  Pose world_from_head = Pose::Identity();
  Motion motion{};          ///< of the head during the ping (E44); only direct echoes are shifted by it
  double time = 0;          ///< of transmission [s]
  std::int64_t number = 0;  ///< selects the random streams: noise, water and waves are new in every ping
};

/// Throws Error(argument) for a time or motion that is not finite; `who` names the caller.
void require_valid(const PingEvent& event, const char* who);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "acoustics/motion.hpp"
#include "core/pose.hpp"

namespace insonify {

/// Time, pose and motion of the head for one ping.
struct PingEvent {
  Pose world_from_head = Pose::Identity();
  Motion motion{};          ///< motion of the head during the ping (E44); it shifts only direct echoes
  double time = 0;          ///< time of transmission [s]
  std::int64_t number = 0;  ///< selects the random streams: each number has its own noise, water and waves
};

/// Throws Error(argument) for a time or motion that is not finite; `who` names the caller.
void require_valid(const PingEvent& event, const char* who);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/ping_event.hpp"
#include "survey/mission.hpp"

namespace insonify {

/// One ping of a survey.
struct SurveyPing {
  std::size_t head = 0;     ///< index in the mission
  std::int64_t number = 0;  ///< number among the pings of this head, from 0
  double time = 0;          ///< time of transmission [s]
  std::int64_t sweep = 0;   ///< sweep of a scanning head, from 0; else 0
  double scan_angle = 0;    ///< angle of a scanning head [rad], positive to port; else 0
};

inline constexpr double most_survey_pings = 1e8;  ///< limit for all heads of a mission

/// Returns all pings of a mission, head after head, in the order of time for each head. They depend on the mission
/// alone. Every leg begins with a ping and a new sweep. Throws Error(argument) for an invalid mission, for two pings of
/// a head that are closer than its listening time (naming both and the time), and if there is no ping. At random poses
/// each head pings once, the i-th time at i seconds.
std::vector<SurveyPing> survey_pings(const Mission& mission);

/// Returns time, pose and motion of a ping: those of the vehicle (pose_at, motion_at) with mounting and scan angle of
/// the head, whose lever arm moves as the vehicle turns. Its number is random_stream_of(ping). O(log n) for a
/// trajectory of n entries. At a random pose the vehicle rests. Throws as pose_at; Error(argument) if the poses of the
/// mission are not drawn.
PingEvent event_of(const Mission& mission, const SurveyPing& ping);

/// Returns pose and motion of a ping as navigation and installation sheet have them (E216): of the vehicle at the time
/// of the ping less what is assumed too little of the latency, with the mission's navigation errors, and with mounting
/// and draught that are assumed. Before and after the trajectory its first and last interval go on. Throws
/// Error(argument) if the poses of the mission are not drawn.
PingEvent believed_event_of(const Mission& mission, const SurveyPing& ping);

/// Returns PingEvent::number of a ping. It differs for all pings of all heads; its lower 40 bits are `number`.
std::int64_t random_stream_of(const SurveyPing& ping);

/// Consecutive pings of one head that are stored together: the unit of work.
struct SurveyBlock {
  std::size_t head = 0;
  std::int64_t number = 0;         ///< number among the blocks of this head, from 0
  std::size_t begin = 0, end = 0;  ///< indices into survey_pings
};

/// Divides the pings of every head, in their order, into blocks of `per_block[head]` pings; the last block may be
/// shorter.
std::vector<SurveyBlock> survey_blocks(const std::vector<SurveyPing>& pings, const std::vector<std::size_t>& per_block);

}  // namespace insonify

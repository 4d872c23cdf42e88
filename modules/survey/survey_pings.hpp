#pragma once
#include <cstdint>
#include <vector>

#include "survey/mission.hpp"

namespace insonify {

/// One ping of a survey.
struct SurveyPing {
  std::size_t head = 0;     ///< index in the mission
  std::int64_t number = 0;  ///< among the pings of this head, from 0
  double time = 0;          ///< of transmission [s]
  std::int64_t sweep = 0;   ///< of a scanning head, from 0; else 0
  double scan_angle = 0;    ///< of a scanning head [rad], positive to port; else 0
};

/// All pings of a mission, head after head in its order, those of a head in the order of time: a function of the
/// mission alone. Every leg begins with a ping and a new sweep. Throws Error(argument) for an invalid mission, for
/// pings of a head closer than its listening time (naming both and the figure), or if there is no ping at all.
std::vector<SurveyPing> survey_pings(const Mission& mission);

/// Where a head is when it pings, and how it moves then.
struct PingPlace {
  Pose world_from_head;
  Motion motion;  ///< of the head's origin, with the lever arm about the vehicle's
};

/// Pose and motion of a ping: the vehicle's at its time (pose_at, motion_at), the mounting of the head and its scan
/// angle. Takes time that grows with the logarithm of the trajectory's length. Throws as pose_at.
PingPlace place_of(const Mission& mission, const SurveyPing& ping);

/// Where the vehicle believes a head to be when it pings: by the mission's navigation errors beside place_of.
Pose believed_place_of(const Mission& mission, const SurveyPing& ping);

/// Number of the ping by which simulate_ping draws its random numbers: apart for all pings of all heads, and equal to
/// `number` in its lower 40 bits.
std::int64_t random_number_of(const SurveyPing& ping);

/// Consecutive pings of one head that are stored together: the unit of work that is done or not done.
struct SurveyBlock {
  std::size_t head = 0;
  std::int64_t number = 0;         ///< among the blocks of this head, from 0
  std::size_t begin = 0, end = 0;  ///< indices into survey_pings
};

/// Divides the pings of every head into blocks of `per_block[head]` pings (the last one may be shorter), in the order
/// of the pings.
std::vector<SurveyBlock> survey_blocks(const std::vector<SurveyPing>& pings, const std::vector<std::size_t>& per_block);

}  // namespace insonify

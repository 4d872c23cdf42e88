#pragma once
#include "returns/ping.hpp"

namespace insonify {

/// When and from where a ping was sent.
struct TrackPoint {
  std::int64_t number = 0;
  double time = 0;  ///< [s]
  Pose world_from_head = Pose::Identity();
  std::optional<ScanPlace> scan{};  ///< of a scanning head
  double sound_speed = 0;           ///< as Ping::sound_speed
  double absorption_db_per_m = 0;   ///< as Ping::absorption_db_per_m
  Motion motion{};                  ///< as Ping::motion
};

/// Returns the place of a ping.
inline TrackPoint track_point_of(const Ping& ping) {
  return {ping.number, ping.time, ping.world_from_head, ping.scan, ping.sound_speed, ping.absorption_db_per_m,
          ping.motion};
}

}  // namespace insonify

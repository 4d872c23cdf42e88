// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// One ping of an Oculus imaging sonar.
struct OculusPing {
  Grid<std::uint32_t> value;  ///< beams x ranges, as stored
  int bits = 8;               ///< size of a value: 8, 16 or 32
  BeamFan fan;                ///< bearings as stored; width: mean spacing; elevation width: follows from the mode
  RangeGate gate;             ///< ranges are bins, from 0 on
  std::size_t pings = 0;      ///< number of pings in the file
  std::uint32_t number = 0;   ///< number of the ping, counted by the sonar
  double frequency = 0;       ///< [Hz]
  double sound_speed = 0;     ///< sound speed in the sonar's settings [m/s]
  double time = 0;            ///< time since the sonar was switched on [s]; 0: unknown
  double heading = 0, pitch = 0, roll = 0;  ///< [rad], as stored; 0 if the message has none
  double gain_percent = 0;
  double gamma = 1;            ///< value ~ amplitude^gamma
  std::vector<float> gains{};  ///< gain of each range; empty: not sent
  bool high_frequency = false;
};

/// Returns ping `number` of a log of messages of the Oculus SDK (Blueprint Subsea). The log holds ping results of
/// version 1 and 2, one after the other as the sonar sends them, or as uncompressed items of a log of the maker's
/// viewer. Messages and items of other kinds are skipped. Throws Error(file) if the file cannot be read; Error(content)
/// if it is not such a log, is truncated or damaged (naming message and byte), compressed, or has no ping;
/// Error(argument) unless number < pings.
OculusPing read_oculus_ping(const std::string& path, std::size_t number);

/// Returns the levels of a ping [dB re full scale], beams x ranges: 20 log10(value / full scale) / gamma; silence_db
/// for the value 0.
Grid<float> level_db(const OculusPing& ping);

}  // namespace insonify

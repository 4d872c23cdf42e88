// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/grid.hpp"
#include "returns/quantise.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Levels of the grey values 0 and 255 in an ARIS recording [dB re an unknown reference]; levels between are linear.
inline constexpr GreyWindow aris_scale{0, 80};

/// One frame of an ARIS recording.
struct ArisFrame {
  Grid<std::uint8_t> grey;   ///< beams x samples
  BeamFan fan;               ///< azimuths to 0.2 degrees, from the lens of the model; widths are the mean spacing
  RangeGate gate;            ///< samples are bins
  std::size_t frames = 0;    ///< number of frames in the file
  double time = 0;           ///< UTC, seconds since 1970
  double sound_speed = 0;    ///< [m/s]
  double temperature_c = 0;  ///< temperature of the water
  double pulse_length = 0;   ///< [s]
  double receiver_gain_db = 0;
  std::string model;  ///< ARIS 1200, 1800 or 3000
};

/// Returns frame `number` of a recording (.aris, version DDF_05). The file holds a header of 1024 bytes, then frames;
/// each has a header of 1024 bytes and beams x samples of 8 bits, sample by sample, the starboard beam first. The
/// layout follows the public headers of SoundMetrics/aris-file-sdk. Throws Error(file) if the file cannot be read;
/// Error(content) if it is not such a recording, is of the other byte order, is truncated, lacks the geometry (sound
/// speed, sample period) or reaches beyond any sonar's (1 km), or has samples out of order; Error(argument) unless
/// number < frames.
ArisFrame read_aris_frame(const std::string& path, std::size_t number);

/// Returns the levels of a frame [dB re unknown], beams x samples.
Grid<float> level_db(const ArisFrame& frame);

}  // namespace insonify

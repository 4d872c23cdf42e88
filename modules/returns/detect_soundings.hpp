// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

#include "acoustics/echoes.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

class EchoStream;
struct SceneCloud;

/// Thresholds of detect_soundings.
struct DetectionOptions {
  double noise_floor_db = -std::numeric_limits<double>::infinity();  ///< noise level in a beam [dB re 1 uPa]
  double threshold_db = 11.4;       ///< threshold above the noise floor; 11.4 dB is one false alarm in 10^6 (E19)
  double side_lobe_margin_db = 25;  ///< samples this far below the strongest beam near their range are side lobes
  /// "Near" in side_lobe_margin_db [m]; 0: the same bin. With a wide band, side lobes reach half the array's length in
  /// range, because an echo from beside the beam meets the elements at different times.
  double side_lobe_reach = 0;
  /// Probability that speckle as strong as its surroundings exceeds the threshold above the surroundings (E78), within
  /// 0 and 1; 1: surroundings are ignored.
  double false_alarm_rate = 1e-3;
  double range_resolution = 0;  ///< length of a resolution cell [m]: a beam has at most one sounding in it; 0: a bin
  bool all_bins = false;        ///< true: detect every bin above `above_db`, not only local maxima
  double above_db = -std::numeric_limits<double>::infinity();  ///< least level with all_bins [dB re 1 uPa]
  int threads = 0;                                             ///< 0: all cores
  /// Scene of the scatterers, whose ids true_surfel holds. Null: true_surfel is the upper half of Scatterers::id.
  const SceneCloud* scene = nullptr;
};

/// Returns the threshold over the mean of `cells` independent cells of exponential intensity: another such cell exceeds
/// the mean times this factor with probability `false_alarm_rate`. The factor is cells (rate^(-1 / cells) - 1) (E78;
/// Finn and Johnson 1968).
double background_factor(double false_alarm_rate, int cells);

/// Returns the detections of a ping as points. A sounding is a local maximum along range in a beam that meets three
/// conditions:
///
///   - it exceeds the noise floor by the threshold,
///   - it is not a side lobe (E19),
///   - it exceeds the mean of up to 16 resolution cells on either side, two cells off, by background_factor (E78).
///
/// With all_bins, every bin above a level is a sounding instead. Maxima are at least a resolution cell apart, rounded
/// up to bins. Range and level of a maximum are those of the parabola through its level and the levels beside it (E72).
/// The parabola is exact for a single Gaussian pulse; bins as long as the pulse sample its peak up to 3 dB low. With
/// all_bins, range and level are those of the bin.
///
/// The ping alone decides: noise, reverberation and side lobes are detected as any echo. `stream` only gives the
/// columns true_... and the direction in which the cloud shows a sounding. Both come from the strongest contributing
/// scatterer within one bin length. The search covers the beam's own cell of the fan first, then its -3 dB width (in
/// azimuth, and in elevation for a fan of several rows or a planar array).
///
/// stream   scatterers and echoes from which the ping was synthesized; may be empty
///
/// The cost is two passes over the ping, plus making the parts of surfels near detections again. The result does not
/// depend on options.threads. Throws Error for a rate outside (0, 1], or a resolution or reach that is not >= 0.
Soundings detect_soundings(const Ping& ping, const EchoStream& stream, const DetectionOptions& options = {});

/// Also takes double echoes (`doubles`, at apparent_positions) beside the direct ones, and sets true_order.
Soundings detect_soundings(const Ping& ping, const EchoStream& direct, const EchoStream& doubles,
                           const DetectionOptions& options);

/// Takes stored scatterers and echoes, matched by index, in place of a stream. Throws Error if their numbers differ.
Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options = {});

}  // namespace insonify

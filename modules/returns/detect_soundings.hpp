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
  double threshold_db = 11.4;       ///< above the noise floor; 11.4 dB is one false alarm in 10^6 (E19)
  double side_lobe_margin_db = 25;  ///< samples this far below the strongest beam about their range are side lobes
  /// How far about [m]: of a wide band they reach half the array's length in range, since an echo from beside a beam
  /// meets its elements at different times. 0: the same bin.
  double side_lobe_reach = 0;
  /// Probability that speckle as strong as its surroundings exceeds the threshold above them (E78), within 0 and 1; 1:
  /// surroundings do not count.
  double false_alarm_rate = 1e-3;
  double range_resolution = 0;  ///< length of a resolution cell [m]: a beam has at most one sounding in it; 0: a bin
  bool all_bins = false;        ///< detect every bin above `above_db`, not only local maxima
  double above_db = -std::numeric_limits<double>::infinity();  ///< [dB re 1 uPa], with all_bins
  int threads = 0;                                             ///< 0: all cores
  /// Of which the patches are: soundings name surfels by its ids. Null: by the upper halves of Scatterers::id.
  const SceneCloud* scene = nullptr;
};

/// Factor above the mean of `cells` independent cells of exponential intensity that another such cell exceeds with
/// probability `false_alarm_rate`: cells (rate^(-1 / cells) - 1) (E78; Finn and Johnson 1968).
double background_factor(double false_alarm_rate, int cells);

/// Returns the detections of a ping as points. In each beam every local maximum along range that exceeds the
/// noise floor by the threshold and is not a side lobe (E19), and exceeds the mean of up to 16 resolution cells on
/// either side, two cells off, by background_factor (E78), gives one sounding; with all_bins, every bin above a level
/// does. Maxima are a resolution cell apart at least, rounded up to bins. Range and level of a maximum are those of the
/// parabola through its level and those beside it (E72): exact for a Gaussian pulse alone, whose peak bins as long as
/// the pulse sample up to 3 dB low. With all_bins they are those of the bin. The ping alone decides: noise,
/// reverberation and side lobes are detected as any echo. `stream` gives only the columns true_..., and the direction
/// in which the cloud shows a sounding: those of the strongest contributing scatterer within one bin length, searched
/// in the beam's own share of the fan and then in its -3 dB width (in azimuth, and in elevation for a fan of several
/// rows or a planar array).
///
/// stream   patches and echoes the ping was synthesized from; may be empty
///
/// Cost: two reads of the ping, and the parts of surfels near detections made again. The result does not depend on
/// options.threads. Throws Error for a rate outside (0, 1], or a resolution or reach that is not >= 0.
Soundings detect_soundings(const Ping& ping, const EchoStream& stream, const DetectionOptions& options = {});

/// The same with the echoes by way of two surfaces (apparent_places) beside the direct ones; sets true_order.
Soundings detect_soundings(const Ping& ping, const EchoStream& direct, const EchoStream& doubles,
                           const DetectionOptions& options);

/// The same for patches and echoes that are stored, index by index; throws Error if their numbers differ.
Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options = {});

}  // namespace insonify

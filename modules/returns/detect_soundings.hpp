#pragma once
#include <limits>

#include "acoustics/echoes.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

struct DetectionOptions {
  double noise_floor_db = -std::numeric_limits<double>::infinity();  ///< noise level in a beam [dB re 1 uPa]
  double threshold_db = 11.4;       ///< above the noise floor; 11.4 dB is one false alarm in 10^6 (E19)
  double side_lobe_margin_db = 25;  ///< samples this far below the strongest beam at the same range are side lobes
  bool all_bins = false;            ///< detect every bin above `above_db`, not only local maxima above the noise floor
  double above_db = -std::numeric_limits<double>::infinity();  ///< [dB re 1 uPa], with all_bins
  int threads = 0;                                             ///< 0: all cores
};

/// Returns the detections of a ping as points (E19). In each beam every local maximum along range that exceeds the
/// noise floor by the threshold and is not a side lobe gives one sounding; with all_bins, every bin above a level does.
/// Range and level of a maximum are those of the parabola through its level and those beside it (E72): exact for a
/// Gaussian pulse alone, whose peak bins as long as the pulse sample up to 3 dB low. With all_bins they are those of the
/// bin. The direction is that of the strongest contributing scatterer within one bin length,
/// searched in the beam's own share of the fan and then in its -3 dB width (in azimuth, and in elevation for a fan of
/// several rows or a planar array). Samples without a contributor (side lobes) give no sounding.
///
/// scatterers, echoes   those the ping was synthesized from, index by index; throws Error if their numbers differ
Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options = {});

}  // namespace insonify

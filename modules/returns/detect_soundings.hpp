#pragma once
#include <limits>

#include "acoustics/echoes.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

struct DetectionOptions {
  double noise_floor_db = -std::numeric_limits<double>::infinity();  ///< [dB re 1 uPa] of a beam
  double threshold_db = 11.4;       ///< above the noise floor; 11.4 dB is one false alarm in 10^6 (E19)
  double side_lobe_margin_db = 25;  ///< a sample so far below the strongest beam at its range is leakage, not a target
  bool all_bins = false;            ///< every bin above `above_db`, not only range maxima above the floor
  double above_db = -std::numeric_limits<double>::infinity();  ///< [dB re 1 uPa], with all_bins
  int threads = 0;                                             ///< 0: all cores
};

/// Turns a ping into points (E19). Per beam, each local maximum along range that exceeds the noise floor by the
/// threshold and is no side lobe gives one sounding; with all_bins, every bin above a level. Its direction is that
/// of the strongest contributing scatterer within one bin length, in the beam's own share of the fan or, if there is
/// none, in its -3 dB width, in azimuth and, for a fan of several rows or a planar array, in elevation; its range is the
/// bin's. Samples without a contributor (leakage through side lobes) give none.
///
/// scatterers and echoes are those the ping was made from, index by index.
Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options = {});

}  // namespace insonify

#pragma once
#include "acoustics/hear_scatterers.hpp"

namespace insonify {

/// What all echoes of one ping have in common.
struct Transmission {
  Pulse pulse;
  Medium medium;
  HearingOptions hearing;
};

}  // namespace insonify

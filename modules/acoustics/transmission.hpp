// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/direct_echoes.hpp"

namespace insonify {

/// What all echoes of one ping have in common.
struct Transmission {
  Pulse pulse;
  Medium medium;
  EchoOptions echo_options;
};

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/simulated_ping.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Returns the head that listens where the beams of `head` truly point, and when its samples are truly taken, if it is
/// set to another sound speed (E215): an array that delays its elements for direction cosines u' in water of c' hears
/// from u = u' c / c', and a sample of range c' t / 2 comes from c t / 2. A planar array steers both cosines, a line
/// array the one along it.
///
/// sound_speed  c, of the water at the head [m/s]
/// assumed      c', that the head is set to [m/s]
///
/// Throws Error(argument) for a beam that c' steers beyond the end of the array, and as require_valid of a head.
SonarHead steered_head(const SonarHead& head, double sound_speed, double assumed);

/// Changes a ping of steered_head into what the head reports: beams, ranges and sound speed as it is set, and the
/// places of detections along its beams.
void report_as_set(const SonarHead& head, double sound_speed, double assumed, SimulatedPing& simulated);

}  // namespace insonify

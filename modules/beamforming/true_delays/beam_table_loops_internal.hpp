// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Loops over raw pointers, compiled for several instruction sets and chosen at run time, with the same bits on each.
// They include no Eigen, so wide registers are safe.
namespace insonify::kernels {

/// The focus of a beam for an element at `y`: direction cosine u, and range `range` + j `step` [m] at sample j.
struct ElementFocus {
  double range, step, u, y;
};

/// Writes for `count` samples the distance from the focus to the element, less that from the focus to the centre of the
/// array [m] (E61).
void focus_at(const ElementFocus& focus, std::size_t count, double* path);

/// A Gaussian pulse at the elements: sample j is `late` + `start` + j `step` after the echo's delay [s].
struct ElementPulse {
  double start, step, late;
  double carrier;  ///< carrier frequency [Hz]
  double speed;    ///< speed of sound [m/s]
  double a, b;     ///< numbers of its EchoEnvelope (E8)
};

/// Adds the contribution of one element to a beam, for the samples j of [begin, end): weight exp(-2 pi i f (D + late))
/// G(t + D), with t the time after the delay and D = (focus[j] - path) / c. `path` is the path difference between echo
/// and element, `focus[j]` that of the beam's focus [m].
void add_element(const ElementPulse& pulse, const double* focus, double path, double weight, std::size_t begin,
                 std::size_t end, double* re, double* im);

constexpr std::size_t most_ranges = 4;                    ///< nodes of range in a BeamTable at most
constexpr std::size_t direction_taps = 8, time_taps = 8;  ///< taps of an interpolation in a BeamTable
constexpr std::size_t taps_before = 3;      ///< taps before the interpolated interval, of direction and time
constexpr std::size_t numbers_at_once = 8;  ///< the length of a row of the table is a multiple of this

/// The rows of a table that give one response, and their weights: row (c, g, q) begins at c plane + g line + q row.
struct ResponseTaps {
  std::size_t ranges;  ///< at most most_ranges
  float range[most_ranges], direction[direction_taps], time[time_taps];
  std::size_t plane, line, row;  ///< numbers from one range, direction, and time to the next
  std::size_t eights;            ///< summed groups of eight numbers of a row
};

/// Writes the sum of the rows times their weights, 8 taps.eights numbers of each.
void sum_response(const float* first, const ResponseTaps& taps, float* response);

}  // namespace insonify::kernels

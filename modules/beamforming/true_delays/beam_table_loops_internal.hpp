// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Loops over raw pointers, compiled for several instruction sets and chosen at run time, with the same bits on each.
// They include no Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Where a beam is focused at each sample, as an element at `y` sees it: the range is `range` + j `step` [m].
struct ElementFocus {
  double range, step, u, y;
};

/// Writes by how much the element is farther from the focus than the centre of the array is [m], for `count` samples
/// (E61).
void focus_at(const ElementFocus& focus, std::size_t count, double* path);

/// A Gaussian pulse at the elements: sample j is `late` + `start` + j `step` after the echo's delay [s].
struct ElementPulse {
  double start, step, late;
  double carrier;  ///< [Hz]
  double speed;    ///< of sound [m/s]
  double a, b;     ///< of its EchoEnvelope (E8)
};

/// Adds what one element contributes to a beam: weight exp(-2 pi i f (D + late)) G(t + D), t the time after the delay
/// and D = (focus[j] - path) / c, for the samples j of [begin, end). `path` is the path difference of the echo to the
/// element,
/// `focus[j]` that of the beam's focus [m].
void add_element(const ElementPulse& pulse, const double* focus, double path, double weight, std::size_t begin,
                 std::size_t end, double* re, double* im);

constexpr std::size_t most_ranges = 4;                    ///< that a BeamTable is interpolated between
constexpr std::size_t direction_taps = 8, time_taps = 8;  ///< of an interpolation in a BeamTable
constexpr std::size_t taps_before = 3;                    ///< the interval that is interpolated, of direction and time
constexpr std::size_t numbers_at_once = 8;                ///< a row of the table holds a multiple of so many numbers

/// The rows of a table that give one response, and their weights: row (c, g, q) begins at c plane + g line + q row.
struct ResponseTaps {
  std::size_t ranges;  ///< at most most_ranges
  float range[most_ranges], direction[direction_taps], time[time_taps];
  std::size_t plane, line, row;  ///< numbers from one range, direction, and time to the next
  std::size_t eights;            ///< of a row that are summed
};

/// Writes the sum of the rows times their weights, 8 taps.eights numbers of each.
void sum_response(const float* first, const ResponseTaps& taps, float* response);

}  // namespace insonify::kernels

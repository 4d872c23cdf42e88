// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "view/placed_text.hpp"

namespace insonify {

/// Returns the smallest of 1, 2, 5 x 10^n that is >= at_least (> 0).
double round_step(double at_least);

/// Returns the smallest customary step of angles [degrees] (.. 1, 2, 5, 10, 15, 20, 30, 45, 60, 90, 180) >= at_least.
double round_angle_step(double at_least);

/// Returns the multiples of step within [low, high] up to rounding, ascending.
std::vector<double> multiples(double step, double low, double high);

/// Formats a number with the decimals that multiples of `step` need; no negative zero.
std::string number_text(double value, double step);

/// Formats a bearing [degrees], wrapped into (-180, 180], with its sign: "-60°", "0°", "+7.5°", "180°".
std::string bearing_text(double bearing_deg, double step);

/// Tick values [degrees] for bearings in [low, high]: at most `most` of them; only the middle if no round one fits.
struct BearingTicks {
  double step = 1;
  std::vector<double> at_deg;
};
BearingTicks bearing_ticks(double low_deg, double high_deg, double most);

/// Tick values of an axis and their labels.
struct AxisTicks {
  std::vector<double> at;
  std::vector<std::string> labels;
};

/// Returns ticks at round values in [low, high], at most about `most` of them.
AxisTicks round_ticks(double low, double high, double most);

/// Returns ticks at round bearings in [low, high] [degrees], at most `most` of them.
AxisTicks bearing_labels(double low_deg, double high_deg, double most);

/// Returns the ticks of a logarithmic axis with decimal logarithms `low` and `high`: powers of ten, every second or
/// third of them if there are many; 1, 2 and 5 times powers of ten if the axis spans less than two decades.
AxisTicks decade_ticks(double low, double high, double most);

/// A frame with ticks and labels outside and grid lines inside.
struct Axes {
  Box frame;
  double low_x = 0, high_x = 1, low_y = 0, high_y = 1;  ///< values at the sides of the frame
  std::vector<Path> ticks, grid;
  std::vector<PlacedText> texts;  ///< labels and axis titles

  Point2 at(double x, double y) const;
};

/// Returns the corners of a box, and the first again.
Path outline(const Box& box);

/// Return the space that labels and title of an axis need below the frame, and left of it [pixels].
double room_below(int font_size);
double room_left(const AxisTicks& ticks, int font_size);

void add_axis_across(Axes& axes, const AxisTicks& ticks, const std::string& title, int font_size);
void add_axis_upwards(Axes& axes, const AxisTicks& ticks, const std::string& title, int font_size);

}  // namespace insonify

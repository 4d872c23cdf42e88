#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace insonify {

/// Smallest of 1, 2, 5 x 10^n that is >= at_least (> 0).
double round_step(double at_least);

/// Smallest customary step of angles [degrees] (.. 1, 2, 5, 10, 15, 20, 30, 45, 60, 90, 180) that is >= at_least.
double round_angle_step(double at_least);

/// Multiples of step within [low, high] up to rounding, ascending.
std::vector<double> multiples(double step, double low, double high);

/// A number with the decimals that multiples of `step` need; no negative zero.
std::string number_text(double value, double step);

/// A bearing [degrees], wrapped into (-180, 180], with its sign: "-60°", "0°", "+7.5°", "180°".
std::string bearing_text(double bearing_deg, double step);

/// Tick values [degrees] for bearings in [low, high]: at most `most` of them; only the middle if no round one fits.
struct BearingTicks {
  double step = 1;
  std::vector<double> at_deg;
};
BearingTicks bearing_ticks(double low_deg, double high_deg, double most);

}  // namespace insonify

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "view/ticks_internal.hpp"

namespace insonify {

double round_step(double at_least) {
  const double decade = std::pow(10.0, std::floor(std::log10(at_least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= at_least * (1 - 1e-9)) return factor * decade;
  return 10 * decade;
}

double round_angle_step(double at_least) {
  for (const double step : {1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0})
    if (at_least > 0.5 && step >= at_least * (1 - 1e-9)) return step;
  return at_least > 0.5 ? 180.0 : round_step(at_least);
}

std::vector<double> multiples(double step, double low, double high) {
  const double slack = 1e-6 * step;
  std::vector<double> values;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; ++n) values.push_back(n * step);
  return values;
}

std::string number_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  if (std::abs(value) < 1e-6 * step) value = 0;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string bearing_text(double bearing_deg, double step) {
  double turned = std::remainder(bearing_deg, 360.0);
  if (turned < -180.0 + 1e-6 * step) turned += 360.0;
  const bool plus = turned > 1e-6 * step && turned < 180.0 - 1e-6 * step;
  std::string text(plus ? "+" : "");
  text += number_text(turned, step);
  text += "°";
  return text;
}

BearingTicks bearing_ticks(double low_deg, double high_deg, double most) {
  BearingTicks ticks;
  ticks.step = round_angle_step((high_deg - low_deg) / most);
  ticks.at_deg = multiples(ticks.step, low_deg, high_deg);
  if (!ticks.at_deg.empty()) return ticks;
  ticks.step = round_step((high_deg - low_deg) / 10.0);
  ticks.at_deg = {(low_deg + high_deg) / 2};
  return ticks;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "view/axes_internal.hpp"

namespace insonify {
namespace {

// Lengths in font sizes: of a tick, from the frame to its label, and from the label to the title.
constexpr double picture_tick = 0.4, to_label = 0.6, to_title = 0.25;

double line_height(int font_size) { return text_size("0", font_size).height; }

double widest_label(const AxisTicks& ticks, int font_size) {
  double widest = 0;
  for (const std::string& label : ticks.labels) widest = std::max(widest, text_size(label, font_size).width);
  return widest;
}

/// Formats mantissa x 10^decade: "0.002", "50", "10000", and beyond that "2e-7".
std::string power_text(int mantissa, int decade) {
  if (decade > 5 || decade < -3) return std::to_string(mantissa) + "e" + std::to_string(decade);
  std::string digits = std::to_string(mantissa);
  if (decade >= 0) return digits + std::string(static_cast<std::size_t>(decade), '0');
  return "0." + std::string(static_cast<std::size_t>(-decade - 1), '0') + digits;
}

}  // namespace

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
  return printed("%.*f", decimals, value);
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

AxisTicks round_ticks(double low, double high, double most) {
  const double step = round_step((high - low) / std::max(most, 2.0));
  AxisTicks ticks;
  ticks.at = multiples(step, low, high);
  for (const double value : ticks.at) ticks.labels.push_back(number_text(value, step));
  return ticks;
}

AxisTicks bearing_labels(double low_deg, double high_deg, double most) {
  const BearingTicks bearings = bearing_ticks(low_deg, high_deg, most);
  AxisTicks ticks{bearings.at_deg, {}};
  for (const double at : ticks.at) ticks.labels.push_back(bearing_text(at, bearings.step));
  return ticks;
}

AxisTicks decade_ticks(double low, double high, double most) {
  AxisTicks ticks;
  const bool few = high - low < 2;
  const double step = few ? 1 : std::max(1.0, std::ceil((high - low) / std::max(most, 2.0)));
  for (double decade = step * std::floor(low / step); decade <= high; decade += step)
    for (const int mantissa : {1, 2, 5}) {
      const double at = decade + std::log10(static_cast<double>(mantissa));
      if ((mantissa > 1 && !few) || at < low - 1e-9 || at > high + 1e-9) continue;
      ticks.at.push_back(at);
      ticks.labels.push_back(power_text(mantissa, static_cast<int>(decade)));
    }
  return ticks;
}

Point2 Axes::at(double x, double y) const {
  return {frame.left + frame.width() * (x - low_x) / (high_x - low_x),
          frame.bottom + frame.height() * (y - low_y) / (high_y - low_y)};
}

Path outline(const Box& box) {
  return {{box.left, box.bottom},
          {box.right, box.bottom},
          {box.right, box.top},
          {box.left, box.top},
          {box.left, box.bottom}};
}

double room_below(int font_size) { return (to_label + to_title) * font_size + 2 * line_height(font_size); }

double room_left(const AxisTicks& ticks, int font_size) {
  return (to_label + to_title) * font_size + widest_label(ticks, font_size) + line_height(font_size);
}

void add_axis_across(Axes& axes, const AxisTicks& ticks, const std::string& title, int font_size) {
  const Box& frame = axes.frame;
  const double line = line_height(font_size), labels_top = frame.bottom - to_label * font_size;
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    const double x = axes.at(ticks.at[i], 0).x;
    axes.ticks.push_back({{x, frame.bottom - picture_tick * font_size}, {x, frame.bottom}});
    axes.grid.push_back({{x, frame.bottom}, {x, frame.top}});
    axes.texts.push_back({ticks.labels[i], {x, labels_top - line / 2}, font_size});
  }
  const FittedText fitted = fit_text(title, font_size, frame.width());
  axes.texts.push_back({fitted.text,
                        {(frame.left + frame.right) / 2, labels_top - 1.5 * line - to_title * font_size},
                        fitted.font_size});
}

void add_axis_upwards(Axes& axes, const AxisTicks& ticks, const std::string& title, int font_size) {
  const Box& frame = axes.frame;
  const double line = line_height(font_size), labels_right = frame.left - to_label * font_size;
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    const double y = axes.at(0, ticks.at[i]).y, width = text_size(ticks.labels[i], font_size).width;
    axes.ticks.push_back({{frame.left - picture_tick * font_size, y}, {frame.left, y}});
    axes.grid.push_back({{frame.left, y}, {frame.right, y}});
    axes.texts.push_back({ticks.labels[i], {labels_right - width / 2, y}, font_size});
  }
  const double title_right = labels_right - widest_label(ticks, font_size) - to_title * font_size;
  const FittedText fitted = fit_text(title, font_size, frame.height());
  axes.texts.push_back({fitted.text, {title_right - line / 2, (frame.bottom + frame.top) / 2}, fitted.font_size, true});
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the sweep of error against run time.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "tool/accuracy/accuracy_files.hpp"
#include "view/line_chart_internal.hpp"

namespace insonify::tool {
namespace {

using Rows = std::vector<AccuracyRow>;

/// Errors of zero are drawn at this level, since the axis is logarithmic.
constexpr double smallest_error = 1e-17;

Rows of_sweep(const Rows& rows, const std::string& sweep) {
  Rows some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some), [&](const auto& r) { return r.sweep == sweep; });
  return some;
}

std::string count_text(double count) {
  if (count < 1e4) return fmt::format("{:g}", count);
  return fmt::format("{} {:03}", static_cast<int>(count) / 1000, static_cast<int>(count) % 1000);
}

std::string size_text(const AccuracyRow& r) {
  return fmt::format("{} scatterers, {} beams, {} bins", count_text(static_cast<double>(r.scatterers)), r.beams,
                     r.bins);
}

/// Lines of one chart by name, in the order of their first point; ends of the axes follow from the points.
class Plot {
 public:
  explicit Plot(LineChart chart) : chart_(std::move(chart)) {}

  void add(const std::string& name, double x, double y, const std::string& label = {}) {
    ChartLine& line = named(name);
    line.x.push_back(x);
    line.y.push_back(y);
    line.labels.push_back(label);
  }
  void add_guide(const std::string& name, std::vector<double> x, std::vector<double> y) {
    guides_.push_back({std::move(x), std::move(y), name, LineStyle::dashed});
  }

  bool draw(const std::string& path) {
    if (lines_.empty()) return false;
    fit(chart_.x_scale, &ChartLine::x, chart_.low_x, chart_.high_x);
    fit(chart_.y_scale, &ChartLine::y, chart_.low_y, chart_.high_y);
    chart_.lines = lines_;
    chart_.lines.insert(chart_.lines.end(), guides_.begin(), guides_.end());
    PictureOptions picture;
    picture.width = 1100, picture.height = 800;
    draw_line_chart(chart_, picture, "accuracy", path);
    return true;
  }

 private:
  ChartLine& named(const std::string& name) {
    for (ChartLine& line : lines_)
      if (line.name == name) return line;
    lines_.push_back({{}, {}, name, LineStyle::marked});
    return lines_.back();
  }

  /// Widens an axis by a margin around the points.
  void fit(AxisScale scale, std::vector<double> ChartLine::*values, double& low, double& high) const {
    low = INFINITY, high = -INFINITY;
    for (const ChartLine& line : lines_)
      for (const double value : line.*values) low = std::min(low, value), high = std::max(high, value);
    if (scale == AxisScale::logarithmic) {
      low *= 0.4, high *= 2.5;
    } else {
      const double room = high > low ? 0.08 * (high - low) : 1;
      low -= room, high += room;
    }
  }

  LineChart chart_;
  std::vector<ChartLine> lines_, guides_;
};

LineChart log_log(const std::string& title, const std::string& x_title, const std::string& y_title) {
  LineChart chart;
  chart.title = title, chart.x_title = x_title, chart.y_title = y_title;
  chart.x_scale = chart.y_scale = AxisScale::logarithmic;
  return chart;
}

constexpr const char* error_title = "Relative L2 error of the complex image";
constexpr const char* time_title = "Wall time of a ping [s], median";

/// "1e-6": two digits of exponent where they are needed.
std::string tolerance_text(double tolerance) {
  std::string text = fmt::format("{:.0e}", tolerance);
  if (const std::size_t zero = text.find("-0"); zero != std::string::npos) text.erase(zero + 1, 1);
  return text;
}

/// The label of a marker.
std::string setting_text(const AccuracyRow& r) {
  if (r.method == "pattern-cut") return fmt::format("{:g} nulls", r.parameter);
  return r.tolerance > 0 ? tolerance_text(r.tolerance) : "";
}

std::string line_name(const AccuracyRow& r) { return r.method == "gridded" ? "gridded, " + r.precision : r.method; }

bool draw_work_precision(const Rows& all, const std::string& path) {
  const Rows rows = of_sweep(all, "work-precision");
  if (rows.empty()) return false;
  Plot plot(log_log("Error against run time: " + size_text(rows[0]), error_title, time_title));
  for (const AccuracyRow& r : rows)
    plot.add(line_name(r), std::max(r.error, smallest_error), r.seconds, setting_text(r));
  return plot.draw(path);
}

bool draw_crossover(const Rows& all, const std::string& path) {
  Rows rows = of_sweep(all, "scatterers");
  if (rows.empty()) return false;
  Plot plot(log_log(fmt::format("Run time against scatterers: {} beams, {} bins", rows[0].beams, rows[0].bins),
                    "Scatterers", time_title));
  for (const AccuracyRow& r : rows)
    plot.add(r.tolerance > 0 ? r.method + ", " + tolerance_text(r.tolerance) : r.method,
             static_cast<double>(r.scatterers), r.seconds);
  return plot.draw(path);
}

/// Every gridded error of the sweep over its tolerance.
bool draw_promise(const Rows& rows, const std::string& path) {
  Plot plot(log_log("What is promised and what is kept: all sizes, bands and dynamic ranges", "Tolerance asked for",
                    "Relative L2 error"));
  std::map<double, double> worst, least, local;
  for (const AccuracyRow& r : rows) {
    if (r.method != "gridded" || r.error == 0) continue;
    worst[r.tolerance] = std::max(worst[r.tolerance], r.error);
    local[r.tolerance] = std::max(local[r.tolerance], r.local_error);
    const auto entry = least.try_emplace(r.tolerance, r.error).first;
    entry->second = std::min(entry->second, r.error);
  }
  for (const auto& [tolerance, error] : worst) plot.add("worst image", tolerance, error);
  for (const auto& [tolerance, error] : local) plot.add("worst eighth of a range axis", tolerance, error);
  for (const auto& [tolerance, error] : least) plot.add("best image", tolerance, error);
  if (!worst.empty()) {
    const double low = worst.begin()->first, high = worst.rbegin()->first;
    plot.add_guide("the promise", {low, high}, {low, high});
  }
  return plot.draw(path);
}

/// Own error of each engine against time, on the wide band; for the narrow band that of its model too.
bool draw_engines(const Rows& all, const std::string& path) {
  Plot plot(log_log("Engines on a wide band: 200 kHz about 600 kHz, 48 beams, 1 000 echoes",
                    "Relative L2 error against the image with true delays, or of the expected level", time_title));
  for (const AccuracyRow& r : of_sweep(all, "engines"))
    if (r.task == "wide band" && r.refused.empty())
      plot.add(r.method, std::max(std::hypot(r.error, r.model_error), smallest_error), r.seconds, setting_text(r));
  return plot.draw(path);
}

bool draw_local_error(const Rows& all, const std::string& path) {
  LineChart chart = log_log("The error where the echoes are weakest", "Dynamic range over the range axis [dB]",
                            "Relative L2 error, worst eighth of the range axis");
  chart.x_scale = AxisScale::linear;
  Plot plot(chart);
  for (const AccuracyRow& r : of_sweep(all, "dynamic-range"))
    if (r.method == "spectrum" || r.method == "direct" || r.tolerance == 1e-2 || r.tolerance == 1e-4 ||
        r.tolerance == 1e-8 || r.tolerance == 1e-12)
      plot.add(r.tolerance > 0 ? "gridded, " + tolerance_text(r.tolerance) : r.method, r.dynamic_range_db,
               std::max(r.local_error, smallest_error));
  return plot.draw(path);
}

bool draw_sampling(const std::vector<SamplingErrorRow>& rows, const std::string& path) {
  Plot plot(log_log("Sampling error of the mean level of a flat bottom", "Scatterers per beam",
                    "Relative error of the mean power, rms over beams"));
  for (const SamplingErrorRow& r : rows)
    if (r.error > 0 && r.scatterers_per_beam > 0)
      plot.add(r.sampling, r.scatterers_per_beam, r.error,
               r.sampling == "surfels"         ? fmt::format("{:.0f} per m²", r.parameter)
               : r.sampling == "split-surfels" ? fmt::format("{:g} per cell", r.parameter)
                                               : "");
  if (!rows.empty() && rows.front().sampling == "random-rays") {
    const double n = rows.front().scatterers_per_beam, e = rows.front().error;
    plot.add_guide("slope -1/2", {n, 1e4 * n}, {e, 1e-2 * e});
    plot.add_guide("slope -1", {n, 1e4 * n}, {e, 1e-4 * e});
  }
  return plot.draw(path);
}

}  // namespace

std::vector<std::string> draw_accuracy(const Rows& rows, const std::vector<SamplingErrorRow>& sampling,
                                       const RunDirectory& directory) {
  std::vector<std::string> drawn;
  const auto keep = [&](bool (*draw)(const Rows&, const std::string&), const char* name) {
    if (draw(rows, directory.file(name))) drawn.emplace_back(name);
  };
  keep(draw_work_precision, "work_precision.png");
  keep(draw_crossover, "crossover.png");
  keep(draw_promise, "promise.png");
  keep(draw_local_error, "local_error.png");
  keep(draw_engines, "engines.png");
  if (draw_sampling(sampling, directory.file("sampling.png"))) drawn.emplace_back("sampling.png");
  return drawn;
}

}  // namespace insonify::tool

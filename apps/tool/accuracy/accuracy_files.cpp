// SPDX-License-Identifier: BSD-3-Clause
#include "tool/accuracy/accuracy_files.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "beamforming/engine.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

const AccuracyRow* find(const std::vector<AccuracyRow>& rows, const std::string& sweep, const std::string& method,
                        double tolerance, std::size_t scatterers, int threads) {
  for (const AccuracyRow& r : rows)
    if (r.sweep == sweep && r.method == method && r.tolerance == tolerance && r.scatterers == scatterers &&
        (threads == 0 || r.threads == threads))
      return &r;
  return nullptr;
}

/// How much faster than direct, with the spread of both.
ordered_json speed_json(const AccuracyRow& fast, const AccuracyRow& direct) {
  return {{"scatterers", fast.scatterers},
          {"beams", fast.beams},
          {"bins", fast.bins},
          {"tolerance", fast.tolerance},
          {"error", fast.error},
          {"seconds", fast.seconds},
          {"direct_seconds", direct.seconds},
          {"direct_timed_scatterers", direct.timed_scatterers},
          {"ratio", direct.seconds / fast.seconds},
          {"ratio_min", direct.seconds_min / fast.seconds_max},
          {"ratio_max", direct.seconds_max / fast.seconds_min}};
}

/// The smallest number of scatterers from which on gridded is faster, or null.
ordered_json crossover_json(const std::vector<AccuracyRow>& rows, const std::string& against, double tolerance,
                            double against_tolerance) {
  std::map<std::size_t, std::pair<double, double>> seconds;
  for (const AccuracyRow& r : rows) {
    if (r.sweep != "scatterers") continue;
    if (r.method == "gridded" && r.tolerance == tolerance) seconds[r.scatterers].first = r.seconds;
    if (r.method == against && r.tolerance == against_tolerance) seconds[r.scatterers].second = r.seconds;
  }
  ordered_json from;
  for (const auto& [count, pair] : seconds) {
    if (pair.first == 0 || pair.second == 0) continue;
    if (pair.first >= pair.second)
      from = nullptr;
    else if (from.is_null())
      from = count;
  }
  return from;
}

ordered_json promise_json(const std::vector<AccuracyRow>& rows) {
  std::map<double, std::tuple<double, double, int>, std::greater<>> worst;
  for (const AccuracyRow& r : rows)
    if (r.method == "gridded") {
      auto& [image, local, count] = worst[r.tolerance];
      image = std::max(image, r.error);
      local = std::max(local, r.local_error);
      ++count;
    }
  ordered_json promise = ordered_json::array();
  for (const auto& [tolerance, errors] : worst)
    promise.push_back({{"tolerance", tolerance},
                       {"images", std::get<2>(errors)},
                       {"worst_error", std::get<0>(errors)},
                       {"worst_local_error", std::get<1>(errors)},
                       {"worst_error_over_tolerance", std::get<0>(errors) / tolerance}});
  return promise;
}

/// Returns for each engine the number of its rows, of refusals, and its largest error over the tolerance.
ordered_json engines_json(const std::vector<AccuracyRow>& rows) {
  ordered_json all = ordered_json::array();
  for (const Engine& engine : engines()) {
    int measured = 0, refused = 0;
    double worst = 0;
    for (const AccuracyRow& r : rows) {
      if ((r.sweep != "engines" && r.sweep != "stability") || r.method != engine.word) continue;
      ++measured, refused += r.refused.empty() ? 0 : 1;
      if (r.refused.empty() && r.tolerance > 0) worst = std::max(worst, r.error / r.tolerance);
    }
    if (measured > 0)
      all.push_back(
          {{"engine", engine.word}, {"rows", measured}, {"refused", refused}, {"worst_error_over_tolerance", worst}});
  }
  return all;
}

/// How much slower the plan's engine is than the fastest of its model that holds the tolerance. (The model is chosen by
/// its error, not by time.)
ordered_json plan_json(const std::vector<AccuracyRow>& rows) {
  ordered_json worst;
  const auto model_of = [](const AccuracyRow& r) {
    return std::ranges::find(engines(), r.method, &Engine::word)->model;
  };
  const auto holds = [](const AccuracyRow& r) { return r.refused.empty() && r.error <= r.tolerance; };
  for (const AccuracyRow& planned : rows) {
    if (!planned.planned || !holds(planned) || planned.sweep != "engines") continue;
    for (const AccuracyRow& other : rows) {
      if (other.sweep != planned.sweep || other.task != planned.task || model_of(other) != model_of(planned)) continue;
      const double ratio = planned.seconds / other.seconds;
      if ((other.tolerance > 0 && other.tolerance != planned.tolerance) || !(holds(other) || other.tolerance == 0) ||
          (!worst.is_null() && ratio <= worst["slower"].get<double>()))
        continue;
      worst = {{"task", planned.task},
               {"tolerance", planned.tolerance},
               {"planned", planned.method},
               {"fastest", other.method},
               {"slower", ratio}};
    }
  }
  return worst;
}

std::string first_value(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key)) {
      const std::size_t at = line.find_first_not_of(" \t:", key.size());
      return at == std::string::npos ? "" : line.substr(at);
    }
  return "unknown";
}

}  // namespace

std::string sweep_csv(const std::vector<AccuracyRow>& rows) {
  std::string csv =
      "method,precision,scatterers,beams,elements,bins,tolerance,kernel_width,error,local_error,seconds,seconds_min,"
      "seconds_max,peak_mib,max_level_db,plan_seconds,sweep,parameter,bandwidth_hz,dynamic_range_db,absorption_order,"
      "threads,repeats,timed_scatterers,timed_beams,checked_beams,task,model_error,model_bound,refused,planned\n";
  for (const AccuracyRow& r : rows)
    csv += fmt::format(
        "{},{},{},{},{},{},{},{},{:.4g},{:.4g},{:.6g},{:.6g},{:.6g},{:.1f},{:.4g},{:.4g},{},{},{},{:.4g},{},{},{},{},{}"
        ",{},{},{:.4g},{:.4g},{},{:d}\n",
        r.method, r.precision, r.scatterers, r.beams, r.elements, r.bins, r.tolerance, r.kernel_width, r.error,
        r.local_error, r.seconds, r.seconds_min, r.seconds_max, r.peak_mib, r.max_level_db, r.plan_seconds, r.sweep,
        r.parameter, r.bandwidth, r.dynamic_range_db, r.absorption_order, r.threads, r.repeats, r.timed_scatterers,
        r.timed_beams, r.checked_beams, r.task, r.model_error, r.model_bound, r.refused, r.planned);
  return csv;
}

std::string sampling_csv(const std::vector<SamplingErrorRow>& rows) {
  std::string csv = "sampling,parameter,scatterers_per_beam,error,error_db,seconds\n";
  for (const SamplingErrorRow& r : rows)
    csv += fmt::format("{},{},{:.6g},{:.4g},{:.4g},{:.4g}\n", r.sampling, r.parameter, r.scatterers_per_beam, r.error,
                       r.error_db, r.seconds);
  return csv;
}

ordered_json machine_json() {
  std::string load;
  std::getline(std::ifstream("/proc/loadavg") >> std::ws, load);
  return {{"cpu", first_value("/proc/cpuinfo", "model name")},
          {"cores", std::thread::hardware_concurrency()},
          {"load_average", load.substr(0, load.find(' '))},
          {"compiler", INSONIFY_COMPILER},
          {"flags", INSONIFY_FLAGS},
          {"commit", INSONIFY_COMMIT}};
}

ordered_json accuracy_summary(const std::vector<AccuracyRow>& rows) {
  ordered_json summary = {{"speed", ordered_json::array()},     {"second_core", ordered_json::array()},
                          {"crossover", ordered_json::array()}, {"promise", promise_json(rows)},
                          {"engines", engines_json(rows)},      {"plan", plan_json(rows)}};
  for (const AccuracyRow& r : rows) {
    if (r.method != "gridded") continue;
    if (r.sweep == "scatterers")
      if (const AccuracyRow* direct = find(rows, r.sweep, "direct", 0, r.scatterers, 0))
        summary["speed"].push_back(speed_json(r, *direct));
    const AccuracyRow* alone = find(rows, "threads", "gridded", r.tolerance, r.scatterers, 1);
    if (r.sweep == "threads" && alone && r.threads == 2)
      summary["second_core"].push_back({{"tolerance", r.tolerance}, {"gain", alone->seconds / r.seconds}});
  }
  for (const double tolerance : {1e-4, 1e-6})
    for (const auto& [against, its] : {std::pair("direct", 0.0), std::pair("windowed-direct", tolerance)})
      summary["crossover"].push_back({{"tolerance", tolerance},
                                      {"against", against},
                                      {"faster_from", crossover_json(rows, against, tolerance, its)}});
  return summary;
}

}  // namespace insonify::tool

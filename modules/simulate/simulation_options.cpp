// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulation_options.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "beamforming/engine.hpp"
#include "beamforming/reference/element_series.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_contributors = 255, most_looks = 1024, most_display_bins = 65536;
constexpr double most_accuracy_db = 20;

bool at_least_0(double value) { return value >= 0 && std::isfinite(value); }

/// Keeps the first member of a group of options that breaks its rule.
struct Checker {
  std::optional<OptionProblem>& problem;
  const char* group;

  template <typename Value>
  void require(bool good, const char* name, const Value& value, const std::string& rule) const {
    if (good || problem) return;
    std::ostringstream text;
    text.precision(10);
    text << std::boolalpha << value;
    problem = {std::string(group) + name, text.str(), rule, &value};
  }
};

void check(const SamplingSettings& s, std::optional<OptionProblem>& problem) {
  const Checker check{problem, "sampling."};
  check.require(at_least_0(s.scatterers_per_cell), "scatterers_per_cell", s.scatterers_per_cell, "finite and >= 0");
  check.require(s.rays_per_beam >= 1, "rays_per_beam", s.rays_per_beam, "at least 1");
  check.require(s.detail_width >= 0 && s.detail_width <= 4, "detail_width", s.detail_width, "within 0 and 4");
  check.require(s.detail_spacing >= 0 && s.detail_spacing <= 1e3, "detail_spacing", s.detail_spacing,
                "within 0 and 1000 m");
  check.require(s.detail_width == 0 || s.detail_spacing == 0, "detail_spacing", s.detail_spacing,
                "0 where detail_width is set");
  check.require(s.elevation_floor_db < 0, "elevation_floor_db", s.elevation_floor_db, "< 0 dB");
  check.require(at_least_0(s.azimuth_margin), "azimuth_margin", s.azimuth_margin, "finite and >= 0 rad");
}

void check(const SynthesisSettings& s, bool elements, std::optional<OptionProblem>& problem) {
  const Checker check{problem, "synthesis."};
  const double& t = s.tolerance;
  check.require(t > 0 && t < 1, "tolerance", t, "above 0 and below 1");
  const auto require_within = [&](double least, double most, const std::string& of) {
    check.require(t >= least && t <= most, "tolerance", t, printed("within %g and %g for ", least, most) + of);
  };
  const Engine& engine = engine_of(s.method);
  const std::string_view finer = engine_of(engine.referee).word;
  require_within(engine.least_tolerance, engine.most_tolerance,
                 std::string("method ").append(engine.word) +
                     (finer == engine.word ? "" : std::string("; below that use ").append(finer)));
  if (elements) require_within(min_element_tolerance, max_element_tolerance, "the output of elements");
}

void check(const EffectSettings& e, std::optional<OptionProblem>& problem) {
  const Checker check{problem, "effects."};
  const int none = 0;
  const int& order = e.absorption_order ? *e.absorption_order : none;
  check.require(e.double_echoes == 0 || (e.double_echoes >= 1e-6 && e.double_echoes <= 1e4), "double_echoes",
                e.double_echoes, "0, or within 1e-6 and 10000");
  check.require(order >= 0 && order <= 2, "absorption_order", order, "0, 1 or 2");
}

void check(const DetectionOptions& d, std::optional<OptionProblem>& problem) {
  const Checker check{problem, "detection."};
  check.require(d.noise_floor_db < infinity, "noise_floor_db", d.noise_floor_db,
                "finite, or -inf: all noise in the band");
  check.require(!std::isnan(d.threshold_db), "threshold_db", d.threshold_db, "a number");
  check.require(!std::isnan(d.side_lobe_margin_db), "side_lobe_margin_db", d.side_lobe_margin_db, "a number");
  check.require(d.false_alarm_rate > 0 && d.false_alarm_rate <= 1, "false_alarm_rate", d.false_alarm_rate,
                "above 0 and at most 1");
  check.require(d.range_resolution >= 0, "range_resolution", d.range_resolution, ">= 0 m");
  check.require(!std::isnan(d.above_db), "above_db", d.above_db, "a number");
}

/// Refuses outputs that display cells do not have.
void check_display(const OutputSettings& o, std::optional<OptionProblem>& problem) {
  const Checker check{problem, "outputs."};
  check.require(o.display_bins >= 0 && o.display_bins <= most_display_bins, "display_bins", o.display_bins,
                "within 0 and 65536; 0: samples");
  check.require(o.display_bins > 0 || !o.labels, "labels", o.labels, "false without display_bins: labels are of cells");
  if (o.display_bins == 0) return;
  check.require(o.looks_range == 1 && o.looks_pings == 1, "display_bins", o.display_bins,
                "0 with looks_range or looks_pings: a display cell is a mean of looks already");
  check.require(!o.split_phase, "display_bins", o.display_bins, "0 with split_phase: display cells have no phase");
  check.require(!o.elements, "display_bins", o.display_bins, "0 with elements: they are samples of pressure");
  check.require(o.contributors == 0, "display_bins", o.display_bins, "0 with contributors: they are listed by sample");
}

}  // namespace

std::optional<OptionProblem> problem_of(const SimulationOptions& o) {
  std::optional<OptionProblem> problem;
  check(o.sampling, problem);
  check(o.synthesis, o.outputs.elements, problem);
  check(o.effects, problem);
  check(o.detection, problem);
  const Checker outputs{problem, "outputs."};
  outputs.require(o.outputs.paths >= 0, "paths", o.outputs.paths, "at least 0");
  outputs.require(o.outputs.contributors >= 0 && o.outputs.contributors <= most_contributors, "contributors",
                  o.outputs.contributors, "within 0 and 255");
  for (const auto& [looks, name] :
       {std::pair(&o.outputs.looks_range, "looks_range"), std::pair(&o.outputs.looks_pings, "looks_pings")})
    outputs.require(*looks >= 1 && *looks <= most_looks, name, *looks, "within 1 and 1024");
  outputs.require(o.outputs.looks_pings == 1 || !gives_power(o.synthesis.method), "looks_pings", o.outputs.looks_pings,
                  "1 with method incoherent: an expected intensity has no looks to average");
  outputs.require(!(o.outputs.elements && gives_power(o.synthesis.method)), "elements", o.outputs.elements,
                  "false with method incoherent: an expected intensity has no pressures at elements; use gridded");
  outputs.require(!(o.outputs.split_phase && gives_power(o.synthesis.method)), "split_phase", o.outputs.split_phase,
                  "false with method incoherent: an expected intensity has no phase; use gridded");
  check_display(o.outputs, problem);
  const Checker top{problem, ""};
  top.require(o.accuracy_db > 0 && o.accuracy_db <= most_accuracy_db, "accuracy_db", o.accuracy_db,
              "above 0 and at most 20 dB");
  top.require(o.threads >= 0, "threads", o.threads, "at least 0; 0: all cores");
  return problem;
}

void require_valid(const SimulationOptions& options, const char* who) {
  if (const auto problem = problem_of(options))
    fail(ErrorKind::argument, who, ": options.", problem->member, " = ", problem->value, ", must be ", problem->rule);
}

}  // namespace insonify

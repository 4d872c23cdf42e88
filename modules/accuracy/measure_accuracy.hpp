// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "accuracy/accuracy_task.hpp"
#include "accuracy/reference_sums.hpp"
#include "beamforming/engine.hpp"
#include "core/grid.hpp"

namespace insonify {

/// One method at one setting on one task. Errors of engines are against the referee of their model.
struct AccuracyRow {
  std::string sweep;      ///< name of the sweep
  std::string method;     ///< direct, spectrum, gridded, windowed-direct, nearest-bin, pattern-cut, absorption-order
  std::string precision;  ///< double, or single if the method chose it
  std::size_t scatterers = 0, beams = 0, elements = 0, bins = 0;
  double tolerance = 0;          ///< asked for; 0 if the method takes none
  std::size_t kernel_width = 0;  ///< kernel width of gridded; 0 else
  double error = 0;              ///< ||P - P_ref|| / ||P_ref|| over the checked beams
  double local_error = 0;        ///< the largest of it over those eighths of the range axis that hold an echo
  double seconds = 0, seconds_min = 0, seconds_max = 0;  ///< wall time of one ping; seconds: the median
  double peak_mib = 0;                                   ///< largest resident set of the process meanwhile
  double max_level_db = 0;  ///< largest error in level of samples within 60 dB of the highest
  double plan_seconds = 0;  ///< wall time of the plan, once per head, not part of `seconds`
  double parameter = 0;     ///< null widths of pattern-cut, or the order of absorption-order
  double bandwidth = 0, dynamic_range_db = 0;
  int absorption_order = 0, threads = 0, repeats = 0;
  std::size_t timed_scatterers = 0;  ///< if fewer than scatterers, time is scaled up in proportion
  std::size_t timed_beams = 0;       ///< the same for beams
  std::size_t checked_beams = 0;
  std::string task{};  ///< name of the task, of the sweeps over engines
  double model_error =
      0;  ///< ||P_ref - P_true|| / ||P_true||: what the engine's model leaves out, P_true with true delays
  double model_bound = 0;  ///< the plan's bound of model_error (NarrowBandError)
  bool planned = false;    ///< the plan takes this engine at this tolerance
  std::string refused{};   ///< error of an engine that cannot form the image
};

/// Limits of the measurement of a method.
struct MeasureOptions {
  int threads = 0;
  int repeats = 5;                   ///< timed runs, after one to warm caches
  double most_seconds = 2;           ///< no repeat begins later, but at least two are made
  double direct_work = 4e8;          ///< echoes x beams x bins of one timed run of the direct sums
  double windowed_work = 8e6;        ///< echoes x beams of one timed run of the methods that cut the pulse
  double spectrum_work = 4e6;        ///< echoes x 4 beams x bins of one timed run of the spectrum
  double referee_work = 1.5e9;       ///< echoes x checked beams x bins of the referee
  std::size_t twice_checked = 2000;  ///< echoes for which the referee itself is checked
};

/// Measures methods on one task against the direct sum in double, and engines against the referees of their models. The
/// referee sums all echoes and all bins, in as many evenly picked beams as referee_work allows (at least 4, see
/// picked).
class AccuracyBench {
 public:
  /// Sums the referee's beams of `task`. Throws Error for a task that cannot be synthesized.
  AccuracyBench(std::string sweep, AccuracyTask task, const MeasureOptions& options);

  /// Measures the direct sum: time of evenly picked echoes, scaled up; error against synthesize_extended on at most
  /// twice_checked echoes, 4 beams and 64 bins.
  AccuracyRow direct() const;
  /// Measures the direct sum of all echoes once, without repeats, to check the scaling.
  AccuracyRow direct_whole() const;
  /// Measures an engine at a tolerance against the referee of its model on the same echoes: the direct sum,
  /// element-exact at 1e-12, or the sum of |P_i|^2 over echoes (E65). The row says if the engine refuses.
  AccuracyRow engine(const Engine& engine, double tolerance) const;
  /// Measures the gridded synthesis; the plan is made beforehand. threads 0: those of the options.
  AccuracyRow gridded(double tolerance, int threads = 0) const;
  /// Measures the spectrum on a part of echoes and beams, against the direct sum on the same part.
  AccuracyRow spectrum() const;
  /// Measures the direct sum with each pulse cut (windowed_synthesizer), in a row of this method. The row of a short cut
  /// has no tolerance.
  AccuracyRow windowed(const std::string& method, WindowedOptions options) const;
  /// Measures the error without slope (order 0) or curvature (1) of the absorption, gridded at a tolerance of 1e-8.
  AccuracyRow absorption_order(int order) const;

 private:
  using Synthesis = std::function<ComplexGrid(const Echoes&)>;
  AccuracyRow row(const std::string& method) const;
  std::size_t timed(double affordable) const;
  /// Sets the errors of an image of echoes in the checked beams or those of the referee.
  void compare(const ComplexGrid& pressure, const ComplexGrid& referee, const Echoes& echoes, AccuracyRow& row) const;
  const ComplexGrid& referee_of(ImageModel model) const;
  void measure_engine(const Engine& engine, AccuracyRow& row) const;
  void time_all(const Synthesis& run, AccuracyRow& row) const;
  AccuracyRow gridded_row(AccuracyRow row, const Medium& medium) const;

  std::string sweep_;
  AccuracyTask task_;
  MeasureOptions options_;
  std::vector<std::size_t> beams_;  ///< that are checked
  SonarHead checked_head_;
  ComplexGrid referee_;
  mutable std::map<ImageModel, ComplexGrid>
      model_referees_;  ///< images of the referees of other models, made when they are asked for
};

/// Returns ||pressure - referee|| / ||referee||; 0 if the referee is silent.
double relative_error(const ComplexGrid& pressure, const ComplexGrid& referee);

/// Relative L2 error of an image, and the largest such error in eighths of the bins, without eighths in which the
/// referee is 0 or no echo arrives.
struct ImageError {
  double whole = 0, worst_eighth = 0;
};
/// Returns the error of `pressure` against `referee`, both beams x bins; `eighth_counts`: eighths that hold an echo.
ImageError image_error(const ComplexGrid& pressure, const ComplexGrid& referee, const std::vector<bool>& eighth_counts);

}  // namespace insonify

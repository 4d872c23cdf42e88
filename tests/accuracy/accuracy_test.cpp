// SPDX-License-Identifier: BSD-3-Clause
// The pieces of the sweep of error against run time.
#include "accuracy/accuracy_sweep.hpp"
#include "accuracy/reference_sums.hpp"
#include "accuracy/sampling_error.hpp"
#include "beamforming/synthesize.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

const TaskSpec small{.scatterers = 300, .beams = 24, .bins = 211};

ComplexGrid direct(const AccuracyTask& task) { return synthesize_direct(task.echoes, task.head, task.medium); }

}  // namespace

// Two programs of one equation, one of them in 64 bits of mantissa: they differ by the rounding of double, which
// reduces phases of up to 2 pi 25 cycles.
TEST(Accuracy, direct_sum_in_double_agrees_with_extended_precision) {
  for (const int order : {0, 1, 2}) {
    TaskSpec spec = small;
    spec.absorption_order = order;
    const AccuracyTask task = make_task(spec);
    const ComplexGrid exact = synthesize_extended(task.echoes, task.head, task.medium, picked(211, 211));
    EXPECT_LE(relative_l2(direct(task), exact), 2e-13) << order;
    EXPECT_GT(relative_l2(direct(task), exact), 1e-17) << order;
  }
}

TEST(Accuracy, windowed_sum_is_as_exact_as_asked) {
  const AccuracyTask task = make_task(small);
  const ComplexGrid exact = direct(task);
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    const ComplexGrid image = windowed_synthesizer(task.head, task.medium, {tolerance})(task.echoes);
    EXPECT_LE(relative_l2(image, exact), tolerance);
    for (const int threads : {1, 2, 7})
      EXPECT_TRUE(
          (image == windowed_synthesizer(task.head, task.medium, {tolerance, 0, false, threads})(task.echoes)).all());
  }
}

// The pattern's energy beyond K null widths falls as 1 / K, so its root as 1 / sqrt(K), slower for a Taylor array.
TEST(Accuracy, short_cuts_have_errors_of_their_own) {
  const AccuracyTask task = make_task(small);
  const ComplexGrid exact = direct(task);
  const auto error = [&](double nulls, bool nearest) {
    return relative_l2(windowed_synthesizer(task.head, task.medium, {1e-8, nulls, nearest})(task.echoes), exact);
  };
  EXPECT_GT(error(0, true), 0.1);
  EXPECT_GT(error(1, false), 0.01);
  EXPECT_LT(error(16, false), error(4, false));
  EXPECT_GT(error(16, false), 1e-4);
}

TEST(Accuracy, windowed_sum_refuses_what_it_has_no_window_for) {
  AccuracyTask task = make_task(small);
  EXPECT_THAT(error_of([&] { windowed_synthesizer(task.head, task.medium, {0}); }), HasSubstr("tolerance = 0"));
  task.echoes.doppler.assign(task.echoes.size(), 10);
  EXPECT_THAT(error_of([&] { windowed_synthesizer(task.head, task.medium)(task.echoes); }), HasSubstr("Doppler"));
}

TEST(Accuracy, picked_entries_are_spread_evenly_with_both_ends) {
  EXPECT_EQ(picked(9, 3), (std::vector<std::size_t>{0, 4, 8}));
  EXPECT_EQ(picked(3, 7), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(picked(5, 1), (std::vector<std::size_t>{2}));
  EXPECT_EQ(picked(1, 4), (std::vector<std::size_t>{0}));
}

TEST(Accuracy, checked_beams_are_those_of_the_whole_fan) {
  const AccuracyTask task = make_task(small);
  const ComplexGrid whole = direct(task);
  const ComplexGrid some = synthesize_direct(task.echoes, some_beams(task.head, 5), task.medium);
  const std::vector<std::size_t> which = picked(24, 5);
  for (std::size_t k = 0; k < which.size(); ++k) EXPECT_TRUE((some.row(k) == whole.row(which[k])).all());
}

// A known error: the far half of the range axis is 1000 times weaker, and wrong by a tenth.
TEST(Accuracy, local_error_sees_what_the_whole_image_hides) {
  ComplexGrid referee = ComplexGrid::Ones(2, 80);
  referee.rightCols(40) *= 1e-3;
  ComplexGrid image = referee;
  image.rightCols(40) *= 1.1;
  const std::vector<bool> all(8, true), near{true, true, true, true, false, false, false, false};
  EXPECT_NEAR(image_error(image, referee, all).whole, 1e-4, 1e-9);
  EXPECT_NEAR(image_error(image, referee, all).worst_eighth, 0.1, 1e-12);
  EXPECT_EQ(image_error(image, referee, near).worst_eighth, 0);
}

// Time of a part, scaled up, is of the size of the time of the whole.
TEST(Accuracy, time_of_the_direct_sum_is_scaled_up_from_a_part) {
  MeasureOptions options;
  options.direct_work = 24.0 * 211 * 150;
  const AccuracyBench bench("test", make_task(small), options);
  const AccuracyRow part = bench.direct(), whole = bench.direct_whole();
  EXPECT_EQ(part.timed_scatterers, 150u);
  EXPECT_EQ(part.repeats, 5);
  EXPECT_LT(part.seconds, 30 * whole.seconds);
  EXPECT_GT(part.seconds, whole.seconds / 30);
  EXPECT_LE(part.error, 1e-12);
  EXPECT_LE(whole.error, 1e-15);
}

TEST(Accuracy, leaving_out_orders_of_absorption_costs_more_the_more_is_left_out) {
  const AccuracyBench bench(
      "test",
      make_task({.scatterers = 300, .beams = 8, .bandwidth = 100e3, .dynamic_range_db = 60, .absorption_order = 2}),
      {});
  const double none = bench.absorption_order(0).error, slope = bench.absorption_order(1).error;
  EXPECT_GT(none, 3 * slope);
  EXPECT_GT(slope, 1e-6);
  EXPECT_LE(bench.absorption_order(2).error, 1e-8);
}

TEST(Accuracy, sweep_refuses_unknown_methods_and_tolerances_out_of_reach) {
  EXPECT_NE(error_of([] { accuracy_sweep({.methods = {"magic"}}); }).find("'magic' is unknown; known are gridded"),
            std::string::npos);
  EXPECT_NE(error_of([] { accuracy_sweep({.tolerances = {1e-14}}); }).find("1e-14, must be within"), std::string::npos);
}

// Independent rays: the error falls as the root of their number. The product's jittered ones do better.
TEST(SamplingError, falls_as_the_root_of_random_rays_and_faster_for_jittered_ones) {
  const std::vector<SamplingErrorRow> rows = measure_sampling_error({.most_rays = 1024, .trials = 4});
  const auto error = [&](const std::string& sampling, double parameter) {
    for (const SamplingErrorRow& r : rows)
      if (r.sampling == sampling && r.parameter == parameter) return r.error;
    return -1.0;
  };
  const double slope = std::log(error("random-rays", 1024) / error("random-rays", 64)) / std::log(16.0);
  EXPECT_NEAR(slope, -0.5, 0.15);
  EXPECT_LT(error("jittered-rays", 1024), 0.5 * error("random-rays", 1024));
  double coarse = 0, fine = 0;
  for (const SamplingErrorRow& r : rows)
    if (r.sampling == "surfels") (coarse == 0 ? coarse : fine) = r.error;
  EXPECT_LT(fine, 0.2 * coarse);
}

// Each engine that the table lists keeps its tolerance on every task that it takes, and says what its model leaves out.
TEST(Accuracy, engines_keep_their_tolerance_against_the_referee_of_their_model) {
  std::size_t measured = 0;
  for (const AccuracyTask& task : engine_tasks(30, 5)) {
    const AccuracyBench bench("engines", task, {.threads = 2, .repeats = 1, .most_seconds = 0});
    for (const Engine& engine : engines()) {
      if (engine.method == SynthesisMethod::spectrum) continue;  // a minute
      // Sweeps have no sharp band: with true delays they keep a hundredth.
      const bool loose = task.name.ends_with("sweep") && engine.method == SynthesisMethod::true_delays;
      const double tolerance = std::max(loose ? 1e-2 : 1e-4, engine.least_tolerance);
      const AccuracyRow row = bench.engine(engine, tolerance);
      EXPECT_EQ(row.refused, "") << task.name << ", " << row.method;
      EXPECT_LE(row.error, tolerance) << task.name << ", " << row.method;
      const bool narrow = engine.model == ImageModel::narrow_band;
      EXPECT_EQ(row.model_error > 1e-3, narrow) << task.name << ", " << row.method;
      EXPECT_GE(row.model_bound, 0.7 * row.model_error) << task.name << ", " << row.method;
      ++measured;
    }
  }
  EXPECT_EQ(measured, 65u);
}

// The direct sum of each of two echoes is what an image of 300 dB less would drown.
TEST(Accuracy, engines_hold_where_arithmetic_is_strained) {
  for (const AccuracyTask& task : stability_tasks(3)) {
    const AccuracyBench bench("stability", task, {.threads = 2, .repeats = 1, .most_seconds = 0});
    for (const SynthesisMethod method : {SynthesisMethod::gridded, SynthesisMethod::true_delays,
                                         SynthesisMethod::element_exact, SynthesisMethod::incoherent}) {
      const AccuracyRow row = bench.engine(engine_of(method), 1e-4);
      EXPECT_EQ(row.refused, "") << task.name << ", " << row.method;
      EXPECT_LE(row.error, 1e-4) << task.name << ", " << row.method;
      if (method == SynthesisMethod::gridded) {
        EXPECT_GE(row.model_bound, 0.7 * row.model_error) << task.name;
      }
      if (task.name == "two echoes 300 dB apart") {
        EXPECT_LE(row.local_error, 1e-4) << row.method;
      }
    }
  }
}

TEST(Accuracy, an_engine_that_refuses_says_so_in_its_row) {
  AccuracyTask task = make_task(small);
  const AccuracyBench bench("engines", task, {.repeats = 1});
  const AccuracyRow row = bench.engine(engine_of(SynthesisMethod::true_delays), 1e-7);
  EXPECT_THAT(row.refused, HasSubstr("tolerance"));
  EXPECT_TRUE(std::isnan(row.error));
}

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "run/run_checks.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/compare/compare_page.hpp"
#include "tool/compare/compare_ranges.hpp"
#include "tool/compare/compare_soundings.hpp"
#include "tool/compare/compare_swaths.hpp"
#include "tool/run/record_file.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

void add_options(OptionList list, CompareOptions& o) {
  list.add("A", &o.a, "run directory, cube.h5 or recording; or soundings written by export --to csv or --to gsf",
           {.required = true});
  list.add("B", &o.b,
           "the reference: a run, a recording (" + record_extensions() +
               "), .npy (dB, complex Pa, or grey), .png (grey, as written by --view grey), or with --strength a cloud; "
               "for soundings: their scene, or their run if parts of the scene move",
           {.required = true});
  list.add("-o,--output", &o.output, "folder that is made: compare.json and a page of pictures, index.html");
  list.add("--window", &o.window,
           "MIN:MAX [dB] of the levels that are compared; default: from 60 dB below the top of B");
  list.add("--scale", &o.scale, "MIN:MAX [dB] of black and white in a .png or a grey .npy");
  list.add("--ping", &o.ping, "number of the ping of A, from 0");
  list.add("--ping-b", &o.ping_b, "number of the ping of B; default: as of A", {.shown_as = "INT"});
  list.add("--align", &o.align,
           "first move A by the whole beams and bins at which A correlates best with B; the result lists both numbers");
  const OptionRules from_0{.within = std::pair(0, 1 << 30), .shown_as = "INT"};
  list.add("--frame", &o.frame, "ping of the recording of an imaging sonar, from 0", from_0);
  list.add("--channel", &o.channel, "channel of the recording of a side-scan, from 0; all pings are compared", from_0);
  list.add("--strength", &o.strength,
           "field of the cloud B that holds measured strengths; they are compared with the levels of A at the points");
  list.add("--strength-unit", &o.unit, "unit of the field: db, linear (amplitude) or power",
           {.words = {"db", "linear", "power"}});
  list.add("--cell", &o.cell, "[m] size of the cells in which heights of soundings, scene or swaths are compared",
           {.positive = true});
  list.add("--angles", &o.angles, "[deg] width of the bands of angle in which swaths are compared", {.positive = true});
  list.add("--repeat", &o.repeat,
           "second cloud of the same place; its strengths show how well a repeated measurement agrees");
  list.add("--seed", &o.common.seed, "seed of the simulated comparison of two seeds");
  list.add("--force", &o.force, "replace the folder of an earlier comparison");
  add_common(list, o.common);
}

ordered_json json_of(const ImageSimilarity& s) {
  return {{"mse_db2", s.mse}, {"psnr_db", s.psnr_db}, {"ssim", s.ssim}};
}

ordered_json json_of(const KolmogorovSmirnov& k) {
  return {{"distance", k.distance}, {"probability", k.probability}, {"samples", k.samples}, {"others", k.others}};
}

/// Widths against what pulse and array resolve.
ordered_json widths_json(const CorrelationWidths& w, const ComparedFile& file) {
  ordered_json json = {{"beams", w.beams}, {"bins", w.bins}};
  if (file.image.gate) json["range_m"] = w.bins * file.image.gate->bin_size;
  if (file.bandwidth > 0 && file.image.gate)
    json["range_over_c_2b"] = w.bins * file.image.gate->bin_size * 2 * file.bandwidth / file.sound_speed;
  if (const auto& fan = file.image.fan; fan && fan->beams() > 1 && fan->row_width == 0) {
    const auto [low, high] = std::minmax_element(fan->azimuth.begin(), fan->azimuth.end());
    const double width = w.beams * (*high - *low) / static_cast<double>(fan->beams() - 1);
    json["azimuth_deg"] = degrees(width), json["azimuth_over_beam_width"] = width / fan->beam_width;
  }
  return json;
}

ordered_json json_of(const ImageCharacter& c, const ComparedFile& file, const std::string& path) {
  const SpeckleStatistics& s = c.speckle;
  return {{"file", path},
          {"kind", file.kind},
          {"beams", file.image.level_db.rows()},
          {"bins", file.image.level_db.cols()},
          {"mean_level_db", c.mean_level_db},
          {"clipped", c.clipped},
          {"scintillation_index", s.scintillation},
          {"looks", s.looks},
          {"k_shape", s.k_shape},
          {"amplitude_contrast", s.amplitude_contrast},
          {"deviation_db", s.deviation_db},
          {"autocorrelation_width", widths_json(s.width, file)},
          {"shadow_contrast_db", c.shadow_contrast_db},
          {"ks_against_exponential", json_of(c.exponential)}};
}

ordered_json json_of(const ImageComparison& c, const ComparedFile& a, const ComparedFile& b, const CompareOptions& o) {
  ordered_json similarity = ordered_json::array();
  for (const FittedSimilarity& s : c.similarity) {
    ordered_json row = json_of(s.similarity);
    row["fitted"] = s.fitted;
    similarity.push_back(row);
  }
  return {{"schema", 1},
          {"window_db", {c.window.min_db, c.window.max_db}},
          {"pixels", c.pixels},
          {"similarity", similarity},
          {"floor", {{"drawn", json_of(c.floor.drawn)}, {"analytic", json_of(c.floor.analytic)}}},
          {"levels",
           {{"bias_db", c.bias_db},
            {"deviation_db", c.deviation_db},
            {"power_bias_db", c.power_bias_db},
            {"wasserstein_1_db", c.wasserstein_db},
            {"wasserstein_1_after_gain_db", c.wasserstein_after_gain_db},
            {"kolmogorov_smirnov", json_of(c.samples)}}},
          {"fitted",
           {{"gain_db", c.bias_db},
            {"tvg_db_per_decade", c.tvg_slope_db},
            {"map_slope", c.map_slope},
            {"map_from_db", c.map.from},
            {"map_to_db", c.map.to}}},
          {"shift",
           {{"beams", c.shift.beams},
            {"bins", c.shift.bins},
            {"correlation", c.shift.correlation},
            {"correlation_at_0", c.shift.correlation_at_0}}},
          {"a", json_of(c.a, a, o.a)},
          {"b", json_of(c.b, b, o.b)}};
}

std::string number_text(const ordered_json& value, const char* unit = "") {
  return value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))
             ? (value.is_number_float() && std::isinf(value.get<double>()) ? "infinite" : "-")
             : fmt::format("{:.4g}{}", value.get<double>(), unit);
}

std::string similarity_row(const std::string& name, const ordered_json& s) {
  return fmt::format("{:<28} {:>10} {:>10} {:>8}\n", name, number_text(s["mse_db2"]), number_text(s["psnr_db"]),
                     number_text(s["ssim"]));
}

std::string table_of(const ordered_json& r) {
  std::string text = fmt::format(
      "{:<28} {:>10} {:>10} {:>8}\n",
      fmt::format("window {:g} to {:g} dB", r["window_db"][0].get<double>(), r["window_db"][1].get<double>()),
      "MSE [dB2]", "PSNR [dB]", "SSIM");
  for (const auto& s : r["similarity"]) text += similarity_row("fitted: " + s["fitted"].get<std::string>(), s);
  text += similarity_row("floor: two seeds, drawn", r["floor"]["drawn"]);
  text += similarity_row("floor: two seeds, analytic", r["floor"]["analytic"]);
  const auto& l = r["levels"];
  text += fmt::format(
      "levels A - B: bias {} dB (of mean intensities {} dB), deviation {} dB, Wasserstein-1 {} dB, after the gain {} "
      "dB\n",
      number_text(l["bias_db"]), number_text(l["power_bias_db"]), number_text(l["deviation_db"]),
      number_text(l["wasserstein_1_db"]), number_text(l["wasserstein_1_after_gain_db"]));
  text += fmt::format(
      "one sample per resolution cell: Kolmogorov-Smirnov {} (probability {}, {} and {} samples)\n",
      number_text(l["kolmogorov_smirnov"]["distance"]), number_text(l["kolmogorov_smirnov"]["probability"]),
      l["kolmogorov_smirnov"]["samples"].get<std::size_t>(), l["kolmogorov_smirnov"]["others"].get<std::size_t>());
  text += fmt::format("fitted: TVG {} dB per decade of range, map {} dB of B per dB of A\n",
                      number_text(r["fitted"]["tvg_db_per_decade"]), number_text(r["fitted"]["map_slope"]));
  text += fmt::format("shift of A: {} beams, {} bins (correlation {}, as they are {})\n",
                      r["shift"]["beams"].get<int>(), r["shift"]["bins"].get<int>(),
                      number_text(r["shift"]["correlation"]), number_text(r["shift"]["correlation_at_0"]));
  if (r.contains("aligned_by"))
    text += fmt::format("before all this A was moved back by {} beams, {} bins\n", r["aligned_by"]["beams"].get<int>(),
                        r["aligned_by"]["bins"].get<int>());
  const auto row = [&](const char* name, const ordered_json& a, const ordered_json& b) {
    text += fmt::format("{:<28} {:>10} {:>10}\n", name, number_text(a), number_text(b));
  };
  text += fmt::format("{:<28} {:>10} {:>10}\n", "", "A", "B");
  const auto &a = r["a"], &b = r["b"];
  for (const auto& [key, name] : {std::pair("scintillation_index", "scintillation index"),
                                  {"k_shape", "K shape"},
                                  {"amplitude_contrast", "amplitude contrast"},
                                  {"deviation_db", "local deviation [dB]"},
                                  {"shadow_contrast_db", "shadow contrast [dB]"},
                                  {"clipped", "clipped share"}})
    row(name, a[key], b[key]);
  for (const auto& [key, name] :
       {std::pair("bins", "width in range [bins]"),
        {"range_over_c_2b", "width over c / 2B"},
        {"beams", r["side_scan"].is_null() ? "width in azimuth [beams]" : "width along track [pings]"},
        {"azimuth_over_beam_width", "width over beam width"}})
    row(name, a["autocorrelation_width"].value(key, ordered_json()),
        b["autocorrelation_width"].value(key, ordered_json()));
  return text;
}

void finish(const CompareOptions& o, std::optional<RunDirectory>& directory, const ordered_json& result,
            const std::string& table) {
  if (directory) {
    write_file(directory->file("compare.json"), result.dump(2) + "\n");
    write_manifest(*directory, {{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"compared", {o.a, o.b}}});
    directory->commit();
  }
  print_result(o.common, result, [&] { fmt::print("{}", table); });
}

void compare_with_points(const CompareOptions& o, std::optional<RunDirectory>& directory) {
  const ComparedPoints p = compared_points(load_compared(o.a, o.ping, o), o);
  const PointComparison c = compare_points(p.predicted_db, p.measured_db, p.range, o.common.seed);
  ordered_json result = {{"schema", 1},
                         {"points", c.points},
                         {"points_in_cloud", p.in_cloud},
                         {"bias_db", c.bias_db},
                         {"deviation_db", c.deviation_db},
                         {"deviation_without_trend_db", c.deviation_without_trend_db},
                         {"rank_correlation", c.rank},
                         {"rank_correlation_without_trend", c.rank_without_trend},
                         {"predicted_db_per_decade", c.predicted_slope_db},
                         {"measured_db_per_decade", c.measured_slope_db},
                         {"fitted_tvg_db_per_decade", c.predicted_slope_db - c.measured_slope_db},
                         {"share_20_db_below_trend", c.far_below},
                         {"ceiling_of_speckle", c.ceiling},
                         {"ceiling_of_speckle_without_trend", c.ceiling_without_trend}};
  if (!o.repeat.empty()) {
    std::vector<double> first, second, range;
    for (std::size_t i = 0; i < p.repeated_db.size(); ++i)
      if (!std::isnan(p.repeated_db[i]))
        first.push_back(p.measured_db[i]), second.push_back(p.repeated_db[i]), range.push_back(p.range[i]);
    if (first.size() < 3)
      fail(ErrorKind::content, o.repeat, ": ", first.size(), " of its points lie within 0.1 m of those of ", o.b,
           ", must be 3 at least");
    result["ceiling_of_repeat"] = rank_correlation(first, second);
    result["ceiling_of_repeat_without_trend"] =
        rank_correlation(without_range_trend(first, range), without_range_trend(second, range));
    result["points_repeated"] = first.size();
  }
  std::string table = fmt::format(
      "{} of {} points\nrank correlation {:.3f} (ceiling of one look of speckle {:.3f}), without the trends over range "
      "{:.3f} ({:.3f})\nA - B: bias {:.2f} dB, deviation {:.2f} dB, without the trends {:.2f} dB\ndB per decade of "
      "range: predicted {:.1f}, measured {:.1f}: a time-varied gain of {:.1f} explains the difference\n",
      c.points, p.in_cloud, c.rank, c.ceiling, c.rank_without_trend, c.ceiling_without_trend, c.bias_db, c.deviation_db,
      c.deviation_without_trend_db, c.predicted_slope_db, c.measured_slope_db,
      c.measured_slope_db - c.predicted_slope_db);
  if (c.far_below > 0.02)
    table += fmt::format(
        "note: {:.0f} % of the points are predicted more than 20 dB below the trend: surface before them hides them in "
        "the run, and they make the slope; if one place saw them all, ping with --viewpoint of that place\n",
        100 * c.far_below);
  if (result.contains("ceiling_of_repeat"))
    table +=
        fmt::format("ceiling of the repeated record: {:.3f}, without the trends {:.3f}, of {} points\n",
                    result["ceiling_of_repeat"].get<double>(), result["ceiling_of_repeat_without_trend"].get<double>(),
                    result["points_repeated"].get<std::size_t>());
  if (directory) write_points_page(*directory, o, p, c, table);
  finish(o, directory, result, table);
}

void compare(const CompareOptions& o) {
  std::optional<RunDirectory> directory;
  if (!o.output.empty()) directory.emplace(o.output, o.force, InputPaths{o.a, o.b, o.repeat});
  Progress progress(o.common, 3);
  progress.step("reading");
  if (!o.strength.empty()) return compare_with_points(o, directory);
  const bool swaths = is_swath(o.a) || is_swath(o.b);
  if (swaths || std::filesystem::path(o.a).extension() == ".csv") {
    const ordered_json result = swaths ? compare_swaths(o) : compare_soundings(o);
    return finish(o, directory, result, swaths ? swaths_table(result) : soundings_table(result));
  }
  if (!o.repeat.empty()) fail(ErrorKind::argument, "--repeat goes with --strength, the field of both clouds");
  const bool waterfall = is_waterfall(o.a) || is_waterfall(o.b);
  ComparedFile a = load_compared(o.a, o.ping, o, waterfall),
               b = load_compared(o.b, o.ping_b < 0 ? o.ping : o.ping_b, o, waterfall);
  match(a, b, o);
  progress.step("comparing");
  ComparisonOptions options;
  if (!o.window.empty()) options.window = parse_window("--window", o.window);
  options.seed = o.common.seed;
  ImageComparison comparison = naming_both(o, [&] { return compare_level_images(a.image, b.image, options); });
  ordered_json aligned;
  if (o.align) {
    const ImageShift shift = comparison.shift;
    a.image.level_db = without_shift(a.image.level_db, shift);
    comparison = compare_level_images(a.image, b.image, options);
    aligned = {{"beams", shift.beams}, {"bins", shift.bins}};
  }
  ordered_json result = json_of(comparison, a, b, o);
  if (o.align) result["aligned_by"] = aligned;
  result["bands"] = range_bands_json(a, b), result["side_scan"] = side_scan_json(a, b);
  const std::string table = table_of(result) + ranges_table(result["bands"], result["side_scan"]);
  progress.step("drawing");
  if (directory) write_compare_page(*directory, o, a, b, comparison, table);
  finish(o, directory, result, table);
}

}  // namespace

Verb compare_verb() {
  return make_verb<CompareOptions>(
      "compare", "likeness of runs and recordings, of soundings and their scene, or of two swaths",
      {"insonify compare run other-seed -o compared", "insonify compare run picture.png --scale 40:100",
       "insonify compare run scan.pcd --strength intensity --strength-unit linear",
       "insonify compare soundings.csv reef.pcd --cell 0.1", "insonify compare run survey.gsf --cell 1"},
      add_options, compare);
}

}  // namespace insonify::tool

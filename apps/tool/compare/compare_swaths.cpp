// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compare_swaths.hpp"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compare/swath_comparison.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "formats/gsf_record.hpp"
#include "tool/export/export_product.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"
#include "tool/run/swath_pings.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Returns the soundings of a run as its GSF states them.
SwathRecord swath_of_run(const std::string& run) {
  const PendingFile gsf((std::filesystem::temp_directory_path() / "insonify.gsf").string());
  ProductOptions soundings;
  soundings.to = "gsf", soundings.run = run, soundings.output = gsf.temporary(), soundings.force = true;
  CommonOptions silent;
  silent.quiet = true;
  export_product(soundings, silent);
  return swath_of(read_gsf(gsf.temporary()));
}

/// Returns the soundings of a swath, or of a run that is compared with one.
SwathRecord compared_swath(const std::string& path, const std::string& other) {
  if (is_swath(path)) return read_swath(path);
  if (!path_exists(path)) fail(ErrorKind::file, path, ": no such run or record");
  if (is_record(path) || !(is_folder(path) || std::filesystem::path(path).extension() == ".h5"))
    fail(ErrorKind::argument, path, ": is neither a swath nor a run, and ", other, " is a swath");
  if (const std::vector<std::string> heads = head_names(path); heads.size() > 1)
    fail(ErrorKind::argument, path, ": is a survey of the heads ", shortened_list(heads), "; compare one of them, as ",
         path, "/", heads.front());
  try {
    return swath_of_run(path);
  } catch (const Error& error) {
    fail(error.kind(), "the soundings of ", path, " are compared with ", other, " as `insonify export ", path,
         " --to gsf` writes them: ", error.what());
  }
}

SwathPoints points_of_swath(const SwathPings& swath) {
  SwathPoints points;
  points.pings = swath.record().pings.size();
  for (const SwathPing& ping : swath.record().pings)
    for (const SwathSounding& sounding : ping.soundings) {
      if (sounding.rejected) continue;
      points.position.push_back(swath.position(ping, sounding));
      points.angle.push_back(sounding.angle), points.level_db.push_back(sounding.level_db);
      points.deviation.push_back(sounding.vertical_deviation);
    }
  return points;
}

ordered_json swath_json(const std::string& path, const SwathPings& swath, const SwathPoints& points) {
  return {{"file", path},          {"kind", swath.record().format},       {"sonar", swath.record().sonar},
          {"pings", points.pings}, {"soundings", points.position.size()}, {"levels", swath.record().unit}};
}

ordered_json number_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

ordered_json band_json(const SwathBand& band) {
  return {{"soundings", band.soundings},
          {"per_ping_and_degree", band.per_ping},
          {"level_db", number_or_null(band.level_db)},
          {"deviation_db", number_or_null(band.deviation_db)}};
}

ordered_json cells_json(const SwathCellComparison& cells, double size) {
  return {{"cell_m", size},
          {"cells_a", cells.cells_a},
          {"cells_b", cells.cells_b},
          {"cells_compared", cells.cells},
          {"bias_m", number_or_null(cells.bias)},
          {"deviation_m", number_or_null(cells.deviation)},
          {"predicted_deviation_m", number_or_null(cells.predicted)},
          {"normalised_deviation", number_or_null(cells.normalised)},
          {"share_within_95", number_or_null(cells.within_95)},
          {"largest_m", number_or_null(cells.largest)}};
}

std::string cell_text(const ordered_json& value, const char* format) {
  return value.is_null() ? "-" : fmt::format(fmt::runtime(format), value.get<double>());
}

}  // namespace

ordered_json compare_swaths(const CompareOptions& o) {
  const SwathPings b(compared_swath(o.b, o.a)), a(compared_swath(o.a, o.b), b.anchor());
  const SwathPoints points_a = points_of_swath(a), points_b = points_of_swath(b);
  ordered_json angles = ordered_json::array();
  for (const SwathAngleBand& band : compare_by_angle(points_a, points_b, radians(o.angles)))
    angles.push_back({{"from_deg", degrees(band.from)},
                      {"to_deg", degrees(band.to)},
                      {"a", band_json(band.a)},
                      {"b", band_json(band.b)},
                      {"level_difference_db", number_or_null(band.a.level_db - band.b.level_db)}});
  return {{"schema", 1},
          {"a", swath_json(o.a, a, points_a)},
          {"b", swath_json(o.b, b, points_b)},
          {"angles", angles},
          {"cells", cells_json(compare_swath_cells(points_a, points_b, o.cell), o.cell)}};
}

std::string swaths_table(const ordered_json& r) {
  std::string text = fmt::format(
      "{:>14} {:>21} {:>21} {:>23} {:>9}\n{:>14} {:>10} {:>10} {:>10} {:>10} {:>11} {:>11}\n", "", "soundings/ping/deg",
      "level [dB]", "deviation [dB]", "A - B", "angle [deg]", "A", "B", "A", "B", "A", "B");
  for (const ordered_json& band : r["angles"]) {
    const ordered_json &a = band["a"], &b = band["b"];
    text += fmt::format("{:>14} {:>10} {:>10} {:>10} {:>10} {:>11} {:>11} {:>9}\n",
                        fmt::format("{:g} to {:g}", band["from_deg"].get<double>(), band["to_deg"].get<double>()),
                        cell_text(a["per_ping_and_degree"], "{:.3f}"), cell_text(b["per_ping_and_degree"], "{:.3f}"),
                        cell_text(a["level_db"], "{:.2f}"), cell_text(b["level_db"], "{:.2f}"),
                        cell_text(a["deviation_db"], "{:.2f}"), cell_text(b["deviation_db"], "{:.2f}"),
                        cell_text(band["level_difference_db"], "{:.2f}"));
  }
  const ordered_json& cells = r["cells"];
  text += fmt::format("cells of {:g} m: {} of A, {} of B, {} hold two soundings of both\n",
                      cells["cell_m"].get<double>(), cells["cells_a"].get<std::size_t>(),
                      cells["cells_b"].get<std::size_t>(), cells["cells_compared"].get<std::size_t>());
  if (cells["bias_m"].is_null()) return text;
  return text + fmt::format(
                    "height of A less that of B: bias {} m, deviation {} m, predicted {} m; {} predicted deviations, "
                    "{} % within 1.96 of them, at most {} m\n",
                    cell_text(cells["bias_m"], "{:.4f}"), cell_text(cells["deviation_m"], "{:.4f}"),
                    cell_text(cells["predicted_deviation_m"], "{:.4f}"),
                    cell_text(cells["normalised_deviation"], "{:.2f}"),
                    fmt::format("{:.1f}", 100 * cells["share_within_95"].get<double>()),
                    cell_text(cells["largest_m"], "{:.3f}"));
}

}  // namespace insonify::tool

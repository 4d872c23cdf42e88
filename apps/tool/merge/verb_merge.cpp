// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "run/run_checks.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/merge_cubes_by_time.hpp"
#include "store/run_directory.hpp"
#include "store/survey_run.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/export/raster_plane.hpp"
#include "tool/merge/merge.hpp"
#include "tool/run/run_pings.hpp"
#include "tool/run/world_reference.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct MergeOptions {
  CommonOptions common;
  std::vector<std::string> runs;
  std::string output;
  bool force = false;
  bool copy = false;
  MosaicOptions mosaic;
};

void add_options(OptionList list, MergeOptions& o) {
  list.add("RUN", &o.runs, "run directories or cubes with the same fan and gate; or the folder of one survey",
           {.required = true});
  list.add("-o,--output", &o.output,
           "run directory that is made, with returns, contributors and insonification if all runs have them; a survey "
           "is merged in its own folder");
  list.add("--copy", &o.copy, "survey: copy the blocks into the cubes; without it, the cubes refer to the blocks");
  list.add("--mosaic", &o.mosaic.cell,
           "[m] survey: lay the images of all heads on the bed, on a grid with cells of this size: .vti, .png, and "
           "GeoTIFF if mission, scene or options say where the world is",
           {.positive = true});
  list.add("--bottom", &o.mosaic.bottom, "[m] z of a level bed for the mosaic; default: the surface of the returns");
  list.add("--mosaic-by", &o.mosaic.by,
           "value of a cell: mean of all pings that hear it, or best: that of the ping with the narrowest beam there",
           {.words = {"mean", "best"}});
  list.add("--crs", &o.mosaic.crs, crs_help);
  add_world_options(list, o.mosaic.world);
  list.add("--force", &o.force, "replace an existing run directory");
  add_common(list, o.common);
}

/// The merged files and their numbers of pings, for the manifest.
ordered_json inputs_json(const std::vector<NamedCube>& cubes) {
  ordered_json inputs = ordered_json::array();
  for (const NamedCube& one : cubes) inputs.push_back({{"path", one.name}, {"pings", one.cube.pings.size()}});
  return inputs;
}

/// The coordinate system of the world of all runs; without one, some state none. Throws Error(content) if they
/// contradict each other.
std::string system_of_runs(const std::vector<std::string>& runs) {
  std::string common = StoredRun(runs.front()).system();
  for (const std::string& run : runs) {
    const std::string system = StoredRun(run).system();
    if (!system.empty() && !common.empty() && system != common)
      fail(ErrorKind::content, run, ": its world is in ", system, ", that of ", runs.front(), " in ", common,
           "; pings of two systems have no common world: merge those of one");
    if (system.empty()) common.clear();
  }
  return common;
}

/// Notes on what differs between the runs and is lost or ambiguous in the merged cube.
std::vector<std::string> merging_notes(const std::vector<NamedCube>& cubes, const Cube& merged) {
  std::vector<std::string> notes;
  std::size_t same_time = 0;
  for (std::size_t p = 1; p < merged.pings.size(); ++p) same_time += merged.pings[p].time == merged.pings[p - 1].time;
  bool had_layers = false, had_labels = false, other_settings = false;
  for (const NamedCube& one : cubes) {
    had_layers |= !one.cube.pings.front().layers.empty();
    had_labels |= !one.cube.pings.front().labels.empty();
    other_settings |= one.cube.seed != merged.seed || one.cube.tolerance != merged.tolerance ||
                      one.cube.source_level_db != merged.source_level_db;
  }
  if (same_time > 0)
    notes.push_back(
        fmt::format("{} pings have the time of the ping before; they follow in the order given", same_time));
  if (had_layers && merged.pings.front().layers.empty())
    notes.emplace_back("layers are left out: not all pings have the same layers");
  if (had_labels && merged.pings.front().labels.empty())
    notes.emplace_back("labels are left out: not all pings have labels of the same materials");
  if (other_settings)
    notes.emplace_back("runs differ in seed, tolerance or source level; the cube states those of the first run");
  return notes;
}

void merge(const MergeOptions& o) {
  if (o.mosaic.cell == 0 &&
      (!o.mosaic.bottom.empty() || o.mosaic.by != "mean" || !o.mosaic.crs.empty() || !o.mosaic.world.empty()))
    fail(ErrorKind::argument,
         !o.mosaic.world.empty()   ? "a place of the world (--anchor, --utm, --system)"
         : !o.mosaic.crs.empty()   ? "--crs"
         : o.mosaic.bottom.empty() ? "--mosaic-by"
                                   : "--bottom",
         " goes with --mosaic");
  if (o.runs.size() == 1 && is_survey_run(o.runs.front())) {
    if (!o.output.empty()) fail(ErrorKind::argument, "--output: a survey is merged in its own folder; leave it out");
    return merge_survey(o.runs.front(), o.copy, o.mosaic, o.common);
  }
  if (o.output.empty()) fail(ErrorKind::argument, "--output is missing: the run directory to make");
  if (o.copy || o.mosaic.cell > 0)
    fail(ErrorKind::argument, o.copy ? "--copy: " : "--mosaic: ", o.runs.front(),
         " is not the folder of a survey; leave it out");
  Progress progress(o.common, static_cast<int>(o.runs.size()) + 1);
  const std::string system = system_of_runs(o.runs);
  RunDirectory directory(o.output, o.force, o.runs);
  std::vector<NamedCube> cubes;
  for (const std::string& run : o.runs) {
    progress.step("reading " + run);
    if (const std::string doubt = integrity_problem(run, "cube.h5"); !doubt.empty())
      fail(ErrorKind::content, doubt, "; copy the run again, or name its cube.h5 to merge it as it is");
    cubes.push_back({run, read_cube(StoredRun(run).cube())});
  }
  ordered_json manifest = {{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"merged", inputs_json(cubes)}};
  const MergedCube merged = merge_cubes_by_time(cubes);
  manifest["pings"] = merged.cube.pings.size();
  if (!system.empty()) manifest["scene"] = {{"system", system}};
  std::vector<std::string> notes = merging_notes(cubes, merged.cube);

  progress.step("writing " + o.output);
  write_cube(directory.file("cube.h5"), merged.cube);
  for (const std::string& note : merge_companions(directory, o.runs, merged, manifest)) notes.push_back(note);
  for (const PingNote& note : merged.cube.notes) notes.push_back(sentence(note));
  for (const std::string& note : notes) progress.note(note);
  manifest["notes"] = notes;
  if (const std::string settings = StoredRun(o.runs.front()).find("run.toml"); !settings.empty())
    write_file(directory.file("run.toml"), read_text_file(settings));
  write_manifest(directory, manifest);
  directory.commit();
  print_summary(o.common, manifest,
                fmt::format("{}: {} pings of {} runs", o.output, merged.cube.pings.size(), o.runs.size()));
}

}  // namespace

Verb merge_verb() {
  return make_verb<MergeOptions>(
      "merge", "join the pings of several runs of one sonar by time; or the blocks of a survey",
      {"insonify merge out-0 out-1 out-2 -o track", "insonify merge survey", "insonify merge survey --mosaic 0.1",
       "insonify merge run-* -o track && insonify image track --view waterfall -o waterfall.png"},
      add_options, merge);
}

}  // namespace insonify::tool

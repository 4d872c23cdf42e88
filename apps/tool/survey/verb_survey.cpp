// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "run/parse_values.hpp"
#include "run_scenes/run_folder.hpp"
#include "scene_io/projected_system.hpp"
#include "simulate/ping_notes.hpp"
#include "store/csv_tables.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/run/world_reference.hpp"
#include "tool/survey/survey.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

void add_options(OptionList list, SurveyOptions& o) {
  list.add("MISSION", &o.mission, "TOML file: scene, trajectory, heads, legs (docs/survey.md)", {.required = true});
  list.add(
      "-o,--output", &o.output,
      "folder of the survey: a new folder, or that of an earlier run of this mission, whose finished blocks are kept");
  list.add("--shard", &o.shard,
           "I/N with I from 0 to N-1: make every Nth block of pings, beginning with block I; blocks are counted head "
           "after head");
  list.add("--pings-per-block", &o.pings_per_block,
           "pings that are stored together, and made again after a kill; 0: as in the survey that is continued, else "
           "as many as fill 32 MiB, at most 64",
           {.within = std::pair(0, 100000), .shown_as = "INT"});
  list.add("--plan", &o.plan,
           "only print the numbers of pings, bytes and CPU hours; measured by one to five pings of each head, at most "
           "a twentieth of the survey");
  add_common(list, o.common);
  list.add("-j,--threads", &o.common.threads,
           "pings that are made at once; 0: as many as cores. Results do not depend on it",
           {.within = std::pair(0, 1024)});
}

struct Shard {
  std::size_t index = 0, of = 1;
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const bool numbers = slash != text.npos && to_number(std::string_view(text).substr(0, slash), shard.index) &&
                       to_number(std::string_view(text).substr(slash + 1), shard.of);
  if (!numbers || shard.index >= shard.of)
    fail(ErrorKind::argument, "--shard = '", text, "' is not I/N with I from 0 to N-1, e.g. --shard 0/8");
  return shard;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A ping that may be tried, and numbers of what it is made of: scatterers, and with the samples of its image what its
/// time goes with; 1 each where the scene is not at hand.
struct PlannedPing {
  SurveyPing ping;
  double scatterers = 1, work = 1;
};

/// A trial of the cost of the pings of a head: of a few, evenly spaced, some are made, and the others count as their
/// plans compare.
struct HeadTrial {
  std::size_t pings = 0, tried = 0;
  std::vector<PlannedPing> planned;  ///< the most typical first
  double cpu = 0, first_cpu = 0, scatterers = 0, soundings = 0, image_bytes = 0;

  /// All pings over those tried, by a number of their plans.
  double share(double PlannedPing::*number) const {
    double all = 0, made = 0;
    for (std::size_t k = 0; k < planned.size(); ++k)
      all += planned[k].*number, made += k < tried ? planned[k].*number : 0;
    const double n = static_cast<double>(pings);
    return made > 0    ? n * all / (made * static_cast<double>(planned.size()))
           : tried > 0 ? n / static_cast<double>(tried)
                       : 0;
  }

  /// CPU time of all pings [s]. The first one also makes what the others use again, which a second one shows.
  double cpu_of_all() const {
    double later = 0;
    for (std::size_t k = 1; k < tried; ++k) later += planned[k].work;
    if (!(later > 0)) return cpu * share(&PlannedPing::work);
    double mean = 0;
    for (const PlannedPing& p : planned) mean += p.work / static_cast<double>(planned.size());
    const double rate = (cpu - first_cpu) / later;
    return std::max(0.0, first_cpu - rate * planned.front().work) + rate * mean * static_cast<double>(pings);
  }
};

std::vector<HeadTrial> trials_of(const SurveySetup& s, const OpenScene& scene) {
  constexpr std::size_t most = 5;
  std::vector<HeadTrial> trials(s.heads.size());
  for (std::size_t h = 0; h < trials.size(); ++h) {
    HeadTrial& trial = trials[h];
    std::vector<SurveyPing> pings;
    std::copy_if(s.survey->pings().begin(), s.survey->pings().end(), std::back_inserter(pings),
                 [h](const auto& p) { return p.head == h; });
    trial.pings = pings.size();
    const std::size_t positions = std::min(most, pings.size());
    double mean = 0;
    for (std::size_t k = 0; k < positions; ++k) {
      PlannedPing planned{pings[(2 * k + 1) * pings.size() / (2 * positions)]};
      if (scene.shared()) {
        const PingSimulator simulator = s.survey->simulator_of(planned.ping);
        const PingEvent event = s.survey->event_of(planned.ping);
        const SonarHead& head = simulator.head();
        planned.scatterers = static_cast<double>(simulator.count(*scene.scene_for(simulator, event), event).scatterers);
        planned.work = planned.scatterers + static_cast<double>(head.fan.beams() * head.gate.bins());
      }
      mean += planned.work / static_cast<double>(positions);
      trial.planned.push_back(planned);
    }
    const auto off = [mean](const PlannedPing& p) { return std::abs(p.work - mean); };
    std::stable_sort(trial.planned.begin(), trial.planned.end(),
                     [&](const auto& a, const auto& b) { return off(a) < off(b); });
  }
  return trials;
}

/// Bytes of the images of a ping in a cube. Labels are packed: a pixel that shows a surface has some 6 bytes of them.
double stored_bytes(const Ping& ping) {
  constexpr double label_bytes = 6;
  const auto size = [](const auto& image) { return static_cast<double>(image.size()); };
  const double sample_bytes = ping.display_cells ? 2 : 8;
  double bytes = sample_bytes * size(ping.pressure) + 4 * (size(ping.intensity) + size(ping.split_phase));
  for (const Layer& layer : ping.layers) bytes += sample_bytes * size(layer.pressure);
  if (ping.labels.id.size() > 0)
    bytes += label_bytes * static_cast<double>((ping.labels.id != PixelLabels::no_id).count());
  return bytes;
}

/// Makes a ping of each head, then more, as long as the plan takes at most a twentieth of the survey. `begun` is the
/// CPU time when the scene began to be loaded.
void try_pings(const SurveySetup& s, const OpenScene& scene, int cores, double begun, std::vector<HeadTrial>& trials) {
  constexpr double most_of_survey = 0.04;  // of a forecast that may fall when more than the first ping is known
  const auto is_cheap = [&](const HeadTrial& next) {
    double survey = 0;
    for (const HeadTrial& trial : trials) survey += trial.cpu_of_all() / cores;
    return cpu_seconds() - begun + next.cpu / static_cast<double>(next.tried) <= most_of_survey * survey;
  };
  bool more = true;
  for (bool first = true; std::exchange(more, false); first = false)
    for (HeadTrial& trial : trials) {
      if (trial.tried >= trial.planned.size() || (!first && !is_cheap(trial))) continue;
      const double begin = cpu_seconds();
      const PingOutcome made = s.survey->simulate(trial.planned[trial.tried].ping, scene);
      trial.cpu += cpu_seconds() - begin;
      if (trial.tried == 0) trial.first_cpu = trial.cpu;
      trial.scatterers += static_cast<double>(made.scatterers);
      trial.soundings += static_cast<double>(made.soundings.size());
      trial.image_bytes += stored_bytes(made.ping);
      ++trial.tried, more = true;
    }
}

ordered_json cost_of_head(const SurveySetup& s, const HeadTrial& trial, std::size_t h) {
  constexpr double row_bytes = 76;  // of returns.ply
  const double n = static_cast<double>(trial.pings), share = trial.share(&PlannedPing::scatterers);
  const double images = trial.image_bytes > 0  // else the pings failed
                            ? trial.image_bytes / static_cast<double>(trial.tried)
                            : static_cast<double>(image_bytes(s.heads[h]));
  return {{"name", s.file.mission.heads[h].name},
          {"pings", trial.pings},
          {"pings_tried", trial.tried},
          {"echoes", std::llround(trial.scatterers * share)},
          {"returns", std::llround(trial.soundings * share)},
          {"bytes", std::llround(n * images + trial.soundings * share * row_bytes)},
          {"cpu_hours", trial.cpu_of_all() / 3600}};
}

void print_plan(const ordered_json& plan) {
  fmt::print("{:<16} {:>9} {:>11} {:>11} {:>10} {:>10}\n", "head", "pings", "echoes", "returns", "MB", "CPU hours");
  const auto print_row = [](const ordered_json& row) {
    fmt::print("{:<16} {:>9} {:>11.3g} {:>11.3g} {:>10.4g} {:>10.3g}\n", row["name"].get<std::string>(),
               row["pings"].get<std::size_t>(), row["echoes"].get<double>(), row["returns"].get<double>(),
               row["bytes"].get<double>() / 1e6, row["cpu_hours"].get<double>());
  };
  for (const auto& head : plan["heads"]) print_row(head);
  if (plan["heads"].size() > 1) print_row(plan["all"]);
  fmt::print("{} blocks; about {:.3g} hours on {} cores\n", plan["blocks"].get<std::size_t>(),
             plan["hours"].get<double>(), plan["cores"].get<int>());
}

void plan_survey(const SurveyOptions& o, const SurveySetup& s, const OpenScene& scene, double begun) {
  const int cores = thread_count(o.common.threads);
  std::vector<HeadTrial> trials = trials_of(s, scene);
  try_pings(s, scene, cores, begun, trials);
  ordered_json heads = ordered_json::array(), all = {{"name", "all"}};
  for (std::size_t h = 0; h < s.heads.size(); ++h) heads.push_back(cost_of_head(s, trials[h], h));
  for (const char* key : {"pings", "echoes", "returns", "bytes", "cpu_hours"}) {
    double sum = 0;
    for (const auto& head : heads) sum += head[key].get<double>();
    all[key] = sum;
  }
  const ordered_json plan = {{"heads", heads},
                             {"all", all},
                             {"blocks", s.blocks.size()},
                             {"cores", cores},
                             {"hours", all["cpu_hours"].get<double>() / cores},
                             {"cpu_seconds_to_plan", cpu_seconds() - begun}};
  print_result(o.common, plan, [&] { print_plan(plan); });
}

/// The work of a shard that is still to be done.
struct Todo {
  std::vector<SurveyBlock> blocks;
  std::size_t pings = 0, done = 0;  ///< pings of the shard; of these, in finished blocks
};

Todo blocks_of(const SurveySetup& s, const std::string& folder, const Shard& shard) {
  Todo todo;
  for (std::size_t b = shard.index; b < s.blocks.size(); b += shard.of) {
    const std::size_t pings = s.blocks[b].end - s.blocks[b].begin;
    todo.pings += pings;
    if (is_done(s, folder, s.blocks[b]))
      todo.done += pings;
    else
      todo.blocks.push_back(s.blocks[b]);
  }
  return todo;
}

/// The failed pings of the shard's blocks, as "head ping: reason".
std::vector<std::string> failures_of(const SurveyOptions& o, const SurveySetup& s, const Shard& shard) {
  std::vector<std::string> failures;
  for (std::size_t b = shard.index; b < s.blocks.size(); b += shard.of) {
    const std::string& name = s.file.mission.heads[s.blocks[b].head].name;
    if (const auto mark = find_mark(block_files(o.output, name, s.blocks[b].number), s.run.mission_sha256))
      for (const FailedPing& ping : mark->failed)
        failures.push_back(fmt::format("{} ping {}: {}", name, ping.number, ping.reason));
  }
  return failures;
}

/// Prints the notes of the pings made, but of silence, which make_pings says with a remedy.
ordered_json say_notes(const SurveySetup& s, const SurveyFolder& made, Progress& progress) {
  ordered_json notes = ordered_json::array();
  for (const auto& [number, of_head] : made.notes()) {
    const std::string& head = s.file.mission.heads[number].name;
    for (const PingNote& note : of_head) {
      if (note.kind != silent_note_kind) progress.note(head + ": " + sentence(note));
      notes.push_back(note_json(note, head));
    }
  }
  return notes;
}

void make_pings(const SurveyOptions& o, SurveySetup& s, const Shard& shard, Progress& progress) {
  // A scene that does not fit is refused before there is a folder; of a survey that is done it is not read at all.
  std::shared_ptr<const OpenScene> scene;
  const auto load = [&] {
    progress.step("loading " + s.file.scene);
    scene = open_survey_scene(s, o.common, progress);
    if (const std::string& system = scene->report().meaning.system.value; epsg_of_system(system) > 0)
      progress.note("the world is in " + system + ", which exports take");
    decide_detail(*scene, o.common.threads, s);
  };
  if (!is_survey_run(o.output)) load();
  open_survey_run(o.output, s.run);
  write_survey_settings(s, o.output);
  const Todo todo = blocks_of(s, o.output, shard);
  const std::string name = shard.of == 1 ? "status.json" : fmt::format("status-{}-of-{}.json", shard.index, shard.of);
  SurveyStatus status(progress, (std::filesystem::path(o.output) / name).string(), o.shard, todo.pings, todo.done);

  bool whole = true;
  std::size_t silent = 0;
  ordered_json notes = ordered_json::array();
  if (!todo.blocks.empty()) {
    if (!scene) load();
    record_system(o.output, scene->report().meaning.system.value);
    progress.step("pinging");
    SurveyFolder folder(s, o.output, status, progress);
    finish_on_interrupt("finished pings are kept; the same command goes on from there");
    whole = simulate_survey(*s.survey, todo.blocks, *scene, folder, o.common.threads);
    silent = folder.silent();
    notes = say_notes(s, folder, progress);
  }
  const std::vector<std::string> failures = failures_of(o, s, shard);
  status.write(whole ? "done" : "interrupted");
  if (!whole)
    throw Interrupted{fmt::format("{} of {} pings of {} are {}; the same command goes on from there",
                                  todo.done + status.made(), todo.pings, o.output,
                                  s.file.coverage ? "made, those of whole blocks kept" : "kept")};
  if (silent > 0)
    progress.note(fmt::format(
        "{} of {} pings are silent: no surfel is inside fan and range; `insonify image {} --ping N` shows such a ping; "
        "turn the head, lengthen its range, or make these parts of the way a transit (active = false)",
        silent, status.made(), o.output));
  const ordered_json result = {{"folder", o.output},         {"pings", todo.pings}, {"made", status.made()},
                               {"silent", silent},           {"failed", failures},  {"notes", notes},
                               {"seconds", status.seconds()}};
  print_summary(o.common, result,
                fmt::format("{}: {} of {} pings made in {:.1f} s; join them with: insonify merge {}", o.output,
                            status.made(), todo.pings, status.seconds(), o.output));
  if (!failures.empty())
    throw SomeFailed{
        fmt::format("{} of {} pings failed: {}", failures.size(), todo.pings, shortened_list(failures, "; "))};
}

void survey(const SurveyOptions& o) {
  const Shard shard = parse_shard(o.shard);
  if (o.output.empty() != o.plan)
    fail(ErrorKind::argument, "give either --output, a folder for the survey, or --plan, a forecast");
  Progress progress(o.common, 3);
  SurveySetup s = set_up_survey(o);
  for (const PingSetup& head : s.heads)
    for (const std::string& note : head.notes) progress.note(note);
  for (const std::string& note : s.notes) progress.note(note);
  if (lower_case(s.file.trajectory).ends_with(".csv"))
    for (const std::string& note : trajectory_notes(s.file.trajectory)) progress.note(note);
  if (!o.plan) return make_pings(o, s, shard, progress);
  progress.step("loading " + s.file.scene);
  const double begun = cpu_seconds();
  const auto scene = open_survey_scene(s, o.common, progress);
  progress.step("planning");
  decide_detail(*scene, o.common.threads, s);
  plan_survey(o, s, *scene, begun);
}

}  // namespace

Verb survey_verb() {
  return make_verb<SurveyOptions>("survey", "all pings of a mission: a vehicle with sonars along a trajectory",
                                  {"insonify survey mission.toml --plan", "insonify survey mission.toml -o run",
                                   "insonify survey mission.toml -o run --shard 3/8", "insonify merge run"},
                                  add_options, survey);
}

}  // namespace insonify::tool

#include "tool/run_pings.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/environment_file.hpp"
#include "store/mission_file.hpp"
#include "store/survey_run.hpp"
#include "tool/image.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

const SurveyRunHead& head_of_survey(const SurveyRun& survey, const std::string& run, const std::string& head) {
  for (const SurveyRunHead& each : survey.heads)
    if (each.name == head || (head.empty() && survey.heads.size() == 1)) return each;
  fail(ErrorKind::argument, "--head = '", head, "' must name a head of ", run, ": ",
       joined(survey.heads, ", ", &SurveyRunHead::name));
}

RunPings pings_of_survey(const std::string& run, const std::string& head_name) {
  const SurveyRun survey = load_survey_run(run);
  const SurveyRunHead& head = head_of_survey(survey, run, head_name);
  RunPings pings;
  for (std::size_t b = 0; b < head.blocks(); ++b) {
    const BlockFiles files = block_files(run, head.name, static_cast<std::int64_t>(b));
    if (!find_mark(files, survey.mission_sha256))
      fail(ErrorKind::content, run, ": block ", b, " of ", head.name,
           " is not done; run the survey (or its missing shards) again");
    if (fs::exists(files.cube)) pings.cubes.push_back(files.cube);  // else all its pings failed
  }
  const std::string settings = run + "/" + head.name + "/run.toml", mission = run + "/mission.toml";
  if (fs::exists(settings)) pings.environment = load_environment(settings);
  if (fs::exists(mission)) {
    const MissionFile file = load_mission(mission);
    pings.anchor = file.anchor;
    pings.start_utc = file.start_utc;
  }
  return pings;
}

}  // namespace

RunPings find_run_pings(const std::string& run, const std::string& head) {
  if (fs::is_directory(run) && is_survey_run(run)) return pings_of_survey(run, head);
  RunPings pings;
  pings.cubes = {run_cube_path(run)};
  const std::string settings = run + "/run.toml";
  if (fs::is_directory(run) && fs::exists(settings)) pings.environment = load_environment(settings);
  return pings;
}

void each_ping(const RunPings& run, const std::function<void(const Cube&, const Ping&)>& use) {
  for (const std::string& path : run.cubes) read_cube_pings(path, use);
}

BottomOptions bottom_options(const Cube& cube, const Ping& ping, const Environment& environment, int per_beam) {
  BottomOptions options;
  options.sound_speed = ping.sound_speed;
  options.centre_frequency = cube.centre_frequency;
  options.range_resolution = range_resolution({cube.centre_frequency, cube.bandwidth, 0}, ping.sound_speed);
  options.absorption_db_per_m = ping.absorption_db_per_m;
  options.per_beam = per_beam;
  options.profile = environment.profile;
  options.head_depth = insonify::head_depth(environment, ping.world_from_head.translation().z());
  return options;
}

double seconds_of_utc(const std::string& text) {
  if (text.empty()) return 0;
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0;
  const int read =
      std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lfZ%n", &year, &month, &day, &hour, &minute, &second, &used);
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (read != 6 || used != static_cast<int>(text.size()) || !date.ok() || hour > 23 || minute > 59 || !(second < 61))
    fail(ErrorKind::argument, "--start-utc '", text, "', must be a time of UTC as 2026-05-01T08:30:00Z");
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * minute + second;
}

}  // namespace insonify::tool

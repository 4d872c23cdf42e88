// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/run_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "store/environment_file.hpp"
#include "store/toml_tree.hpp"

namespace insonify {

using nlohmann::ordered_json;

std::string run_toml(const PingSetup& setup, const std::string& settings) {
  const HeadOptions& requested = setup.run.head;
  return fmt::format(
      "# Everything that made this run, merged.\nschema = 1\ninsonify_version = \"{}\"\n"
      "environment_file = {}\nprofile_file = {}\n{}\n{}\n[sonar]\n{}",
      INSONIFY_VERSION, as_toml(requested.environment), as_toml(requested.profile), settings,
      environment_as_toml(setup.environment), sonar_as_toml(setup.spec));
}

Cube cube_of(std::vector<Ping> pings, const PingSetup& setup) {
  Cube cube = make_cube(setup.head, setup.medium);
  cube.seed = setup.run.simulation.seed, cube.tolerance = setup.run.simulation.synthesis.tolerance;
  cube.pings = std::move(pings);
  const Ping& first = cube.pings.front();
  cube.sound_speed = first.sound_speed, cube.absorption_db_per_m = first.absorption_db_per_m;
  cube.keep_bits = setup.run.output.keep_bits;
  return cube;
}

ordered_json note_json(const PingNote& note, const std::string& head) {
  ordered_json json = {{"kind", note.kind}, {"pings", note.count}, {"first_ping", note.first}, {"text", note.text}};
  if (!head.empty()) json["head"] = head;
  return json;
}

void draw_if_possible(const std::string& lacks, const std::function<void()>& draw, ordered_json& manifest,
                      RunObserver& observer) {
  std::string reason;
  try {
    return draw();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::runtime && error.kind() != ErrorKind::memory) throw;
    reason = error.what();
  } catch (const std::bad_alloc&) {
    reason = "out of memory";
  }
  observer.note(lacks + ": " + reason);
  manifest["notes"].push_back(lacks + ": " + reason);
}

std::string picture_title(const std::string& sonar, const Ping& ping) {
  return fmt::format("{}, ping {}, {:g} to {:g} m{}", sonar, ping.number, ping.gate.min_range, ping.gate.max_range,
                     ping.expected_level ? std::string(", ") + expected_level_text : "");
}

}  // namespace insonify

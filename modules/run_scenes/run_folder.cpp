// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/run_folder.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <future>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "files/peak_memory.hpp"
#include "files/sha256.hpp"
#include "returns/coverage.hpp"
#include "run/parse_values.hpp"
#include "run/run_checks.hpp"
#include "run/run_settings.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/ping_notes.hpp"
#include "store/element_file.hpp"
#include "store/environment_file.hpp"
#include "store/run_directory.hpp"
#include "store/toml_tree.hpp"

namespace insonify {

using nlohmann::ordered_json;

namespace {

ordered_json sonar_json(const PingSetup& setup, double sound_speed) {
  const SonarHead& head = setup.head;
  return {{"name", head.name},
          {"beams", head.fan.beams()},
          {"elements", head.array.elements()},
          {"bins", head.gate.bins()},
          {"min_range_m", head.gate.min_range},
          {"max_range_m", head.gate.max_range},
          {"bin_size_m", head.gate.bin_size},
          {"centre_frequency_hz", head.pulse.centre_frequency},
          {"bandwidth_hz", head.pulse.bandwidth},
          {"range_resolution_fwhm_m", range_resolution(head.pulse, sound_speed)},
          {"range_resolution_nominal_m", nominal_range_resolution(head.pulse, sound_speed)},
          {"source_level_db", head.pulse.source_level_db},
          {"not_sourced", numbers_json(setup.doubtful)}};
}

ordered_json write_insonification(const RunDirectory& directory, const SceneCloud& scene, const PingSetup& setup,
                                  const SimulatedPing& ping) {
  const std::vector<CoveredSurfel> covered = coverage_of(scene, ping.outputs.scatterers, setup.head, ping.report.medium,
                                                         {.threads = setup.simulation.threads});
  for (const char* file : {"insonification.ply", "insonification.pcd"})
    save_insonification(directory.file(file), scene, covered);
  return {{"surfels", scene.size()}, {"insonified", covered.size()}};
}

/// Writes the returns as both clouds; returns the local origin of the PCD.
Eigen::Vector3d save_returns(RunDirectory& directory, const Soundings& soundings, ordered_json& manifest) {
  const Eigen::Vector3d origin = save_soundings(directory.file("returns.pcd"), soundings);
  manifest["returns_pcd_origin_m"] = {origin.x(), origin.y(), origin.z()};
  save_soundings(directory.file("returns.ply"), soundings);
  return origin;
}

std::string origin_note(const Eigen::Vector3d& origin) {
  return fmt::format("returns.pcd counts from {:.0f}, {:.0f}, {:.0f} m, as its VIEWPOINT says: a PCD is float32",
                     origin.x(), origin.y(), origin.z());
}

ordered_json seconds_json(double load, const StageSeconds& of, double output) {
  return {{"load", load},
          {"sampling", of.sampling},
          {"acoustics", of.acoustics},
          {"synthesis", of.synthesis},
          {"detection", of.detection},
          {"contributors", of.contributors},
          {"output", output}};
}

}  // namespace

RunFolder::RunFolder(const PingSetup& setup, const std::vector<std::string>& inputs, const RunPictures& pictures,
                     RunObserver& observer)
    : setup_(setup),
      pictures_(pictures),
      observer_(observer),
      directory_(setup.run.output.folder, setup.run.output.force, inputs) {}

SimulationOptions RunFolder::options_for(const SceneCloud& scene) {
  SimulationOptions options = setup_.simulation;
  const std::size_t per_pixel = static_cast<std::size_t>(options.outputs.contributors);
  if (per_pixel == 0) return options;
  const SonarHead& head = setup_.head;
  contributors_ =
      std::make_unique<ContributorFile>(directory_.file("contributors.h5"), head.fan.beams(), head.gate.bins(),
                                        per_pixel, words_of(scene.materials), options.effects.double_echoes > 0);
  options.outputs.contributor_sink = this;
  return options;
}

void RunFolder::take(const Contributors& band, std::size_t first_beam) {
  contributors_->write(band, first_beam);
  for (std::size_t i = 0; i < band.share.size(); ++i) {
    pixels_ += i % band.per_pixel == 0 && band.share[i] > 0;
    share_ += static_cast<double>(band.share[i]);
  }
}

ordered_json RunFolder::write(SimulatedPing ping, const PingPlan& plan, const PingScene& scene,
                              const SceneInstances& instances, double load_seconds) {
  ordered_json manifest = {
      {"schema", 1},         {"insonify_version", INSONIFY_VERSION},        {"seed", setup_.simulation.seed},
      {"scene", scene.json}, {"notes", notes_before(setup_, scene.report)}, {"plan", plan_json(plan)}};
  const auto note_to_user = [&](const std::string& note) {
    observer_.note(note);
    manifest["notes"].push_back(note);
  };
  for (const std::string& note : ping_notes(ping, setup_, scene.positions)) note_to_user(note);

  observer_.step("writing " + setup_.run.output.folder);
  StopWatch watch;
  const Eigen::Vector3d origin = save_returns(directory_, ping.soundings, manifest);
  if (!origin.isZero(0)) note_to_user(origin_note(origin));
  write_kept(ping, scene.scene->scene(), instances, manifest);
  describe_ping(ping, setup_, manifest);
  Run written = setup_.run;
  std::vector<PingNote> notes = notes_of(ping, setup_.environment, setup_.head.gate);
  write_image(std::move(ping.ping), std::move(notes), settings_as_toml(all_settings(written)), manifest);
  manifest["seconds"] = seconds_json(load_seconds, ping.report.seconds, watch.lap());
  finish(manifest);
  return manifest;
}

void RunFolder::write_kept(const SimulatedPing& ping, const SceneCloud& scene, const SceneInstances& instances,
                           ordered_json& manifest) {
  const OutputSettings& outputs = setup_.simulation.outputs;
  if (outputs.elements)
    write_element_file(directory_.file("elements.h5"), ping.outputs.elements, setup_.head,
                       ping.report.medium.sound_speed);
  if (contributors_) {
    contributors_->finish(material_image(ping.ping.labels), instance_image(ping.ping.labels, instances));
    manifest["contributors"] = {{"per_pixel", outputs.contributors},
                                {"pixels", pixels_},
                                {"mean_share_listed", pixels_ > 0 ? share_ / static_cast<double>(pixels_) : 0}};
  }
  if (outputs.paths > 0) {
    pictures_.write_paths(ping.outputs.paths, directory_.file("paths.vtp"));
    manifest["paths"] = {{"lines", ping.outputs.paths.size()}};
  }
  if (outputs.scatterers) manifest["insonification"] = write_insonification(directory_, scene, setup_, ping);
}

void RunFolder::write_image(Ping image, std::vector<PingNote> notes, const std::string& settings,
                            ordered_json& manifest) {
  // The cube is written while the picture is drawn.
  std::vector<Ping> pings;
  pings.push_back(std::move(image));
  Cube cube = cube_of(std::move(pings), setup_);
  cube.notes = std::move(notes);
  const Ping& ping = cube.pings.front();
  std::future<std::string> digest = std::async(std::launch::async, [&, path = directory_.file("cube.h5")] {
    write_cube(path, cube);
    return sha256_of_file(path);
  });
  write_file(directory_.file("run.toml"), run_toml(setup_, settings));

  const auto draw = [&] {
    pictures_.draw_fan(ping, picture_title(setup_.head.name, ping), directory_.file("fan.png"));
  };
  if (!setup_.run.output.no_picture) draw_if_possible("no fan.png", draw, manifest, observer_);

  manifest[digests_key]["cube.h5"] = digest.get();
  if (ping.expected_level)
    manifest["pressure"] = expected_level_text;
  else if (ping.display_cells)
    manifest["pressure"] = "display cells: mean intensity over area, no phase";
  manifest["sonar"] = sonar_json(setup_, cube.sound_speed);
  const Environment& environment = setup_.environment;
  const Water& water = environment.water;
  const double z = ping.world_from_head.translation().z();
  manifest["water"] = {{"temperature_c", water.temperature_c},  {"salinity_psu", water.salinity_psu},
                       {"depth_m", head_depth(environment, z)}, {"ph", water.ph},
                       {"sound_speed", ping.sound_speed},       {"absorption_db_per_m", ping.absorption_db_per_m}};
  manifest["peak_memory_mib"] = peak_memory_mib();
}

void RunFolder::finish(const ordered_json& manifest) { write_manifest(directory_, manifest); }

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

ordered_json numbers_json(const std::vector<SourcedNumber>& numbers) {
  ordered_json all = ordered_json::array();
  for (const SourcedNumber& n : numbers)
    all.push_back({{"key", n.key}, {"value", n.value}, {"status", n.status}, {"source", n.source}});
  return all;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/run_files.hpp"

#include <algorithm>
#include <future>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/peak_memory.hpp"
#include "files/sha256.hpp"
#include "returns/coverage.hpp"
#include "returns/label_objects.hpp"
#include "run/run_checks.hpp"
#include "run/run_settings.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/contributor_file.hpp"
#include "store/environment_file.hpp"
#include "store/run_manifest.hpp"
#include "store/toml_tree.hpp"

namespace insonify {
namespace {

using nlohmann::ordered_json;

ordered_json sonar_json(const HeadSetup& setup, double sound_speed) {
  ordered_json doubtful = ordered_json::array();
  for (const SonarNumber& n : setup.doubtful)
    doubtful.push_back({{"key", n.key}, {"value", n.value}, {"status", n.status}, {"source", n.source}});
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
          {"not_sourced", doubtful}};
}

}  // namespace

std::string run_toml(const RunOptions& run, const HeadSetup& setup, const std::string& settings) {
  return fmt::format(
      "# Everything that made this run, merged.\nschema = 1\ninsonify_version = \"{}\"\n"
      "environment_file = {}\nprofile_file = {}\n{}\n{}\n[sonar]\n{}",
      INSONIFY_VERSION, as_toml(run.environment), as_toml(run.profile), settings,
      environment_as_toml(setup.environment), sonar_as_toml(setup.spec));
}

Cube cube_of(std::vector<Ping> pings, const CommonOptions& common, const RunOptions& run, const HeadSetup& setup) {
  Cube cube = make_cube(setup.head, setup.medium);
  cube.seed = common.seed, cube.tolerance = run.tolerance;
  cube.pings = std::move(pings);
  const Ping& first = cube.pings.front();
  cube.sound_speed = first.sound_speed, cube.absorption_db_per_m = first.absorption_db_per_m;
  cube.keep_bits = run.keep_bits;
  return cube;
}

ordered_json note_json(const PingNote& note, const std::string& head) {
  ordered_json json = {{"kind", note.kind}, {"pings", note.count}, {"first_ping", note.first}, {"text", note.text}};
  if (!head.empty()) json["head"] = head;
  return json;
}

void write_run(const RunDirectory& directory, const CommonOptions& common, const RunOptions& run,
               const HeadSetup& setup, NotedPing noted, const std::string& settings, ordered_json& manifest,
               const RunPictures& pictures, RunObserver& observer) {
  // The cube is written while the picture is drawn.
  std::vector<Ping> pings;
  pings.push_back(std::move(noted.ping));
  Cube cube = cube_of(std::move(pings), common, run, setup);
  cube.notes = std::move(noted.notes);
  const Ping& ping = cube.pings.front();
  std::future<std::string> digest = std::async(std::launch::async, [&, path = directory.file("cube.h5")] {
    write_cube(path, cube);
    return sha256_of_file(path);
  });
  write_file(directory.file("run.toml"), run_toml(run, setup, settings));

  const auto draw = [&] { pictures.draw_fan(ping, picture_title(setup.head.name, ping), directory.file("fan.png")); };
  if (!run.no_picture) draw_if_possible("no fan.png", draw, manifest, observer);

  manifest[digests_key]["cube.h5"] = digest.get();
  if (ping.expected_level)
    manifest["pressure"] = expected_level_text;
  else if (ping.display_cells)
    manifest["pressure"] = "display cells: mean intensity over area, no phase";
  manifest["sonar"] = sonar_json(setup, cube.sound_speed);
  const Water& water = setup.environment.water;
  const double z = ping.world_from_head.translation().z();
  manifest["water"] = {{"temperature_c", water.temperature_c},
                       {"salinity_psu", water.salinity_psu},
                       {"depth_m", head_depth(setup.environment, z)},
                       {"ph", water.ph},
                       {"sound_speed", ping.sound_speed},
                       {"absorption_db_per_m", ping.absorption_db_per_m}};
  manifest["peak_memory_mib"] = peak_memory_mib();
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

using nlohmann::ordered_json;

namespace {

ordered_json write_insonification(const RunDirectory& directory, const SceneCloud& scene, const PingSetup& setup,
                                  const SimulatedPing& ping) {
  const std::vector<CoveredSurfel> covered = coverage_of(scene, ping.outputs.scatterers, setup.head.head,
                                                         ping.report.medium, {.threads = setup.simulation.threads});
  for (const char* file : {"insonification.ply", "insonification.pcd"})
    save_insonification(directory.file(file), scene, covered);
  return {{"surfels", scene.size()}, {"insonified", covered.size()}};
}

}  // namespace

ContributorWriter::ContributorWriter(const RunDirectory& directory, const SceneCloud& scene, const SonarHead& head,
                                     SimulationOptions& options) {
  OutputSettings& outputs = options.outputs;
  if (outputs.contributors == 0) return;
  per_pixel_ = outputs.contributors;
  std::vector<std::string> materials;
  for (const Material& material : scene.materials) materials.push_back(material.name);
  file_ = std::make_unique<ContributorFile>(directory.file("contributors.h5"), head.fan.beams(), head.gate.bins(),
                                            static_cast<std::size_t>(per_pixel_), materials,
                                            options.effects.double_echoes > 0);
  outputs.contributor_sink = this;
}

void ContributorWriter::take(const Contributors& band, std::size_t first_beam) {
  file_->write(band, first_beam);
  for (std::size_t i = 0; i < band.share.size(); ++i) {
    pixels_ += i % band.per_pixel == 0 && band.share[i] > 0;
    share_ += static_cast<double>(band.share[i]);
  }
}

void ContributorWriter::finish(const PixelLabels& labels, const SceneInstances& instances, ordered_json& manifest) {
  if (!file_) return;
  file_->finish(material_image(labels), instance_image(labels, instances));
  manifest["contributors"] = {{"per_pixel", per_pixel_},
                              {"pixels", pixels_},
                              {"mean_share_listed", pixels_ > 0 ? share_ / static_cast<double>(pixels_) : 0}};
}

void write_kept(const RunDirectory& directory, const PingOptions& options, const SceneCloud& scene,
                const PingSetup& setup, const SimulatedPing& ping, const RunPictures& pictures,
                ordered_json& manifest) {
  if (setup.simulation.outputs.paths > 0) {
    pictures.write_paths(ping.outputs.paths, directory.file("paths.vtp"));
    manifest["paths"] = {{"lines", ping.outputs.paths.size()}};
  }
  if (keeps(options, "insonification"))
    manifest["insonification"] = write_insonification(directory, scene, setup, ping);
}

}  // namespace insonify

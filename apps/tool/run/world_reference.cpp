// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/world_reference.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "scene_io/projected_system.hpp"
#include "store/run_directory.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Throws Error(argument) if an option that gives a system of the world contradicts the one that is known.
void require_known_system(const std::string& option, int epsg, const KnownWorld& known) {
  if (const int own = epsg_of_system(known.system); own == 0 || own == epsg) return;
  fail(ErrorKind::argument, option, " is EPSG:", epsg, ", but the coordinates of ", known.run, " are in ", known.system,
       "; leave the option out");
}

/// The reference that an option or the run gives, and what gives it.
struct GivenWorld {
  std::optional<Georeference> reference;
  std::string option;
};

GivenWorld given_world(const WorldOptions& requested, const KnownWorld& known) {
  if (!requested.anchor.empty()) {
    if (epsg_of_system(known.system) > 0)
      fail(ErrorKind::argument, "--anchor: the coordinates of ", known.run, " are projected, in ", known.system,
           ", and an anchor is the place of a world with its own origin; leave it out");
    return {Georeference{{}, parse_anchor(requested.anchor, "--anchor")}, "--anchor"};
  }
  if (!requested.utm.empty() && !requested.system.empty())
    fail(ErrorKind::argument, "--utm and --system say the same thing; leave one out");
  if (!requested.utm.empty()) {
    const UtmZone zone = parse_utm_zone(requested.utm, "--utm");
    require_known_system("--utm " + requested.utm, epsg_code(zone), known);
    return {Georeference{zone}, "--utm " + requested.utm};
  }
  if (!requested.system.empty()) {
    const int epsg = requested.system.find(' ') == std::string::npos ? epsg_of_system(requested.system) : 0;
    if (epsg == 0) fail(ErrorKind::argument, "--system '", requested.system, "', must be EPSG:N, e.g. EPSG:25832");
    require_known_system("--system " + requested.system, epsg, known);
    return {georeference_in(epsg, "--system"), "--system " + requested.system};
  }
  if (const int epsg = epsg_of_system(known.system); epsg > 0)
    return {georeference_in(epsg, known.run.c_str()), known.run + ": system " + known.system};
  if (known.anchor) return {Georeference{{}, *known.anchor}, known.run + ": anchor of the mission"};
  return {};
}

}  // namespace

void add_world_options(OptionList list, WorldOptions& requested) {
  list.add(
      "--anchor", &requested.anchor,
      "LAT,LON[,HEADING] [deg] of the world's origin and x axis (clockwise from north), for a world with an origin "
      "of its own; default: anchor of the mission");
  list.add("--utm", &requested.utm,
           "zone and hemisphere of a world in UTM on WGS 84, e.g. 32N; default: the system that the scene states",
           {.excludes = "--anchor"});
  list.add(
      "--system", &requested.system,
      "EPSG:N of a world in another projected system (by GDAL and PROJ); default: the system of the mission or the "
      "scene",
      {.excludes = "--anchor"});
}

void record_system(const std::string& folder, const std::string& system) {
  if (system.empty()) return;
  const std::string path = (fs::path(folder) / "scene.json").string();
  if (!path_exists(path)) write_file(path, ordered_json{{"schema", 1}, {"scene", {{"system", system}}}}.dump(2) + "\n");
}

void require_same_system(const std::string& path, const std::optional<Anchor>& anchor, const std::string& system,
                         const std::string& of_scene) {
  const int epsg = epsg_of_system(of_scene);
  if (epsg == 0) return;  // unknown, or a local grid
  if (anchor)
    fail(ErrorKind::content, path, ": anchor is the place of a world with its own origin, but the coordinates of the ",
         "scene are projected, in ", of_scene, "; leave [survey.anchor] out");
  if (!system.empty() && epsg != epsg_of_system(system))
    fail(ErrorKind::content, path, ": system = '", system, "', but the scene is in ", of_scene, "; leave it out");
}

std::optional<Georeference> georeference_of(const WorldOptions& requested, const KnownWorld& known,
                                            const std::vector<Eigen::Vector3d>& positions) {
  require_same_system(known.run, known.anchor, "", known.system);
  const GivenWorld given = given_world(requested, known);
  if (given.reference)
    for (const Eigen::Vector3d& position : positions) require_plausible(*given.reference, position, given.option);
  return given.reference;
}

std::string utm_note(const WorldOptions& requested, const KnownWorld& known) {
  if (requested.utm.empty() || epsg_of_system(known.system) > 0) return "";
  const UtmZone zone = parse_utm_zone(requested.utm, "--utm");
  if (zone.north) return "";
  return fmt::format(
      "--utm {}: zone {} south of the equator (EPSG:{}); the band S of MGRS, 32 to 40 degrees north, is in zone {}N",
      requested.utm, zone.number, epsg_code(zone), zone.number);
}

}  // namespace insonify::tool

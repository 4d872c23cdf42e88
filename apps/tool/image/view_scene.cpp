// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/run_folder.hpp"
#include "run_scenes/stored_run.hpp"
#include "sampling/find_holes.hpp"
#include "simulate/resolve_ping.hpp"
#include "tool/command/progress.hpp"
#include "tool/image/image.hpp"
#include "tool/run/run_pings.hpp"
#include "view/show_scene.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

constexpr Named<SceneColour> colour_words[] = {
    {"height", SceneColour::height},         {"material", SceneColour::material}, {"part", SceneColour::part},
    {"visibility", SceneColour::visibility}, {"level", SceneColour::level},       {"grazing", SceneColour::grazing},
    {"incidence", SceneColour::incidence}};
constexpr Named<ScenePreset> camera_words[] = {{"auto", ScenePreset::automatic},
                                               {"behind", ScenePreset::behind},
                                               {"top", ScenePreset::top},
                                               {"side", ScenePreset::side},
                                               {"iso", ScenePreset::iso}};

/// A scene, how it is drawn, and its title.
struct Drawing {
  std::shared_ptr<const SceneCloud> scene;
  SceneLook look;
  std::string title;
  std::optional<View> view;  // of the head, if its sonar is known
};

void add_notes(const LoadReport& report, Progress& progress) {
  for (const std::string& note : loading_notes(report)) progress.note(note);
}

/// The scene of a run as it was when a ping was sent.
std::shared_ptr<const SceneCloud> load_of_ping(const ImageOptions& o, const SceneOptions& options, const Ping& ping,
                                               Progress& progress) {
  const auto scene = StoredRun(o.run).open_scene(options, o.common.threads);
  add_notes(scene->report(), progress);
  return scene->cloud_at(scene->moment_of(ping.time, ping.number));
}

/// Draws returns in the colour of their level over the grey scene, unless --colour says otherwise.
Drawing drawing_of_run(const ImageOptions& o, Progress& progress) {
  if (!o.sonar.empty() || !o.pose.empty() || !o.range.empty())
    fail(ErrorKind::argument, o.run,
         " is a run, whose sonar and poses are known; leave --sonar, --pose and --range out");
  const Cube cube = read_run_ping(o.run, static_cast<std::ptrdiff_t>(o.ping));
  const Ping& ping = cube.pings.front();
  const StoredRun run(o.run);
  SceneOptions options = run.scene();
  if (!o.scene.empty()) options.path = o.scene;
  if (options.path.empty()) fail(ErrorKind::content, o.run, ": does not say what its scene was; give it with --scene");

  Drawing drawing;
  drawing.scene = load_of_ping(o, options, ping, progress);
  drawing.look.head = SceneHead{ping.world_from_head, ping.fan, ping.gate};
  for (const TrackPoint& sent : read_track(run.cube()))
    drawing.look.track.emplace_back(sent.world_from_head.translation());
  drawing.look.colour = o.colour.empty() ? SceneColour::level : *find_named(colour_words, o.colour);
  if (drawing.look.colour == SceneColour::visibility)
    drawing.view = run.view(whole_of(*drawing.scene), o.common.threads);
  const std::string returns = run.find("returns.ply");
  const bool covered = drawing.look.colour == SceneColour::visibility || drawing.look.colour == SceneColour::grazing ||
                       drawing.look.colour == SceneColour::incidence;
  if (returns.empty()) {
    progress.note((fs::path(o.run) / "returns.ply").string() + " is missing, so no returns are drawn");
  } else if (!covered) {
    const std::optional<Tvg> tvg = tvg_of(o, ping.absorption_db_per_m);
    drawing.look.soundings = soundings_of_ping(load_soundings(returns), ping.number, tvg);
    drawing.look.level_unit = level_unit(tvg);
  }
  drawing.title = picture_title(cube.sonar, ping);
  return drawing;
}

/// Finds the visibility of every surfel from the head, and the holes of the scan in its view.
void look_from_head(const SceneCloud& scene, const std::optional<View>& view, int threads, SceneLook& look) {
  const auto& [pose, fan, head_gate] = *look.head;
  const RangeGate& gate = view ? view->gate : head_gate;
  SamplingOptions sampling = view ? view->sampling : SamplingOptions{};
  sampling.threads = threads;
  sampling.rays_per_beam = 16;
  const PreparedScene prepared(scene, threads);
  look.visibility = find_visibility(prepared, pose, fan, gate, std::vector<std::uint8_t>(scene.size(), 1), sampling);
  look.holes = hole_positions(find_holes(prepared, pose, fan, gate, sampling), pose);
}

Drawing drawing_of_scene(const ImageOptions& o, Progress& progress) {
  Drawing drawing;
  if (o.sonar.empty() != o.pose.empty())
    fail(ErrorKind::argument, "--sonar and --pose go together, e.g. --sonar p900-45 --pose=0,0,-3,0,10,0");
  if (o.colour == "level") fail(ErrorKind::argument, "--colour level: a scene alone has no levels; give a run");
  SceneOptions options;
  options.path = o.run;
  drawing.title = fs::path(o.run).filename().string();
  drawing.look.colour = o.sonar.empty() ? SceneColour::height : SceneColour::visibility;
  std::optional<PingSetup> setup;
  if (!o.sonar.empty()) {
    HeadOptions requested;
    requested.sonar = o.sonar;
    if (!o.range.empty()) requested.range = parse_range(o.range);
    setup = set_up_head(requested);
    const SonarHead& head = setup->head;
    drawing.look.head = SceneHead{parse_pose(o.pose, o.world) * setup->mount, head.fan, head.gate};
    drawing.title = head.name + " before " + drawing.title;
  }
  if (!o.colour.empty()) drawing.look.colour = *find_named(colour_words, o.colour);
  if (!drawing.look.head && (o.colour == "visibility" || o.colour == "grazing" || o.colour == "incidence"))
    fail(ErrorKind::argument, "--colour ", o.colour, " needs a head: give --sonar and --pose");
  LoadedScene loaded = load_any_scene(options, o.common.threads);
  add_notes(loaded.report, progress);
  drawing.scene = std::make_shared<const SceneCloud>(std::move(loaded.scene));
  if (setup) {
    end_range_with_scene(*setup, bounds(*drawing.scene), drawing.look.head->world_from_head);
    drawing.look.head->gate = setup->head.gate;
    drawing.view =
        resolve_ping(whole_of(*drawing.scene), setup->head, {drawing.look.head->world_from_head}, setup->environment)
            .view;
  }
  return drawing;
}

/// Draws the returns of a run over its scene, or of a scene alone its visibility from the sonar. Throws Error(argument)
/// for options that exclude one another, and as StoredRun::cube and load_scene.
void draw_scene(const ImageOptions& o) {
  Progress progress(o.common, 2);
  progress.step("reading " + o.run);
  const bool run = is_folder(o.run) || fs::path(o.run).extension() == ".h5";
  Drawing drawing = run ? drawing_of_run(o, progress) : drawing_of_scene(o, progress);
  SceneLook& look = drawing.look;
  look.camera = *find_named(camera_words, o.camera);
  look.normals = o.normals;
  if (look.colour == SceneColour::visibility) look_from_head(*drawing.scene, drawing.view, o.common.threads, look);

  progress.step("drawing " + o.output);
  PictureOptions picture = o.picture;
  if (picture.title.empty()) picture.title = drawing.title;
  show_scene(*drawing.scene, look, picture, o.output);
  print_summary(o.common, {{"output", o.output}, {"view", o.view}}, o.output);
}

}  // namespace

ViewSpec scene_view() {
  return {.name = "scene",
          .shows = "the scene in 3-D with returns, or as the head sees it",
          .options = {{"--scene", &ImageOptions::scene, "the run's scene, if it is not where run.toml says"},
                      {"--sonar", &ImageOptions::sonar, "to inspect a scene: preset, .toml file, or run.toml of a run"},
                      {"--pose", &ImageOptions::pose, "to inspect a scene: x,y,z,yaw,pitch,roll [m, deg]"},
                      {"--range", &ImageOptions::range,
                       "to inspect a scene: MIN:MAX [m]; default: to the end of the scene"},
                      {"--world", &ImageOptions::world, "z-up or ned", {.words = {"z-up", "ned"}}},
                      {"--camera",
                       &ImageOptions::camera,
                       "auto, behind (the head), top, side or iso",
                       {.words = words_of(camera_words)}},
                      {"--normals", &ImageOptions::normals, "draw some 4000 normals as lines"},
                      {"--colour",
                       &ImageOptions::colour,
                       "height, material, part, visibility, level, grazing or incidence; default: what suits",
                       {.words = words_of(colour_words)}}},
          .draw_alone = draw_scene};
}

}  // namespace insonify::tool

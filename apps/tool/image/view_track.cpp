// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/path_status.hpp"
#include "scene_io/bed_of_returns.hpp"
#include "store/survey_run.hpp"
#include "tool/command/progress.hpp"
#include "tool/image/image.hpp"
#include "view/save_vtk.hpp"
#include "view/show_track.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

TrackMap::HeadTrack head_track_of(const std::string& name, const std::vector<TrackPoint>& track) {
  TrackMap::HeadTrack head_track{name, {}, {}};
  for (const TrackPoint& point : track) {
    head_track.positions.emplace_back(point.world_from_head.translation().head<2>());
    head_track.ahead.emplace_back(point.world_from_head.linear().col(0).head<2>());
  }
  return head_track;
}

/// The mosaic, or the returns; nothing if there are none.
void add_levels(const fs::path& folder, TrackMap& map) {
  const std::string mosaic = (folder / "mosaic.vti").string(), returns = (folder / "returns.ply").string();
  if (path_exists(mosaic)) {
    const HorizontalMap laid = load_map_image(mosaic);
    map.x = laid.x, map.y = laid.y, map.cell = laid.cell;
    map.level_db = laid.fields.front().values;
    map.unit = "dB re 1 m² per m²";
  } else if (path_exists(returns)) {
    constexpr int cells = 400;
    ReturnsMap of_returns = map_of_returns(returns, cells);
    map.x = of_returns.x, map.y = of_returns.y, map.cell = of_returns.cell;
    map.level_db = std::move(of_returns.level_db);
    map.unit = "dB re 1 µPa, range compensated";
  }
}

/// Draws the ways of the heads of a merged survey from above, over its mosaic if there is one, else over its returns.
/// Throws Error(file) if the run is no survey, Error(content) if it is not merged.
void draw_track(const ImageOptions& o) {
  const SurveyRun run = load_survey_run(o.run);
  TrackMap map;
  std::size_t pings = 0;
  for (const SurveyRunHead& head : run.heads) {
    const fs::path cube = fs::path(o.run) / head.name / "cube.h5";
    if (!path_exists(cube))
      fail(ErrorKind::content, o.run, ": holds no ", head.name, "/cube.h5; run insonify merge ", o.run);
    map.tracks.push_back(head_track_of(head.name, read_track(cube.string())));
    pings += map.tracks.back().positions.size();
  }
  add_levels(o.run, map);
  PictureOptions picture = o.picture;
  if (picture.title.empty())
    picture.title = fmt::format("{} pings of {}", pings, shortened_list(run.heads, ", ", &SurveyRunHead::name));
  show_track(map, picture, o.output);
  print_summary(o.common, {{"output", o.output}, {"view", o.view}}, o.output);
}

}  // namespace

ViewSpec track_view() {
  return {.name = "track",
          .shows = "a merged survey from above: ways, and mosaic or returns",
          .of_survey = true,
          .draw_alone = draw_track};
}

}  // namespace insonify::tool

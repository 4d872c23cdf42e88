// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <vtkCamera.h>

#include "returns/sounding_columns.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/ping_record.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_scene_panel_internal.hpp"

namespace insonify {
namespace {

// Returns the returns as a scene, for runs whose scene is missing.
SceneCloud scene_of_returns(const Soundings& returns) {
  SceneCloud scene;
  scene.origin = returns.position.front().array().round();
  scene.normals_oriented = false;
  for (const Eigen::Vector3d& p : returns.position) add_surfel(scene, p, Eigen::Vector3d::UnitZ(), 0.01);
  return scene;
}

// Selects the returns of one ping, range compensated (E20). Pings are matched by number, or, if none matches, by index.
Soundings returns_of(const ViewerData& data, std::size_t ping) {
  const Soundings all = data.pings.has_returns() ? data.pings.returns(ping) : data.returns;
  const TrackPoint& position = data.pings.position(ping);
  const bool by_number = std::count(all.ping.begin(), all.ping.end(), position.number) > 0;
  return soundings_of_ping(all, by_number ? position.number : static_cast<std::int64_t>(ping),
                           Tvg{40, position.absorption_db_per_m});
}

// Returns the returns of a ping, range compensated (E20).
Soundings with_tvg(const Soundings& returns, const TrackPoint& ping) {
  return soundings_of_ping(returns, ping.number, Tvg{40, ping.absorption_db_per_m});
}

// Returns the returns of a ping, or, if the state accumulates them, of all pings up to it, of other heads, too: of each
// head at most so many back.
Soundings returns_shown(const ViewerData& data, const ViewerState& state) {
  constexpr std::size_t most_pings = 2000;
  if (!state.accumulate) return returns_of(data, state.ping);
  Soundings all;
  for (std::size_t ping = state.ping - std::min(state.ping, most_pings - 1); ping <= state.ping; ++ping) {
    const Soundings more = returns_of(data, ping);
    for (std::size_t i = 0; i < more.size(); ++i) append_row(all, more, i);
  }
  for (const LazyPings& other : data.others) {
    const std::vector<TrackPoint>& sent = other.positions();
    const auto end = std::upper_bound(sent.begin(), sent.end(), data.pings.position(state.ping).time,
                                      [](double time, const TrackPoint& ping) { return time < ping.time; });
    for (auto ping = end - std::min<std::ptrdiff_t>(end - sent.begin(), most_pings); ping < end; ++ping) {
      const Soundings more = with_tvg(other.returns(static_cast<std::size_t>(ping - sent.begin())), *ping);
      for (std::size_t i = 0; i < more.size(); ++i) append_row(all, more, i);
    }
  }
  return all;
}

// Words for colours, in the order of SceneColour.
constexpr const char* colour_texts[] = {"height",        "material",          "part", "visibility", "level",
                                        "grazing angle", "angle of incidence"};
static_assert(std::size(colour_texts) == static_cast<std::size_t>(SceneColour::incidence) + 1);

// Draws a square of each colour and its name from the top left corner downwards. Returns their end.
double draw_legend(Canvas& canvas, const std::vector<LegendEntry>& legend, double left, double right, double top,
                   int font) {
  const double row = 1.5 * font;
  double middle = top - row / 2;
  for (const LegendEntry& entry : legend) {
    canvas.add_lines({{{left, middle}, {left + font, middle}}}, font, shares_of(entry.colour), 1);
    canvas.add_text_from({left + 1.6 * font, middle}, entry.text, font, right - left - 1.6 * font);
    middle -= row;
  }
  return middle + row / 2;
}

}  // namespace

ViewerScene::ViewerScene(const ViewerData& data, ViewerPanel& panel, const ViewerState& state,
                         const PictureOptions& options)
    : data_(data), panel_(panel), own_(!has_scene(data)), options_(options), drawn_(state) {
  scene_ = own_ ? std::make_shared<const SceneCloud>(scene_of_returns(data.returns)) : scene_at(data, state.ping);
  SceneLook look;
  look.colour = SceneColour::height;
  look.axes = state.show_grid;
  look.point_size = state.point_size;
  look.head = head_of(state);
  look.level_unit = level_unit(Tvg{});
  for (const TrackPoint& position : data.pings.positions())
    look.track.emplace_back(position.world_from_head.translation());
  if (!data.pings.empty()) look.soundings = returns_shown(data, state);
  options_.colour_map = state.colour_map;
  actors_ = std::make_unique<SceneActors>(shown(), look, options_, viewer_caller);
  drawn_.scene_colour = look.colour;
  panel.content->SetBackground(theme(options.dark).background.data());
  actors_->add_to(panel.content);
  reset_camera();
}

// Draws the scene of another ping, if its parts stand elsewhere, in the same look and from the same viewpoint.
void ViewerScene::change_scene(const ViewerState& state) {
  std::shared_ptr<const SceneCloud> next = scene_at(data_, state.ping);
  if (own_ || next == scene_) return;
  SceneLook look = actors_->look();
  look.highlighted.clear(), look.visibility.clear(), look.holes.clear();
  if (look.colour == SceneColour::visibility) look.colour = SceneColour::height;
  look.point_size = state.point_size, look.axes = state.show_grid;
  options_.colour_map = state.colour_map;
  actors_->remove_from(panel_.content);
  const Eigen::Vector3d by = scene_->origin - next->origin;
  actors_.reset();
  scene_ = std::move(next);
  actors_ = std::make_unique<SceneActors>(shown(), look, options_, viewer_caller);
  actors_->add_to(panel_.content);
  move_camera(by);
}

void ViewerScene::move_camera(const Eigen::Vector3d& by) {
  vtkCamera* camera = panel_.content->GetActiveCamera();
  Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3d>(camera->GetPosition()) + by;
  Eigen::Vector3d focus = Eigen::Map<const Eigen::Vector3d>(camera->GetFocalPoint()) + by;
  camera->SetPosition(position.data());
  camera->SetFocalPoint(focus.data());
}

SceneHead ViewerScene::head_of(const ViewerState& state) const {
  if (state.mode == ViewerMode::inspect) return {pose_of(state.head), data_.fan, data_.gate};
  return {data_.pings.position(state.ping).world_from_head, data_.pings.fan(), data_.pings.gate()};
}

void ViewerScene::follow_head(const ViewerState& state) {
  move_camera(head_of(state).world_from_head.translation() - head_of(drawn_).world_from_head.translation());
}

void ViewerScene::update(const ViewerState& state, const HeadView* view, double max_db) {
  const SceneHead head = head_of(state);
  if (state.follow && state.ping != drawn_.ping) follow_head(state);
  if (state.mode == ViewerMode::run && state.ping != drawn_.ping) change_scene(state);
  if (state.mode == ViewerMode::inspect || state.ping != drawn_.ping) {
    actors_->show_head(head.world_from_head, head.fan, head.gate);
    has_visibility_ = false;
  }
  if (state.mode == ViewerMode::run && (state.ping != drawn_.ping || state.accumulate != drawn_.accumulate))
    actors_->show_soundings(returns_shown(data_, state));
  if (view && !own_ && !has_visibility_) {
    actors_->set_visibility(view->visibility);
    actors_->show_holes(view->holes);
    has_visibility_ = true;
  }
  const SceneColour colour =
      state.scene_colour == SceneColour::visibility && !has_visibility_ ? SceneColour::height : state.scene_colour;
  if (colour != actors_->look().colour) actors_->set_colour(colour);
  if (state.point_size != drawn_.point_size) actors_->set_point_size(state.point_size);
  if (state.show_grid != drawn_.show_grid) actors_->show_axes(state.show_grid);
  if (state.show_normals != drawn_.show_normals && !own_) actors_->show_normals(state.show_normals);
  if (state.colour_map != drawn_.colour_map) actors_->set_colour_map(state.colour_map);
  if (state.mode == ViewerMode::run) actors_->set_level_range(max_db - state.window_db, max_db);
  drawn_ = state;
}

void ViewerScene::highlight(const std::vector<std::uint32_t>& surfels) {
  std::vector<std::uint32_t> known;
  if (!own_)
    std::copy_if(surfels.begin(), surfels.end(), std::back_inserter(known),
                 [&](std::uint32_t i) { return i < shown().size(); });
  actors_->highlight(known);
}

void ViewerScene::draw_key(const PictureOptions& options, double scene_width, const ViewerState& state) {
  Canvas canvas = fresh_canvas(panel_.marks, options, false);
  const int font = options.font_size;
  const bool has_returns = data_.returns.size() > 0 || data_.pings.has_returns();
  const bool by_depth = actors_->look().colour == SceneColour::height && !data_.depth_datum.empty();
  PictureOptions titled = options;
  titled.title = std::string(own_ ? "Returns (scene missing)" : "Scene") + " by " +
                 (by_depth ? "depth" : colour_texts[static_cast<std::size_t>(actors_->look().colour)]) +
                 (has_returns && !own_ ? ", returns by level" : "");
  auto title = put_title(titled);
  if (title) title->on_plate = true;
  if (scene_width < options.width)
    canvas.add_plate({scene_width, 1.0 * options.width, 0, 1.0 * options.height}, canvas.colours().background, 1);
  if (title) canvas.add_text(*title);
  if (!state.show_colour_bars) return;

  // Draw from the top: the legend with everything besides the surfels, then the colour bars.
  const SceneKey& key = actors_->key();
  std::vector<LegendEntry> legend = key.legend;
  for (const LegendEntry& entry : actors_->line_key()) legend.push_back(entry);
  const double left = scene_width + 0.8 * font, top = (title ? title->box().bottom : options.height) - font;
  const double below = draw_legend(canvas, legend, left, options.width - 0.4 * font, top, font) - font;
  const double thin = line_width_for(font);
  std::vector<SceneKey> bars;
  if (const auto soundings = actors_->soundings_key(); soundings && soundings->scale) bars.push_back(*soundings);
  if (key.scale) bars.push_back(key);
  if (by_depth) bars.back().unit = "Depth " + data_.depth_datum + " [m]";
  const double bottom = 0.03 * options.height, right = options.width - 0.4 * font;
  for (std::size_t k = 0; k < bars.size(); ++k) {  // one above the other
    const double high = (below - bottom) / static_cast<double>(bars.size());
    const double top_of_bar = below - static_cast<double>(k) * high;
    ColourBar bar = upright_colour_bar(*bars[k].scale, bars[k].unit, font, right, top_of_bar - high + font, top_of_bar);
    if (by_depth && k + 1 == bars.size()) label_by_depths(bar);
    canvas.add_colour_bar(bar, *bars[k].scale, thin);
  }
}

void ViewerScene::reset_camera() {
  actors_->place_camera(panel_.content, ScenePreset::automatic);
  follow_camera();
}

void ViewerScene::set_moving(bool moving) { actors_->set_detail(moving ? SceneDetail::moving : SceneDetail::still); }

void ViewerScene::follow_camera() {
  panel_.content->ResetCameraClippingRange();
  actors_->update_axes(panel_.content);
}

Point2 ViewerScene::pixel_of(const Eigen::Vector3d& world) const {
  const Eigen::Vector3d p = world - shown().origin;
  panel_.content->SetWorldPoint(p.x(), p.y(), p.z(), 1);
  panel_.content->WorldToDisplay();
  const double* at = panel_.content->GetDisplayPoint();
  return {at[0], at[1]};
}

std::optional<std::uint32_t> ViewerScene::surfel_at(Point2 position) const {
  if (own_) return {};
  return actors_->surfel_at(panel_.content, position.x, position.y);
}

std::optional<Eigen::Vector3d> ViewerScene::world_at(Point2 position) const {
  const auto surfel = actors_->surfel_at(panel_.content, position.x, position.y);
  if (!surfel) return {};
  return shown().origin + shown().point[*surfel].cast<double>();
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
// Draws a ViewerWindow's state, restricted to what has changed.

#include <algorithm>

#include "view/axes_internal.hpp"
#include "view/drawing_internal.hpp"
#include "view/off_screen_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace insonify {
namespace {

constexpr double slider_rows = 13;  // lines of text that the sliders occupy

bool same_colours(const ViewerState& a, const ViewerState& b) {
  return a.tvg == b.tvg && a.gain_db == b.gain_db && a.window_db == b.window_db && a.colour_map == b.colour_map;
}

}  // namespace

PictureOptions ViewerWindow::options_for(const Box& box) const {
  PictureOptions options = panel_options(box, layout_.font_size);
  options.colour_map = state_.colour_map;
  options.window_db = state_.window_db;
  if (state_.mode == ViewerMode::run) {
    options.max_db = max_db_[state_.tvg ? 1 : 0] - state_.gain_db;
    options.min_db = options.max_db - state_.window_db;
  }
  return options;
}

// Returns the sample whose beam and range the charts show: the selected one, otherwise the strongest of the middle
// beam.
PixelPosition ViewerWindow::shown_position() const {
  if (state_.selected) return *state_.selected;
  PixelPosition position{middle_beam(image_->fan), 0};
  Eigen::Index bin = 0;
  image_->level_db.row(static_cast<Eigen::Index>(position.beam)).maxCoeff(&bin);
  position.bin = static_cast<std::size_t>(bin);
  return position;
}

// Updates the data selected by the state where it has changed.
void ViewerWindow::update_data() {
  if (state_.mode == ViewerMode::inspect) {
    if (!head_view_ || !drawn_ || drawn_->head != state_.head)
      head_view_ = look_from(data_.scene, view_at(data_, pose_of(state_.head), data_.fan, data_.gate));
    explanation_ = explain_view(*head_view_, state_);
    if (state_.surfel)
      explanation_ = explain_surfel(data_.scene, *head_view_, state_.head, *state_.surfel) + "\n" + explanation_;
    return;
  }
  const bool new_ping = !drawn_ || drawn_->ping != state_.ping;
  if (!image_ || new_ping || drawn_->tvg != state_.tvg) image_ = levels_of(data_, state_.ping, state_.tvg);
  if (new_ping) head_view_.reset();
  if (state_.scene_colour == SceneColour::visibility && !head_view_ && has_scene(data_))
    head_view_ = look_from(
        *scene_at(data_, state_.ping),
        view_at(data_, data_.pings.position(state_.ping).world_from_head, data_.pings.fan(), data_.pings.gate()));
  if (!new_ping && drawn_->selected == state_.selected) return;
  facts_.reset();
  explanation_.clear();
  if (!state_.selected) return;
  facts_ = find_pixel_facts(data_, state_.ping, *state_.selected);
  explanation_ = explain_pixel(*facts_);
}

const ViewerWindow::Panel ViewerWindow::panels_[] = {{&ViewerWindow::draw_picture, &ViewerWindow::click_fan},
                                                     {&ViewerWindow::draw_scene, &ViewerWindow::click_scene},
                                                     {&ViewerWindow::draw_beam, &ViewerWindow::click_ascan},
                                                     {&ViewerWindow::draw_history, &ViewerWindow::click_history},
                                                     {&ViewerWindow::draw_facts},
                                                     {&ViewerWindow::draw_timeline},
                                                     {&ViewerWindow::draw_status}};

void ViewerWindow::draw() {
  if (drawn_ && drawn_->show_colour_bars != state_.show_colour_bars) lay_out();
  buttons_.clear();
  update_data();
  for (const ViewerPanelBox& position : viewer_panels)
    if (const Box& box = layout_.*position.box; box.width() > 0 && box.height() > 0)
      (this->*panels_[static_cast<std::size_t>(position.value)].draw)(panel(position.value), options_for(box));
  draw_over();
  if (sliders_) sliders_->set(state_.gain_db, state_.window_db, static_cast<double>(state_.ping));
  drawn_ = state_;
  window_->Render();
}

// Returns true if the panels show the levels of this ping in these colours already.
bool ViewerWindow::levels_stay() const {
  return drawn_ && drawn_->ping == state_.ping && same_colours(*drawn_, state_);
}

// Draws the first panel: fan or sweep of the ping, or the page of the waterfall that shows it.
void ViewerWindow::draw_picture(ViewerPanel& panel, const PictureOptions& requested) {
  PictureOptions options = requested;
  options.title = data_.title;
  if (is_waterfall()) {
    const PageOfPings page = page_of(data_.pings, state_.ping);
    const bool stays = drawn_ && same_colours(*drawn_, state_) && page.first == picture_page_.first;
    turn_page(picture_page_, data_.pings, page.first, page.count, 0);
    if (!stays) {
      Canvas canvas = fresh_canvas(panel.content, options, drawn_.has_value());
      picture_axes_ = draw_waterfall(canvas, shown_history(), options);
    }
  } else if (!levels_stay()) {
    if (extent_.pings > 1) options.title += ", ping " + std::to_string(data_.pings.position(state_.ping).number);
    if (picture_ == ViewerPicture::sweep) sweep_ = sweep_at(data_, state_.ping, state_.tvg, picture_page_);
    Canvas canvas = fresh_canvas(panel.content, options, drawn_.has_value());
    fan_layout_ = draw_fan(canvas, picture_ == ViewerPicture::sweep ? sweep_.image : *image_, options);
  }
  mark_picture(panel, requested);
}

// Returns the page of the waterfall; of a side-scan with port to the left of starboard.
PingHistory ViewerWindow::shown_history() {
  const PingHistory history = history_of(record_of(data_, picture_page_, state_.tvg));
  if (picture_ != ViewerPicture::sides) return history;
  BeamPage starboard;
  turn_page(starboard, data_.pings, picture_page_.first, picture_page_.count, 1);
  return side_by_side(history, history_of(record_of(data_, starboard, state_.tvg)));
}

void ViewerWindow::mark_picture(ViewerPanel& panel, const PictureOptions& options) {
  std::optional<double> range;
  if (state_.selected) range = image_->gate.centre(state_.selected->bin);
  if (picture_ == ViewerPicture::sides && state_.selected && state_.selected->beam == 0) range = -*range;
  if (is_waterfall())
    return mark_waterfall(panel, picture_axes_, static_cast<double>(state_.ping - picture_page_.first), range, options,
                          true);
  FanMarks marks{{}, range, state_.measure};
  if (picture_ == ViewerPicture::sweep) marks.bearing = -image_->fan.azimuth[0];
  if (state_.selected) marks.bearing = -image_->fan.azimuth[state_.selected->beam];
  mark_fan(panel, fan_layout_, marks, options);
}

void ViewerWindow::draw_beam(ViewerPanel& panel, const PictureOptions& options) {
  const PixelPosition position = shown_position();
  if (!levels_stay() || drawn_->selected != state_.selected) {
    PictureOptions own = options;
    own.min_db = own.max_db = std::numeric_limits<double>::quiet_NaN();  // automatic limits for this beam
    Canvas canvas = fresh_canvas(panel.content, own, false);
    ascan_axes_ = draw_ascan(canvas, *image_, position.beam, own);
  }
  mark_ascan(panel, *image_, ascan_axes_, position, options);
}

// Draws one beam ping after ping with the row of the ping, or, for a single ping, the levels across its beams.
void ViewerWindow::draw_history(ViewerPanel& panel, const PictureOptions& requested) {
  PictureOptions options = requested;
  const PixelPosition position = shown_position();
  if (extent_.pings < 2) {
    if (levels_stay() && drawn_->selected == state_.selected) return;
    Canvas canvas = fresh_canvas(panel.content, options, false);
    draw_line_chart(canvas, bearing_chart(*image_, position, options), options);
    return;
  }
  const PageOfPings page = page_of(data_.pings, state_.ping);
  const bool stays = drawn_ && same_colours(*drawn_, state_) && page.first == history_page_.first &&
                     position.beam == history_page_.beam;
  turn_page(history_page_, data_.pings, page.first, page.count, position.beam);
  options.title =
      (data_.sides ? (position.beam == 0 ? "Port" : "Starboard") : "Beam " + std::to_string(position.beam)) +
      ", ping after ping";
  if (!stays) {
    Canvas canvas = fresh_canvas(panel.content, options, false);
    history_axes_ = draw_waterfall(canvas, history_of(record_of(data_, history_page_, state_.tvg)), options);
  }
  std::optional<double> range;
  if (state_.selected) range = image_->gate.centre(position.bin);
  mark_waterfall(panel, history_axes_, static_cast<double>(state_.ping - history_page_.first), range, options, false);
}

void ViewerWindow::draw_scene(ViewerPanel&, const PictureOptions& options) {
  if (!scene_) return;
  scene_->update(state_, head_view_ ? &*head_view_ : nullptr, max_db_[1] - state_.gain_db);
  if (facts_)
    scene_->highlight(surfels_behind(*facts_));
  else if (state_.surfel)
    scene_->highlight({*state_.surfel});
  else
    scene_->highlight({});
  scene_->draw_key(options, layout_.scene_view.width(), state_);
}

std::string ViewerWindow::status_text() const {
  if (!notice_.empty()) return notice_;
  if (state_.mode == ViewerMode::inspect)
    return pose_option(vehicle_position(data_, state_.head)) +
           "   p prints it   arrows, PageUp, PageDown move, with shift they turn   h help";
  const TrackPoint& position = data_.pings.position(state_.ping);
  std::string text = "ping " + std::to_string(state_.ping + 1) + " of " + std::to_string(extent_.pings);
  if (extent_.pings > 1) text += " at " + number_text(position.time, 0.01) + " s";
  if (position.scan) text += ", sweep " + std::to_string(position.scan->sweep);
  if (state_.playing) text += ", playing " + number_text(state_.pings_per_second, 0.01) + " pings a second";
  text += "   gain " + number_text(state_.gain_db, 1) + " dB   window " + number_text(state_.window_db, 1) + " dB";
  text += state_.tvg ? "   range compensated" : "   as received";
  text += "   " + state_.colour_map;
  if (state_.measure.active) text += "   measuring: click two places in the fan";
  return text + "   h help";
}

void ViewerWindow::draw_status(ViewerPanel& panel, const PictureOptions& options) {
  const double font = options.font_size;
  Canvas canvas = fresh_canvas(panel.content, options, false);
  add_text_lines(canvas, status_text(), {font, options.width - font, 0, options.height - 0.25 * font},
                 options.font_size);
}

// Draws an empty background for the slider.
void ViewerWindow::draw_timeline(ViewerPanel& panel, const PictureOptions& options) {
  fresh_canvas(panel.content, options, false);
}

// Draws help, or the borders of the panels, on top of everything.
void ViewerWindow::draw_over() {
  const Box whole{0, layout_.facts.right, 0, layout_.facts.top};
  Canvas canvas = fresh_canvas(over_.content, panel_options(whole, layout_.font_size), false);
  if (state_.show_help) {
    buttons_ = draw_help(canvas, state_.mode, whole, layout_.font_size);
    return;
  }
  for (const Box& box : {layout_.fan, layout_.scene, layout_.ascan, layout_.history, layout_.timeline, layout_.facts})
    if (box.width() > 0 && box.height() > 0)
      canvas.add_lines({{{box.left, box.top}, {box.left, box.bottom}, {box.right, box.bottom}}}, 1,
                       canvas.colours().line, 0.35);
}

// Draws the explanation, and below it a button for every key as far as there is room.
void ViewerWindow::draw_facts(ViewerPanel& panel, const PictureOptions& options) {
  const int font = layout_.font_size, small = std::max(9, (9 * font) / 10);
  Canvas facts = fresh_canvas(panel.content, options, false);
  const double below = sliders_ ? slider_rows * font : font, top = options.height - 0.8 * font;
  std::string words = explanation_;
  if (words.empty())
    words =
        "Click a sample in the picture,\na point in the 3-D panel, or a\nrange on the A-scan. Its\nexplanation appears "
        "here.";
  add_text_lines(facts, words, {font * 1.0, options.width - 0.5 * font, below, top}, font);

  const double lines = static_cast<double>(std::count(words.begin(), words.end(), '\n') + 2);
  const Box room{font * 1.0, options.width - 0.5 * font, below, top - 1.45 * font * lines};
  if (room.height() < 3.0 * font) return;
  for (PlacedButton& button : draw_key_rows(facts, viewer_keys(state_.mode), room, small, false)) {
    button.box.left += layout_.facts.left, button.box.right += layout_.facts.left;
    button.box.bottom += layout_.facts.bottom, button.box.top += layout_.facts.bottom;
    buttons_.push_back(button);
  }
}

void ViewerWindow::save_png(const std::string& path) {
  drawn_.reset();
  draw();
  write_png(path, png_of_window(window_, messages_, viewer_caller));
}

}  // namespace insonify

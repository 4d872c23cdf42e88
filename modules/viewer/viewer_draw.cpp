// Drawing of a ViewerWindow's state, restricted to what has changed.

#include "view/axes_internal.hpp"
#include "view/off_screen_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace insonify {
namespace {

constexpr double slider_rows = 13;  // lines of text that the sliders occupy

bool same_levels(const ViewerState& a, const ViewerState& b) {
  return a.ping == b.ping && a.tvg == b.tvg && a.gain_db == b.gain_db && a.window_db == b.window_db &&
         a.colour_map == b.colour_map;
}

// Draws the table of keys on a plate in the middle.
void draw_help(Canvas& canvas, ViewerMode mode, const Box& room, int font) {
  const std::vector<ViewerKey> keys = viewer_keys(mode);
  const double row = 1.6 * font, height = row * static_cast<double>(keys.size() + 3), width = 46.0 * font;
  const double left = (room.width() - width) / 2, top = (room.height() + height) / 2;
  canvas.add_plate({left, left + width, top - height, top}, canvas.colours().background, 0.94);
  canvas.add_text({"Keys", {left + width / 2, top - row}, (5 * font) / 4});
  double middle = top - 2.5 * row;
  for (const ViewerKey& key : keys) {
    add_text_lines(canvas, key.keys, {left + 1.5 * font, left + 16 * font, middle - row, middle + 0.73 * font}, font);
    add_text_lines(canvas, key.action, {left + 16 * font, left + width - font, middle - row, middle + 0.73 * font},
                   font);
    middle -= row;
  }
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

// The sample whose beam and range the charts show: the selected one, else the strongest of the middle beam.
PixelPlace ViewerWindow::shown_place() const {
  if (state_.selected) return *state_.selected;
  PixelPlace place{extent_.beams / 2, 0};
  Eigen::Index bin = 0;
  image_->level_db.row(static_cast<Eigen::Index>(place.beam)).maxCoeff(&bin);
  place.bin = static_cast<std::size_t>(bin);
  return place;
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
  if (state_.scene_colour == SceneColour::visibility && !head_view_ && data_.scene.size() > 0)
    head_view_ =
        look_from(data_.scene, view_at(data_, data_.pings[state_.ping].world_from_head, image_->fan, image_->gate));
  if (!new_ping && drawn_->selected == state_.selected) return;
  facts_.reset();
  explanation_.clear();
  if (!state_.selected) return;
  facts_ = find_pixel_facts(data_, state_.ping, *state_.selected);
  explanation_ = explain_pixel(*facts_);
}

void ViewerWindow::draw() {
  update_data();
  if (state_.mode == ViewerMode::run) {
    if (!drawn_ || !same_levels(*drawn_, state_)) draw_levels(drawn_.has_value());
    draw_selection();
  }
  draw_scene();
  draw_words();
  if (sliders_) sliders_->set(state_.gain_db, state_.window_db);
  drawn_ = state_;
  window_->Render();
}

void ViewerWindow::draw_levels(bool keep_camera) {
  PictureOptions options = options_for(layout_.fan);
  options.title = data_.title + (extent_.pings > 1 ? ", ping " + std::to_string(data_.pings[state_.ping].number) : "");
  fan_layout_ = draw_fan_panel(fan_, *image_, options, keep_camera);
}

void ViewerWindow::draw_selection() {
  const bool levels_stay = drawn_ && same_levels(*drawn_, state_);
  mark_fan(fan_, *image_, fan_layout_, state_, options_for(layout_.fan));
  const PixelPlace place = shown_place();
  if (!levels_stay || drawn_->selected != state_.selected) {
    ascan_axes_ = draw_ascan_panel(ascan_, *image_, place.beam, options_for(layout_.ascan));
    draw_history_panel(history_, data_, *image_, place, state_.tvg, options_for(layout_.history));
  }
  mark_ascan(ascan_, *image_, ascan_axes_, place, options_for(layout_.ascan));
}

void ViewerWindow::draw_scene() {
  if (!scene_) return;
  scene_->update(state_, head_view_ ? &*head_view_ : nullptr, max_db_[1] - state_.gain_db);
  if (facts_)
    scene_->highlight(surfels_behind(*facts_));
  else if (state_.surfel)
    scene_->highlight({*state_.surfel});
  else
    scene_->highlight({});
  scene_->draw_key(options_for(layout_.scene), state_);
}

std::string ViewerWindow::status_text() const {
  if (!notice_.empty()) return notice_;
  if (state_.mode == ViewerMode::inspect)
    return pose_option(state_.head) + "   p prints it   arrows, PageUp, PageDown move, with shift they turn   h help";
  std::string text = "ping " + std::to_string(state_.ping + 1) + " of " + std::to_string(extent_.pings);
  if (state_.playing) text += ", playing " + number_text(state_.pings_per_second, 0.01) + " a second";
  text += "   gain " + number_text(state_.gain_db, 1) + " dB   window " + number_text(state_.window_db, 1) + " dB";
  text += state_.tvg ? "   range compensated" : "   as received";
  text += "   " + state_.colour_map;
  if (state_.measure.active) text += "   measuring: click two places in the fan";
  return text + "   h help";
}

void ViewerWindow::draw_words() {
  const int font = layout_.font_size;
  const PictureOptions facts_options = panel_options(layout_.facts, font);
  Canvas facts = fresh_canvas(facts_panel_.content, facts_options, false);
  const double below = sliders_ ? slider_rows * font : font;
  std::string words = explanation_;
  if (words.empty())
    words = "Click a sample in the fan,\na point in 3-D or a range\non the A-scan: it is\nexplained here.";
  add_text_lines(facts, words, {font * 1.0, facts_options.width - 0.5 * font, below, facts_options.height - 0.8 * font},
                 font);

  const PictureOptions status_options = panel_options(layout_.status, font);
  Canvas status = fresh_canvas(status_.content, status_options, false);
  add_text_lines(status, status_text(),
                 {font * 1.0, status_options.width - 1.0 * font, 0, status_options.height - 0.25 * font}, font);

  // On top of everything: help, or the borders of the panels.
  const Box whole{0, layout_.facts.right, 0, layout_.facts.top};
  Canvas over = fresh_canvas(help_.content, panel_options(whole, font), false);
  if (state_.show_help) return draw_help(over, state_.mode, whole, font);
  for (const Box& box : {layout_.fan, layout_.scene, layout_.ascan, layout_.history, layout_.facts})
    if (box.width() > 0)
      over.add_lines({{{box.left, box.top}, {box.left, box.bottom}, {box.right, box.bottom}}}, 1, over.colours().line,
                     0.35);
}

void ViewerWindow::save_png(const std::string& path) {
  drawn_.reset();
  draw();
  save_window(window_, path, messages_, viewer_caller);
}

}  // namespace insonify

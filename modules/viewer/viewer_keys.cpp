// SPDX-License-Identifier: BSD-3-Clause
// The table of keys: its help, its buttons, and the effect of each key.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/text.hpp"
#include "core/units.hpp"
#include "view/picture.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {
namespace {

using S = ViewerState;
using E = const ViewerExtent;

constexpr double gain_step = 2, window_step = 5, smallest_window = 5, largest_window = 150, largest_gain = 200;
constexpr double slowest = 0.25, fastest = 64;  // pings per second
constexpr double shortest_stride = 0.01, longest_stride = 50;
constexpr double turn_per_metre = radians(10);
constexpr double smallest_point = 0.25, largest_point = 16, point_step = 1.25;

std::size_t moved(std::size_t index, int by, std::size_t count) {
  if (count == 0) return 0;
  const auto last = static_cast<long long>(count) - 1;
  return static_cast<std::size_t>(std::clamp(static_cast<long long>(index) + by, 0LL, last));
}

std::string next_colour_map(const std::string& current) {
  const std::vector<std::string> names = colour_map_names();
  const auto at = std::find(names.begin(), names.end(), current);
  return at == names.end() || at + 1 == names.end() ? names.front() : *(at + 1);
}

void step(S& s, int by, E& extent) {
  s.playing = false;
  s.ping = moved(s.ping, by, extent.pings);
}

int tenth_of(E& extent) { return std::max(1, static_cast<int>(extent.pings / 10)); }

void select_next(S& s, int beams, int bins, E& extent) {
  if (extent.beams == 0 || extent.bins == 0) return;
  const PixelPosition from = s.selected.value_or(PixelPosition{extent.beams / 2, extent.bins / 2});
  s.selected = PixelPosition{moved(from.beam, beams, extent.beams), moved(from.bin, bins, extent.bins)};
}

// Moves the head horizontally along and across its heading, then up.
void move_head(S& state, double forward, double port, double up) {
  const double c = std::cos(state.head.yaw), s = std::sin(state.head.yaw);
  state.head.position += state.stride * Eigen::Vector3d(c * forward - s * port, s * forward + c * port, up);
}

void turn_head(S& state, double yaw, double pitch, double roll) {
  const double turn = turn_per_metre * state.stride;
  PoseAngles& head = state.head;
  head.yaw = std::remainder(head.yaw + turn * yaw, 2 * pi);
  head.pitch = std::clamp(head.pitch + turn * pitch, -pi / 2, pi / 2);
  head.roll = std::remainder(head.roll + turn * roll, 2 * pi);
}

using Request = ViewerRequest;
const auto stay = [](S&, E&) {};  // for a key that only asks the window

const std::vector<ViewerKey> keys_of_runs = {
    {"select a sample: fan, 3-D, A-scan or waterfall", {}, "click"},
    {"play, pause", {{"space", [](S& s, E& e) { s.playing = !s.playing && e.pings > 1; }}}},
    {"previous, next ping",
     {{"Left", [](S& s, E& e) { step(s, -1, e); }, {"comma"}},
      {"Right", [](S& s, E& e) { step(s, 1, e); }, {"period"}}}},
    {"back, forward by a tenth",
     {{"Prior", [](S& s, E& e) { step(s, -tenth_of(e), e); }}, {"Next", [](S& s, E& e) { step(s, tenth_of(e), e); }}}},
    {"first, last ping",
     {{"Home", [](S& s, E& e) { step(s, -static_cast<int>(e.pings), e); }},
      {"End", [](S& s, E& e) { step(s, static_cast<int>(e.pings), e); }}}},
    {"play slower, faster",
     {{"less", [](S& s, E&) { s.pings_per_second = std::max(slowest, s.pings_per_second / 2); }},
      {"greater", [](S& s, E&) { s.pings_per_second = std::min(fastest, s.pings_per_second * 2); }}}},
    {"gain: brighter, darker",
     {{"Up", [](S& s, E&) { s.gain_db = std::min(largest_gain, s.gain_db + gain_step); }},
      {"Down", [](S& s, E&) { s.gain_db = std::max(-largest_gain, s.gain_db - gain_step); }}}},
    {"dB window: narrower, wider",
     {{"bracketleft", [](S& s, E&) { s.window_db = std::max(smallest_window, s.window_db - window_step); }},
      {"bracketright", [](S& s, E&) { s.window_db = std::min(largest_window, s.window_db + window_step); }}}},
    {"range compensation (TVG)", {{"t", [](S& s, E&) { s.tvg = !s.tvg; }}}},
    {"next colour map", {{"m", [](S& s, E&) { s.colour_map = next_colour_map(s.colour_map); }}}},
    {"measure: two clicks in the fan",
     {{"d",
       [](S& s, E&) {
         s.measure = {!s.measure.active, {}};
       }}}},
    {"next beam",
     {{"shift+Left", [](S& s, E& e) { select_next(s, -1, 0, e); }},
      {"shift+Right", [](S& s, E& e) { select_next(s, 1, 0, e); }}}},
    {"next bin",
     {{"shift+Up", [](S& s, E& e) { select_next(s, 0, 1, e); }},
      {"shift+Down", [](S& s, E& e) { select_next(s, 0, -1, e); }}}},
    {"clear selection and measure", {{"Escape", [](S& s, E&) { s.selected.reset(), s.measure = {}; }}}},
    {"3-D: returns of all pings so far", {{"a", [](S& s, E&) { s.accumulate = !s.accumulate; }}}},
    {"3-D follows the head", {{"f", [](S& s, E&) { s.follow = !s.follow; }}}}};

const std::vector<ViewerKey> keys_to_inspect = {
    {"move the head: forward, back",
     {{"Up", [](S& s, E&) { move_head(s, 1, 0, 0); }}, {"Down", [](S& s, E&) { move_head(s, -1, 0, 0); }}}},
    {"move it to port, starboard",
     {{"Left", [](S& s, E&) { move_head(s, 0, 1, 0); }}, {"Right", [](S& s, E&) { move_head(s, 0, -1, 0); }}}},
    {"move it up, down",
     {{"Prior", [](S& s, E&) { move_head(s, 0, 0, 1); }}, {"Next", [](S& s, E&) { move_head(s, 0, 0, -1); }}}},
    {"turn it: yaw",
     {{"shift+Left", [](S& s, E&) { turn_head(s, 1, 0, 0); }},
      {"shift+Right", [](S& s, E&) { turn_head(s, -1, 0, 0); }}}},
    {"nose up, nose down",
     {{"shift+Up", [](S& s, E&) { turn_head(s, 0, -1, 0); }}, {"shift+Down", [](S& s, E&) { turn_head(s, 0, 1, 0); }}}},
    {"roll it",
     {{"shift+Prior", [](S& s, E&) { turn_head(s, 0, 0, 1); }},
      {"shift+Next", [](S& s, E&) { turn_head(s, 0, 0, -1); }}}},
    {"shorter, longer steps",
     {{"comma", [](S& s, E&) { s.stride = std::max(shortest_stride, s.stride / 2); }},
      {"period", [](S& s, E&) { s.stride = std::min(longest_stride, s.stride * 2); }}}},
    {"print the pose as option --pose", {{"p", stay, {}, Request::print_pose}}}};

const std::vector<ViewerKey> keys_of_both = {
    {"colour: height, material, visibility",
     {{"1", [](S& s, E&) { s.scene_colour = SceneColour::height; }},
      {"2", [](S& s, E&) { s.scene_colour = SceneColour::material; }},
      {"3", [](S& s, E&) { s.scene_colour = SceneColour::visibility; }}}},
    {"colour: grazing, incidence, part",
     {{"4", [](S& s, E&) { s.scene_colour = SceneColour::grazing; }},
      {"5", [](S& s, E&) { s.scene_colour = SceneColour::incidence; }},
      {"6", [](S& s, E&) { s.scene_colour = SceneColour::part; }}}},
    {"point size",
     {{"plus",
       [](S& s, E&) { s.point_size = std::min(largest_point, s.point_size * point_step); },
       {"KP_Add", "equal"}},
      {"minus",
       [](S& s, E&) { s.point_size = std::max(smallest_point, s.point_size / point_step); },
       {"KP_Subtract"}}}},
    {"axes of the 3-D panel", {{"g", [](S& s, E&) { s.show_grid = !s.show_grid; }}}},
    {"normals of the scene", {{"n", [](S& s, E&) { s.show_normals = !s.show_normals; }}}},
    {"colour bars", {{"u", [](S& s, E&) { s.show_colour_bars = !s.show_colour_bars; }}}},
    {"reset the cameras", {{"r", stay, {}, Request::reset_cameras}}},
    {"screenshot", {{"j", stay, {}, Request::screenshot}}},
    {"this help", {{"h", [](S& s, E&) { s.show_help = !s.show_help; }}}},
    {"quit", {{"q", stay, {"e"}, Request::quit}}},
    {"3-D: turn, zoom; fan: pan, zoom", {}, "drag, wheel"}};

}  // namespace

std::vector<ViewerKey> viewer_keys(ViewerMode mode) {
  std::vector<ViewerKey> keys = mode == ViewerMode::run ? keys_of_runs : keys_to_inspect;
  keys.insert(keys.end(), keys_of_both.begin(), keys_of_both.end());
  return keys;
}

std::string key_label(const std::string& key) {
  static const std::map<std::string, std::string> labels = {{"Left", "left"},
                                                            {"Right", "right"},
                                                            {"Up", "up"},
                                                            {"Down", "down"},
                                                            {"Prior", "PageUp"},
                                                            {"Next", "PageDown"},
                                                            {"shift+Prior", "shift+PgUp"},
                                                            {"shift+Next", "shift+PgDn"},
                                                            {"less", "<"},
                                                            {"greater", ">"},
                                                            {"bracketleft", "["},
                                                            {"bracketright", "]"},
                                                            {"comma", ","},
                                                            {"period", "."},
                                                            {"plus", "+"},
                                                            {"KP_Add", "+"},
                                                            {"equal", "="},
                                                            {"minus", "-"},
                                                            {"KP_Subtract", "-"}};
  if (const auto found = labels.find(key); found != labels.end()) return found->second;
  return key.starts_with("shift+") ? "shift+" + key_label(key.substr(6)) : key;
}

std::string viewer_help(ViewerMode mode) {
  std::string text;
  for (const ViewerKey& row : viewer_keys(mode)) {
    std::vector<std::string> first, others;
    for (const ViewerButton& button : row.buttons) {
      first.push_back(key_label(button.key));
      for (const std::string& other : button.also) others.push_back(key_label(other));
    }
    std::erase_if(others, [&](const std::string& other) { return std::count(first.begin(), first.end(), other) > 0; });
    first.insert(first.end(), others.begin(), others.end());
    std::string keys = row.mouse + joined(first, " ");
    keys.resize(std::max<std::size_t>(keys.size() + 1, 25), ' ');
    text += "  " + keys + row.action + "\n";
  }
  return text;
}

KeyAnswer apply_key(ViewerState state, const std::string& key, const ViewerExtent& extent) {
  KeyAnswer answer{std::move(state)};
  if (key == "Escape") answer.state.show_help = false;  // in either mode
  for (const ViewerKey& row : viewer_keys(answer.state.mode))
    for (const ViewerButton& button : row.buttons) {
      if (button.key != key && std::count(button.also.begin(), button.also.end(), key) == 0) continue;
      button.press(answer.state, extent);
      answer.request = button.request;
    }
  return answer;
}

}  // namespace insonify

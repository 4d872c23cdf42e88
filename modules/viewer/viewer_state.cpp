#include "viewer/viewer_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "core/units.hpp"
#include "view/picture.hpp"

namespace insonify {
namespace {

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

void step_ping(ViewerState& state, int by, const ViewerExtent& extent) {
  state.playing = false;
  state.ping = moved(state.ping, by, extent.pings);
}

void step_selection(ViewerState& state, int beams, int bins, const ViewerExtent& extent) {
  if (extent.beams == 0 || extent.bins == 0) return;
  const PixelPlace from = state.selected.value_or(PixelPlace{extent.beams / 2, extent.bins / 2});
  state.selected = PixelPlace{moved(from.beam, beams, extent.beams), moved(from.bin, bins, extent.bins)};
}

// Moves the head horizontally along and across its heading, then up.
void move_head(ViewerState& state, double forward, double port, double up) {
  const double c = std::cos(state.head.yaw), s = std::sin(state.head.yaw);
  state.head.position += state.stride * Eigen::Vector3d(c * forward - s * port, s * forward + c * port, up);
}

void turn_head(ViewerState& state, double yaw, double pitch, double roll) {
  const double turn = turn_per_metre * state.stride;
  HeadPlace& head = state.head;
  head.yaw = std::remainder(head.yaw + turn * yaw, 2 * pi);
  head.pitch = std::clamp(head.pitch + turn * pitch, -pi / 2, pi / 2);
  head.roll = std::remainder(head.roll + turn * roll, 2 * pi);
}

std::optional<SceneColour> colour_of_digit(const std::string& key) {
  constexpr SceneColour colours[] = {SceneColour::height, SceneColour::material, SceneColour::visibility,
                                     SceneColour::grazing, SceneColour::incidence};
  if (key.size() != 1 || key[0] < '1' || key[0] > '5') return {};
  return colours[key[0] - '1'];
}

// Applies keys that have the same meaning in both modes.
void apply_common_key(KeyAnswer& answer, const std::string& key) {
  ViewerState& s = answer.state;
  if (key == "q" || key == "e") answer.request = ViewerRequest::quit;
  if (key == "j") answer.request = ViewerRequest::screenshot;
  if (key == "r") answer.request = ViewerRequest::reset_cameras;
  if (key == "h") s.show_help = !s.show_help;
  if (key == "u") s.show_colour_bars = !s.show_colour_bars;
  if (key == "g") s.show_grid = !s.show_grid;
  if (key == "n") s.show_normals = !s.show_normals;
  if (key == "plus" || key == "KP_Add" || key == "equal")
    s.point_size = std::min(largest_point, s.point_size * point_step);
  if (key == "minus" || key == "KP_Subtract") s.point_size = std::max(smallest_point, s.point_size / point_step);
  if (const auto colour = colour_of_digit(key)) s.scene_colour = *colour;
}

// Of a run.
void apply_run_key(ViewerState& s, const std::string& key, const ViewerExtent& extent) {
  if (key == "Left" || key == "comma") step_ping(s, -1, extent);
  if (key == "Right" || key == "period") step_ping(s, 1, extent);
  if (key == "Home") step_ping(s, -static_cast<int>(extent.pings), extent);
  if (key == "End") step_ping(s, static_cast<int>(extent.pings), extent);
  const int tenth = std::max(1, static_cast<int>(extent.pings / 10));
  if (key == "Prior") step_ping(s, -tenth, extent);
  if (key == "Next") step_ping(s, tenth, extent);
  if (key == "f") s.follow = !s.follow;
  if (key == "space") s.playing = !s.playing && extent.pings > 1;
  if (key == "less") s.pings_per_second = std::max(slowest, s.pings_per_second / 2);
  if (key == "greater") s.pings_per_second = std::min(fastest, s.pings_per_second * 2);
  if (key == "Up") s.gain_db = std::min(largest_gain, s.gain_db + gain_step);
  if (key == "Down") s.gain_db = std::max(-largest_gain, s.gain_db - gain_step);
  if (key == "bracketleft") s.window_db = std::max(smallest_window, s.window_db - window_step);
  if (key == "bracketright") s.window_db = std::min(largest_window, s.window_db + window_step);
  if (key == "t") s.tvg = !s.tvg;
  if (key == "m") s.colour_map = next_colour_map(s.colour_map);
  if (key == "d") s.measure = {!s.measure.active, {}};
  if (key == "shift+Left") step_selection(s, -1, 0, extent);
  if (key == "shift+Right") step_selection(s, 1, 0, extent);
  if (key == "shift+Up") step_selection(s, 0, 1, extent);
  if (key == "shift+Down") step_selection(s, 0, -1, extent);
  if (key == "Escape") s.selected.reset(), s.measure = {}, s.show_help = false;
}

void apply_inspect_key(KeyAnswer& answer, const std::string& key) {
  ViewerState& s = answer.state;
  if (key == "Up") move_head(s, 1, 0, 0);
  if (key == "Down") move_head(s, -1, 0, 0);
  if (key == "Left") move_head(s, 0, 1, 0);
  if (key == "Right") move_head(s, 0, -1, 0);
  if (key == "Prior") move_head(s, 0, 0, 1);
  if (key == "Next") move_head(s, 0, 0, -1);
  if (key == "shift+Left") turn_head(s, 1, 0, 0);
  if (key == "shift+Right") turn_head(s, -1, 0, 0);
  if (key == "shift+Up") turn_head(s, 0, -1, 0);
  if (key == "shift+Down") turn_head(s, 0, 1, 0);
  if (key == "shift+Prior") turn_head(s, 0, 0, 1);
  if (key == "shift+Next") turn_head(s, 0, 0, -1);
  if (key == "comma") s.stride = std::max(shortest_stride, s.stride / 2);
  if (key == "period") s.stride = std::min(longest_stride, s.stride * 2);
  if (key == "p") answer.request = ViewerRequest::print_pose;
  if (key == "Escape") s.show_help = false;
}

// A number without trailing zeros, never "-0".
std::string short_number(double value) {
  std::string number = printed("%.3f", std::abs(value) < 5e-4 ? 0.0 : value);
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number;
}

}  // namespace

std::string pose_option(const HeadPlace& head) {
  std::string text = "--pose=";
  for (const double metres : {head.position.x(), head.position.y(), head.position.z()})
    text += short_number(metres) + ",";
  return text + short_number(degrees(head.yaw)) + "," + short_number(degrees(head.pitch)) + "," +
         short_number(degrees(head.roll));
}

std::vector<ViewerKey> viewer_keys(ViewerMode mode) {
  const std::vector<ViewerKey> run = {
      {"click", "select a sample: fan, 3-D, A-scan or waterfall"},
      {"space", "play, pause", {{"space", "space"}}},
      {"left right  , .", "previous, next ping", {{"left", "Left"}, {"right", "Right"}}},
      {"PageUp PageDown", "back, forward by a tenth", {{"PageUp", "Prior"}, {"PageDown", "Next"}}},
      {"Home End", "first, last ping", {{"Home", "Home"}, {"End", "End"}}},
      {"< >", "play slower, faster", {{"<", "less"}, {">", "greater"}}},
      {"up down", "gain: brighter, darker", {{"up", "Up"}, {"down", "Down"}}},
      {"[ ]", "dB window: narrower, wider", {{"[", "bracketleft"}, {"]", "bracketright"}}},
      {"t", "range compensation (TVG)", {{"t", "t"}}},
      {"m", "next colour map", {{"m", "m"}}},
      {"d", "measure: two clicks in the fan", {{"d", "d"}}},
      {"shift + left right", "next beam", {{"shift+left", "shift+Left"}, {"shift+right", "shift+Right"}}},
      {"shift + up down", "next bin", {{"shift+up", "shift+Up"}, {"shift+down", "shift+Down"}}},
      {"Escape", "clear selection and measure", {{"Escape", "Escape"}}},
      {"f", "3-D follows the head", {{"f", "f"}}}};
  const std::vector<ViewerKey> inspect = {
      {"up down", "move the head: forward, back", {{"up", "Up"}, {"down", "Down"}}},
      {"left right", "move it to port, starboard", {{"left", "Left"}, {"right", "Right"}}},
      {"PageUp PageDown", "move it up, down", {{"PageUp", "Prior"}, {"PageDown", "Next"}}},
      {"shift + left right", "turn it: yaw", {{"shift+left", "shift+Left"}, {"shift+right", "shift+Right"}}},
      {"shift + up down", "nose up, nose down", {{"shift+up", "shift+Up"}, {"shift+down", "shift+Down"}}},
      {"shift + PageUp PageDown", "roll it", {{"shift+PgUp", "shift+Prior"}, {"shift+PgDn", "shift+Next"}}},
      {", .", "shorter, longer steps", {{",", "comma"}, {".", "period"}}},
      {"p", "print the pose as option --pose", {{"p", "p"}}}};
  std::vector<ViewerKey> keys = mode == ViewerMode::run ? run : inspect;
  keys.insert(keys.end(), {{"1 2 3", "colour: height, material, visibility", {{"1", "1"}, {"2", "2"}, {"3", "3"}}},
                           {"4 5", "colour: angle of grazing, incidence", {{"4", "4"}, {"5", "5"}}},
                           {"+ -", "point size", {{"+", "plus"}, {"-", "minus"}}},
                           {"g", "axes of the 3-D panel", {{"g", "g"}}},
                           {"n", "normals of the scene", {{"n", "n"}}},
                           {"u", "colour bars", {{"u", "u"}}},
                           {"r", "reset the cameras", {{"r", "r"}}},
                           {"j", "screenshot", {{"j", "j"}}},
                           {"h", "this help", {{"h", "h"}}},
                           {"q e", "quit", {{"q", "q"}}},
                           {"drag, wheel", "3-D: turn, zoom; fan: pan, zoom"}});
  return keys;
}

std::string viewer_help(ViewerMode mode) {
  std::string text;
  for (const ViewerKey& key : viewer_keys(mode)) {
    std::string keys = key.keys;
    keys.resize(std::max<std::size_t>(keys.size() + 1, 25), ' ');
    text += "  " + keys + key.action + "\n";
  }
  return text;
}

KeyAnswer apply_key(ViewerState state, const std::string& key, const ViewerExtent& extent) {
  KeyAnswer answer{std::move(state)};
  apply_common_key(answer, key);
  if (answer.state.mode == ViewerMode::run)
    apply_run_key(answer.state, key, extent);
  else
    apply_inspect_key(answer, key);
  return answer;
}

ViewerState select_pixel(ViewerState state, PixelPlace place, const Eigen::Vector2d& at, const ViewerExtent& extent) {
  if (place.beam >= extent.beams || place.bin >= extent.bins) return state;
  if (!state.measure.active) {
    state.selected = place;
    return state;
  }
  state.measure.points.push_back(at);
  state.measure.active = state.measure.points.size() < 2;
  return state;
}

ViewerState select_ping(ViewerState state, std::size_t ping, PixelPlace place, const ViewerExtent& extent) {
  if (ping >= extent.pings || place.beam >= extent.beams || place.bin >= extent.bins) return state;
  state.playing = false;
  state.ping = ping;
  state.selected = place;
  return state;
}

ViewerState play_on(ViewerState state, double seconds, const ViewerExtent& extent, double& carried) {
  if (!state.playing || extent.pings == 0) return state;
  carried += seconds * state.pings_per_second;
  const double whole = std::floor(carried);
  carried -= whole;
  state.ping = (state.ping + static_cast<std::size_t>(whole) % extent.pings) % extent.pings;
  return state;
}

}  // namespace insonify

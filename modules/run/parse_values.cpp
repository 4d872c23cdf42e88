// SPDX-License-Identifier: BSD-3-Clause
#include "run/parse_values.hpp"

#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

std::optional<double> as_number(std::string_view text) { return finite_number(trimmed(text, " ")); }

}  // namespace

double parse_number(const std::string& option, const std::string& text) {
  const auto value = as_number(text);
  if (!value) fail(ErrorKind::argument, option, " = '", text, "' is not a number");
  return *value;
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count,
                                  const char* meaning) {
  const std::vector<std::string_view> words = split_at(',', text);
  if (words.size() != count)
    fail(ErrorKind::argument, option, " = '", text, "' has ", words.size(), " numbers, must have ", count, ": ",
         meaning);
  std::vector<double> values;
  for (const std::string_view word : words) {
    const auto value = as_number(word);
    if (!value) fail(ErrorKind::argument, option, " = '", text, "': '", word, "' is not a number; give ", meaning);
    values.push_back(*value);
  }
  return values;
}

Eigen::Vector3d parse_vector(const std::string& option, const std::string& text, const char* meaning) {
  const auto v = parse_numbers(option, text, 3, meaning);
  return {v[0], v[1], v[2]};
}

Pose pose_of(const GivenPose& v, WorldAxes world) {
  const auto pose = world == WorldAxes::ned ? pose_from_ned : pose_from_yaw_pitch_roll;
  return pose({v[0], v[1], v[2]}, radians(v[3]), radians(v[4]), radians(v[5]));
}

Pose parse_pose(const std::string& text, const std::string& world, const char* option) {
  const auto v = parse_numbers(
      option, text, 6, printed("x,y,z,yaw,pitch,roll in metres and degrees, e.g. %s=0,0,-3,0,10,0", option).c_str());
  return pose_of({v[0], v[1], v[2], v[3], v[4], v[5]}, *find_named(world_words, world));
}

std::array<double, 2> parse_range(const std::string& text) {
  const std::vector<std::string_view> words = split_at(':', text);
  const auto min = as_number(words[0]), max = as_number(words.back());
  if (words.size() != 2 || !min || !max)
    fail(ErrorKind::argument, "--range = '", text, "' is not min:max in metres, e.g. --range 0.5:9");
  if (!(*min > 0)) fail(ErrorKind::argument, "--range = '", text, "': min range ", *min, " m must be > 0");
  if (!(*max > *min))
    fail(ErrorKind::argument, "--range = '", text, "': max range ", *max, " m must be above min range ", *min,
         " m; write min:max");
  return {*min, *max};
}

std::pair<int, int> parse_size(const std::string& text) {
  const std::vector<std::string_view> words = split_at('x', text);
  const auto width = as_number(words[0]), height = as_number(words.back());
  if (words.size() != 2 || !width || !height || *width < 100 || *height < 100 || *width > 16384 || *height > 16384)
    fail(ErrorKind::argument, "--size = '", text, "' is not WIDTHxHEIGHT within 100 and 16384 pixels, e.g. 1400x1050");
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

Setting parse_setting(const std::string& text) {
  const std::size_t equals = text.find('='), dot = text.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals)
    fail(ErrorKind::argument, "--set = '", text, "' is not section.key=value, e.g. --set sonar.beams=256");
  return {text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1)};
}

}  // namespace insonify

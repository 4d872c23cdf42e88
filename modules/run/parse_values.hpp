// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/text.hpp"
#include "run/options.hpp"

/// Words of options and what they mean, and parsers of other values. All throw Error(argument) that names option, value
/// and rule, with an example.
namespace insonify {

constexpr Named<WorldAxes> world_words[] = {{"z-up", WorldAxes::z_up}, {"ned", WorldAxes::ned}};

/// The words of such a table, for OptionRules.
template <typename Table>
std::vector<std::string> words_of(const Table& table) {
  std::vector<std::string> words;
  for (const auto& entry : table) words.emplace_back(entry.name);
  return words;
}

/// "1,2.5,-3" to `count` finite numbers.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count,
                                  const char* meaning);

/// "x,y,z" to a vector; `meaning` as in parse_numbers.
Eigen::Vector3d parse_vector(const std::string& option, const std::string& text, const char* meaning);

/// Returns the pose that is given in numbers.
Pose pose_of(const GivenPose& given, WorldAxes world = WorldAxes::z_up);

/// "x,y,z,yaw,pitch,roll" in metres and degrees; `world` is a word of world_words.
Pose parse_pose(const std::string& text, const std::string& world, const char* option = "--pose");

/// "min:max" in metres, 0 < min < max.
std::array<double, 2> parse_range(const std::string& text);

/// "1400x1050" pixels.
std::pair<int, int> parse_size(const std::string& text);

/// A value of sonar or environment that --set replaces.
struct Setting {
  std::string section, key, value;
};
/// Returns ("sonar", "beams", "256") of "sonar.beams=256".
Setting parse_setting(const std::string& text);

/// Runs `body`. What it refuses as an argument begins with `option` in place of the library's function:
/// "force_stage: TEXT" becomes "--with mirrors: TEXT".
template <typename Body>
void in_words_of(const std::string& option, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    const std::string text = error.what();
    const std::size_t end = text.find(": ");
    if (error.kind() != ErrorKind::argument || end == text.npos) throw;
    fail(ErrorKind::argument, option, text.substr(end));
  }
}

/// A whole text as one finite number.
double parse_number(const std::string& option, const std::string& text);

}  // namespace insonify

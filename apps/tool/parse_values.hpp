#pragma once
#include <string>
#include <utility>
#include <vector>

#include "beamforming/synthesize.hpp"
#include "core/pose.hpp"

/// Parsers of command-line text. All throw Error(argument) that names option, value and rule, with an example.
namespace insonify::tool {

/// "1,2.5,-3" to `count` finite numbers.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count,
                                  const char* meaning);

/// "x,y,z" to a vector; `meaning` as in parse_numbers.
Eigen::Vector3d parse_vector(const std::string& option, const std::string& text, const char* meaning);

/// "x,y,z,yaw,pitch,roll" in metres and degrees; world "z-up" (pitch positive nose down) or "ned" (z down, pitch
/// positive nose up, yaw clockwise).
Pose parse_pose(const std::string& text, const std::string& world);

/// "min:max" in metres, 0 < min < max.
std::pair<double, double> parse_range(const std::string& text);

/// "gridded", "true-delays", "direct", "element-exact" or "incoherent".
SynthesisMethod parse_method(const std::string& text);

/// "1400x1050" pixels.
std::pair<int, int> parse_size(const std::string& text);

/// Metres per unit: m, mm, cm, km, ft, or a number.
double parse_unit(const std::string& text);

/// "sonar.beams=256" to ("sonar", "beams", "256").
struct Setting {
  std::string section, key, value;
};
Setting parse_setting(const std::string& text);

/// A whole text as one finite number.
double parse_number(const std::string& option, const std::string& text);

}  // namespace insonify::tool

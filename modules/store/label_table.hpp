#pragma once
#include <string>
#include <vector>

namespace insonify {

/// A user's name for a place in a picture.
struct Label {
  double bearing_deg = 0;  ///< positive to starboard
  double range = 0;        ///< [m]
  std::string text;
};

/// Reads labels from CSV with the header bearing_deg,range_m,text; the text is all that follows the second comma, in
/// double quotes or not. '#' starts a comment line; blank lines, a byte-order mark and Windows line ends are let pass.
/// Throws Error(file), or Error(content) with path, line, column, value and rule: bearings within -360 and 360 degrees,
/// ranges > 0, one label at least.
std::vector<Label> load_labels(const std::string& path);

}  // namespace insonify

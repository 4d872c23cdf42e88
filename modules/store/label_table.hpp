#pragma once
#include <string>
#include <vector>

namespace insonify {

/// A user-defined label of a place in a picture.
struct Label {
  double bearing_deg = 0;  ///< positive to starboard
  double range = 0;        ///< [m]
  std::string text;
};

/// Reads labels from CSV with the header bearing_deg,range_m,text; the text is everything after the second comma,
/// optionally in double quotes. '#' starts a comment line; blank lines, a byte-order mark and Windows line ends are
/// accepted. Throws Error(file), or Error(content) with path, line, column, value and rule: bearings within -360 and
/// 360 degrees, ranges > 0, at least one label.
std::vector<Label> load_labels(const std::string& path);

}  // namespace insonify

#include "store/label_table.hpp"

#include <charconv>
#include <cmath>
#include <sstream>

#include "store/csv_rows_internal.hpp"
#include "store/run_directory.hpp"

namespace insonify {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Removes surrounding quotes; doubled quotes inside them become single.
std::string unquoted(const std::string& text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return text;
  std::string plain;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    plain += text[i];
    if (text[i] == '"' && text[i + 1] == '"' && i + 2 < text.size()) ++i;
  }
  return plain;
}

double number(const std::string& text, const char* column, const FilePlace& place) {
  const std::string digits = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value))
    place.fail_here(column, " = '", text, "', must be a finite number");
  return value;
}

Label read_label(const std::string& line, const FilePlace& place) {
  const std::size_t first = line.find(','), second = first == line.npos ? first : line.find(',', first + 1);
  if (second == line.npos) place.fail_here("has fewer than 3 columns, must be bearing_deg,range_m,text");
  Label label;
  label.bearing_deg = number(trimmed(line.substr(0, first)), "bearing_deg", place);
  label.range = number(trimmed(line.substr(first + 1, second - first - 1)), "range_m", place);
  label.text = unquoted(trimmed(line.substr(second + 1)));
  if (!(std::abs(label.bearing_deg) <= 360))
    place.fail_here("bearing_deg = ", label.bearing_deg, " deg, must be within -360 and 360");
  if (!(label.range > 0)) place.fail_here("range_m = ", label.range, " m, must be > 0");
  return label;
}

}  // namespace

std::vector<Label> load_labels(const std::string& path) {
  std::string text = read_text_file(path);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // byte-order mark of spreadsheets
  std::istringstream lines(text);
  std::vector<Label> labels;
  bool header = false;
  FilePlace place{path, 0};
  for (std::string line; std::getline(lines, line);) {
    ++place.line;
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    if (header) {
      labels.push_back(read_label(line, place));
    } else if (line == "bearing_deg,range_m,text") {
      header = true;
    } else {
      place.fail_here("header is '", line, "', must be bearing_deg,range_m,text");
    }
  }
  if (labels.empty()) fail(ErrorKind::content, path, ": has no labels, must have a header and at least one label");
  return labels;
}

}  // namespace insonify

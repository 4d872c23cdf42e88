#include "store/scatterer_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/error.hpp"
#include "core/units.hpp"
#include "store/nearest_word.hpp"
#include "store/run_directory.hpp"

namespace insonify {
namespace {

constexpr std::array<const char*, 6> column_names = {"range_m",  "azimuth_rad", "elevation_rad",
                                                     "sigma_m2", "xi_re",       "xi_im"};
enum Column { range_m, azimuth_rad, elevation_rad, sigma_m2, xi_re, xi_im };
using Row = std::array<double, column_names.size()>;

// Where an error message points.
struct Place {
  const std::string& path;
  std::size_t line;

  template <typename... Parts>
  [[noreturn]] void fail_here(const Parts&... parts) const {
    fail(ErrorKind::content, path, ":", line, ": ", parts...);
  }
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Cuts a line at its commas into `fields` (kept from line to line: a table may have millions).
void cut_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
}

// For each field of the header, which column it is.
std::vector<std::size_t> read_header(const std::vector<std::string_view>& fields, const Place& place) {
  const std::vector<std::string> known(column_names.begin(), column_names.end());
  std::vector<std::size_t> columns;
  for (const std::string_view field : fields) {
    std::size_t column = 0;
    while (column < known.size() && field != known[column]) ++column;
    if (column == known.size()) {
      const std::string nearest = nearest_word(std::string(field), known);
      place.fail_here("unknown column '", field, "'", nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
    }
    for (const std::size_t other : columns)
      if (other == column) place.fail_here("column '", field, "' stands there twice");
    columns.push_back(column);
  }
  for (std::size_t column = 0; column < known.size(); ++column)
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      place.fail_here("missing column '", known[column], "'");
  return columns;
}

double read_number(std::string_view text, const char* column, const Place& place) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    place.fail_here(column, " = '", text, "', must be a finite number");
  return value;
}

Row read_row(const std::vector<std::string_view>& fields, const std::vector<std::size_t>& columns, const Place& place) {
  if (fields.size() != columns.size())
    place.fail_here("has ", fields.size(), " fields, the header has ", columns.size());
  Row row{};
  for (std::size_t i = 0; i < fields.size(); ++i)
    row[columns[i]] = read_number(fields[i], column_names[columns[i]], place);
  if (!(row[range_m] > 0)) place.fail_here("range_m = ", row[range_m], " m, must be > 0");
  if (!(row[sigma_m2] >= 0)) place.fail_here("sigma_m2 = ", row[sigma_m2], " m^2, must be >= 0");
  if (!(std::abs(row[azimuth_rad]) <= pi))
    place.fail_here("azimuth_rad = ", row[azimuth_rad], " rad, must be within -pi and pi (is it in degrees?)");
  if (!(std::abs(row[elevation_rad]) <= pi / 2))
    place.fail_here("elevation_rad = ", row[elevation_rad], " rad, must be within -pi/2 and pi/2 (is it in degrees?)");
  return row;
}

void append(ScattererTable& table, const Row& row) {
  Scatterers& s = table.scatterers;
  const std::size_t place = s.size();
  s.range.push_back(row[range_m]);
  s.azimuth.push_back(row[azimuth_rad]);
  s.elevation.push_back(row[elevation_rad]);
  s.cos_incidence.push_back(1);
  s.projected_area.push_back(0);  // sigma is given instead
  s.material.push_back(0);
  s.id.push_back(place);
  s.surfel.push_back(static_cast<std::uint32_t>(place));
  table.sigma.push_back(row[sigma_m2]);
  table.xi.emplace_back(row[xi_re], row[xi_im]);
}

}  // namespace

ScattererTable load_scatterer_table(const std::string& path) {
  const std::string text = read_text_file(path);
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);  // byte-order mark of spreadsheets

  ScattererTable table;
  std::vector<std::size_t> columns;
  std::vector<std::string_view> fields;
  for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line[0] == '#') continue;
    cut_fields(line, fields);
    const Place place{path, line_number};
    if (columns.empty())
      columns = read_header(fields, place);
    else
      append(table, read_row(fields, columns, place));
  }
  if (columns.empty())
    fail(ErrorKind::content, path,
         ": has no header, must start with range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im");
  return table;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "store/csv_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/text.hpp"
#include "core/units.hpp"
#include "sonar/water.hpp"
#include "store/csv_rows_internal.hpp"

namespace insonify {
namespace {

using Row = std::span<const double>;

const std::array<CsvColumns, 2> profile_layouts = {CsvColumns{"depth_m", "sound_speed"},
                                                   CsvColumns{"depth_m", "temperature_c", "salinity_psu"}};

double speed_of_water(const Row& row, const FileLine& at) {
  const double depth = row[0], temperature_c = row[1], salinity_psu = row[2];
  if (!(depth >= 0)) at.fail_here("depth_m = ", depth, " m, must be >= 0 (it is positive down)");
  if (!(temperature_c >= -4 && temperature_c <= 100))
    at.fail_here("temperature_c = ", temperature_c, " deg C, must be within -4 and 100");
  if (!(salinity_psu >= 0 && salinity_psu <= 400))
    at.fail_here("salinity_psu = ", salinity_psu, " psu, must be within 0 and 400");
  Water water;
  water.depth = depth;
  water.temperature_c = temperature_c;
  water.salinity_psu = salinity_psu;
  return sound_speed(water);
}

void append(SoundSpeedProfile& profile, double depth, double speed, bool given, const FileLine& at) {
  if (!profile.depth.empty() && !(depth > profile.depth.back()))
    at.fail_here("depth_m = ", depth, " m, must be deeper than the previous line, ", profile.depth.back(), " m");
  if (!(speed >= 1300 && speed <= 1700))
    at.fail_here(given ? "sound_speed = " : "sound speed of temperature_c and salinity_psu = ", speed,
                 " m/s, must be within 1300 and 1700 m/s");
  profile.depth.push_back(depth);
  profile.sound_speed.push_back(speed);
}

const std::array<CsvColumns, 2> trajectory_layouts = {
    CsvColumns{"time_s", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"},
    CsvColumns{"time_s", "x_m", "y_m", "z_m", "yaw_deg", "pitch_deg", "roll_deg"}};

Pose pose_from_quaternion(const Row& row, const FileLine& at) {
  const Eigen::Quaterniond q(row[7], row[4], row[5], row[6]);
  if (!(std::abs(q.norm() - 1) <= 1e-3))
    at.fail_here("length of (qx, qy, qz, qw) = ", q.norm(), ", must be 1 within 0.001");
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(row[1], row[2], row[3]);
  return pose;
}

Pose pose_from_angles(const Row& row, const FileLine& at) {
  for (std::size_t i = 4; i < 7; ++i)
    if (!(std::abs(row[i]) <= 360))
      at.fail_here(trajectory_layouts[1][i], " = ", row[i], " degrees, must be within -360 and 360");
  return pose_from_yaw_pitch_roll({row[1], row[2], row[3]}, radians(row[4]), radians(row[5]), radians(row[6]));
}

// Adds an entry. Throws Error(content) unless it is later than the one before.
void append(Trajectory& trajectory, double time, const Pose& pose, const FileLine& at) {
  if (!trajectory.time.empty() && !(time > trajectory.time.back()))
    at.fail_here("time_s = ", time, " s, must be later than the previous line, ", trajectory.time.back(), " s");
  trajectory.time.push_back(time);
  trajectory.pose.push_back(pose);
}

void require_two_entries(const Trajectory& trajectory, const std::string& path) {
  if (trajectory.time.size() < 2)
    fail(ErrorKind::content, path, ": has ", trajectory.time.size(), " entries, must have at least two");
}

const CsvColumns scatterer_columns = {"range_m", "azimuth_rad", "elevation_rad", "sigma_m2", "xi_re", "xi_im"};
enum Column { range_m, azimuth_rad, elevation_rad, sigma_m2, xi_re, xi_im };

void require_valid(const Row& row, const FileLine& at) {
  if (!(row[range_m] > 0)) at.fail_here("range_m = ", row[range_m], " m, must be > 0");
  if (!(row[sigma_m2] >= 0)) at.fail_here("sigma_m2 = ", row[sigma_m2], " m^2, must be >= 0");
  if (!(std::abs(row[azimuth_rad]) <= pi))
    at.fail_here("azimuth_rad = ", row[azimuth_rad], " rad, must be within -pi and pi (is it in degrees?)");
  if (!(std::abs(row[elevation_rad]) <= pi / 2))
    at.fail_here("elevation_rad = ", row[elevation_rad], " rad, must be within -pi/2 and pi/2 (is it in degrees?)");
}

void append(ScattererTable& table, const Row& row) {
  Scatterers& s = table.scatterers;
  const std::size_t index = s.size();
  s.range.push_back(row[range_m]);
  s.azimuth.push_back(row[azimuth_rad]);
  s.elevation.push_back(row[elevation_rad]);
  s.cos_incidence.push_back(1);
  s.projected_area.push_back(0);  // sigma replaces it
  s.material.push_back(0);
  s.id.push_back(index);
  s.surfel.push_back(static_cast<std::uint32_t>(index));
  table.sigma.push_back(row[sigma_m2]);
  table.xi.emplace_back(row[xi_re], row[xi_im]);
}

// Removes surrounding quotes; doubled quotes inside them become single.
std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return std::string(text);
  std::string plain;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    plain += text[i];
    if (text[i] == '"' && text[i + 1] == '"' && i + 2 < text.size()) ++i;
  }
  return plain;
}

Label read_label(std::string_view line, const FileLine& at) {
  const std::size_t first = line.find(','), second = first == line.npos ? first : line.find(',', first + 1);
  if (second == line.npos) at.fail_here("has fewer than 3 columns, must be bearing_deg,range_m,text");
  Label label;
  label.bearing_deg = read_number(trimmed(line.substr(0, first)), "bearing_deg", at);
  label.range = read_number(trimmed(line.substr(first + 1, second - first - 1)), "range_m", at);
  label.text = unquoted(trimmed(line.substr(second + 1)));
  if (!(std::abs(label.bearing_deg) <= 360))
    at.fail_here("bearing_deg = ", label.bearing_deg, " deg, must be within -360 and 360");
  if (!(label.range > 0)) at.fail_here("range_m = ", label.range, " m, must be > 0");
  return label;
}

}  // namespace

SoundSpeedProfile load_sound_speed_profile(const std::string& path) {
  SoundSpeedProfile profile;
  read_csv(path, profile_layouts, [&](std::size_t layout) {
    const bool given = layout == 0;
    return [&profile, given](Row row, const FileLine& at) {
      append(profile, row[0], given ? row[1] : speed_of_water(row, at), given, at);
    };
  });
  if (profile.depth.empty()) fail(ErrorKind::content, path, ": has a header only, must have at least one entry");
  return profile;
}

Trajectory load_trajectory(const std::string& path) {
  Trajectory trajectory;
  read_csv(path, trajectory_layouts, [&](std::size_t layout) {
    return [&trajectory, layout](Row row, const FileLine& at) {
      append(trajectory, row[0], layout == 0 ? pose_from_quaternion(row, at) : pose_from_angles(row, at), at);
    };
  });
  require_two_entries(trajectory, path);
  return trajectory;
}

TideSeries load_tide(const std::string& path) {
  TideSeries tide;
  const std::array<CsvColumns, 1> layout = {CsvColumns{"time_s", "height_m"}};
  read_csv(path, layout, [&](std::size_t) {
    return [&tide](Row row, const FileLine& at) {
      if (!tide.time.empty() && !(row[0] > tide.time.back()))
        at.fail_here("time_s = ", row[0], " s, must be later than the previous line, ", tide.time.back(), " s");
      tide.time.push_back(row[0]), tide.height.push_back(row[1]);
    };
  });
  if (tide.time.size() < 2)
    fail(ErrorKind::content, path, ": has ", tide.time.size(), " entries, must have at least two");
  return tide;
}

std::vector<std::string> trajectory_notes(const std::string& path) {
  std::vector<double> last;
  std::string first;
  std::size_t found = 0;
  read_csv(path, trajectory_layouts, [&](std::size_t layout) {
    return [&, layout](Row row, const FileLine& at) {
      for (std::size_t i = 4; i < row.size() && layout == 1 && !last.empty(); ++i) {
        const double change = row[i] - last[i];
        if (std::abs(change) < 180) continue;
        ++found;
        if (first.empty())
          first = path + ":" + std::to_string(at.line) + ": " + trajectory_layouts[1][i] +
                  printed(
                      " goes from %g to %g, taken as the shortest turn, %g degrees; for a longer one give entries less "
                      "than half a turn apart",
                      last[i], row[i], std::remainder(change, 360));
      }
      last.assign(row.begin(), row.end());
    };
  });
  if (found > 1) first += " (and " + std::to_string(found - 1) + " more)";
  return found > 0 ? std::vector{first} : std::vector<std::string>{};
}

Trajectory load_tum_trajectory(const std::string& path) {
  const CsvColumns& columns = trajectory_layouts[0];
  Trajectory trajectory;
  read_lines(path, [&](std::string_view line, const FileLine& at) {
    std::istringstream words{std::string(line)};
    std::vector<double> row;
    for (std::string word; words >> word;)
      row.push_back(read_number(word, row.size() < columns.size() ? columns[row.size()] : "number", at));
    if (row.size() != columns.size())
      at.fail_here("has ", row.size(), " numbers, must have ", columns.size(), ": ", joined(columns, " "));
    append(trajectory, row[0], pose_from_quaternion(row, at), at);
  });
  require_two_entries(trajectory, path);
  return trajectory;
}

ScattererTable load_scatterer_table(const std::string& path) {
  ScattererTable table;
  read_csv(path, {&scatterer_columns, 1}, [&](std::size_t) {
    return [&](Row row, const FileLine& at) {
      require_valid(row, at);
      append(table, row);
    };
  });
  return table;
}

SoundingTable load_sounding_table(const std::string& path) {
  const std::array<std::string, 5> names = {"x_m", "y_m", "z_m", "ping", "time_s"};
  constexpr std::size_t required = 3;
  std::vector<std::string_view> fields;
  std::array<std::size_t, names.size()> column{};
  std::size_t columns = 0;
  SoundingTable table;
  read_lines(path, [&](std::string_view line, const FileLine& at) {
    cut_fields(line, fields);
    if (columns == 0) {
      columns = fields.size();
      for (std::size_t k = 0; k < names.size(); ++k) {
        column[k] = static_cast<std::size_t>(std::find(fields.begin(), fields.end(), names[k]) - fields.begin());
        if (k < required && column[k] == columns)
          at.fail_here("has no column ", names[k], "; export --to csv writes it");
      }
      return;
    }
    if (fields.size() != columns) at.fail_here("has ", fields.size(), " fields, the header has ", columns);
    const auto number = [&](std::size_t k) { return read_number(fields[column[k]], names[k], at); };
    table.position.emplace_back(number(0), number(1), number(2));
    if (column[3] < columns) table.ping.push_back(std::llround(number(3)));
    if (column[4] < columns) table.time.push_back(number(4));
  });
  if (table.position.empty()) fail(ErrorKind::content, path, ": has no rows, must have at least one");
  return table;
}

std::vector<Label> load_labels(const std::string& path) {
  std::vector<Label> labels;
  bool header = false;
  read_lines(path, [&](std::string_view line, const FileLine& at) {
    if (header)
      labels.push_back(read_label(line, at));
    else if (line != "bearing_deg,range_m,text")
      at.fail_here("header is '", line, "', must be bearing_deg,range_m,text");
    header = true;
  });
  if (labels.empty()) fail(ErrorKind::content, path, ": has no labels, must have a header and at least one label");
  return labels;
}

}  // namespace insonify

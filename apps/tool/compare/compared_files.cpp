// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compared_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "formats/aris_file.hpp"
#include "formats/npy_file.hpp"
#include "formats/oculus_file.hpp"
#include "returns/looks.hpp"
#include "run/parse_values.hpp"
#include "scene_io/cloud_field.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"
#include "view/grey_file.hpp"

namespace insonify::tool {
namespace {

constexpr double repeat_within = 0.1;  // [m]: a point of the repeated record stands for one so near

ComparedFile compared_run(const std::string& path, int ping) {
  const Cube cube = read_run_ping(path, ping);
  const Ping& p = cube.pings.front();
  ComparedFile file{{shown_level_db(p), p.fan, p.gate, std::nullopt, p.expected_level}, false, p.world_from_head};
  file.kind = p.expected_level ? "run, expected level" : p.display_cells ? "run, display cells" : "run";
  file.centre_frequency = cube.centre_frequency, file.bandwidth = cube.bandwidth, file.sound_speed = p.sound_speed;
  return file;
}

ComparedFile compared_aris(const std::string& path, int frame) {
  const ArisFrame a = read_aris_frame(path, static_cast<std::size_t>(frame));
  ComparedFile file{{level_db(a), a.fan, a.gate, aris_scale}};
  file.kind = a.model;
  file.sound_speed = a.sound_speed;
  return file;
}

ComparedFile compared_oculus(const std::string& path, int number) {
  const OculusPing o = read_oculus_ping(path, static_cast<std::size_t>(number));
  ComparedFile file{{level_db(o), o.fan, shown_gate(0, o.gate.bins(), o.gate.bin_size), GreyWindow{silence_db, 0}}};
  file.kind = "Oculus of " + std::to_string(o.bits) + " bits";
  file.sound_speed = o.sound_speed, file.centre_frequency = o.frequency;
  return file;
}

/// One channel of a side-scan. Its strongest level, at which recorders clip, does not count.
ComparedFile compared_side_scan(const std::string& path, int channel) {
  Record record = read_record(path);
  const std::size_t channels = record.channels.size();
  if (static_cast<std::size_t>(channel) >= channels)
    fail(ErrorKind::argument, "--channel = ", channel, ", must be below ", channels, ", the number of channels in ",
         path);
  ComparedFile file{
      {levels_of_beam(record.cube, static_cast<std::size_t>(channel)), std::nullopt, record.cube.pings.front().gate}};
  const double strongest = static_cast<double>(file.image.level_db.maxCoeff());
  if (record.has_scale) file.image.scale = GreyWindow{silence_db, strongest - 1e-3};
  file.kind = record.kind + ", " + record.channels[static_cast<std::size_t>(channel)];
  file.sound_speed = record.cube.sound_speed, file.centre_frequency = record.cube.centre_frequency;
  file.waterfall = true, file.altitude = std::move(record.altitude);
  return file;
}

ComparedFile compared_waterfall(const std::string& path) {
  const RunPings run = find_run_pings(path, "");
  ComparedFile file;
  std::vector<Grid<float>> rows;
  each_ping(run, [&](const Cube& cube, const Ping& ping) {
    if (ping.fan.beams() != 1)
      fail(ErrorKind::content, path, ": ", cube.sonar, " has ", ping.fan.beams(),
           " beams; the recording of a side-scan is compared with a run of one");
    if (file.image.gate && !(*file.image.gate == ping.gate))
      fail(ErrorKind::content, path, ": its pings differ in range");
    file.image.gate = ping.gate, file.image.expected_level = ping.expected_level;
    file.centre_frequency = cube.centre_frequency, file.bandwidth = cube.bandwidth, file.sound_speed = ping.sound_speed;
    rows.push_back(shown_level_db(ping));
  });
  if (rows.empty()) fail(ErrorKind::content, path, ": has no pings");
  file.image.level_db.resize(std::ssize(rows), rows.front().cols());
  for (std::size_t p = 0; p < rows.size(); ++p) file.image.level_db.row(static_cast<Eigen::Index>(p)) = rows[p];
  file.kind = "run, waterfall", file.waterfall = true;
  return file;
}

/// Levels of grey values; those at either end are clipped.
ComparedImage grey_levels(const std::string& path, const Grid<std::uint16_t>& grey, int bits,
                          const CompareOptions& options) {
  if (options.scale.empty())
    fail(ErrorKind::argument, "--scale must be given for ", path,
         ": the levels of black and white [dB], e.g. --scale 40:100");
  const GreyWindow window = parse_window("--scale", options.scale);
  const auto white = static_cast<std::uint16_t>(bits == 8 ? 255 : 65535);
  return {grey.unaryExpr([&](std::uint16_t value) { return static_cast<float>(level_of_grey(value, bits, window)); }),
          std::nullopt, std::nullopt,
          GreyWindow{window.min_db, static_cast<double>(static_cast<float>(level_of_grey(white, bits, window)))}};
}

ComparedFile compared_npy(const std::string& path, const CompareOptions& options) {
  const NpyArray array = read_npy(path);
  ComparedFile file;
  file.kind = "NPY";
  if (array.unsigned_bits > 0) {
    file.image = grey_levels(path, array.real.cast<std::uint16_t>(), array.unsigned_bits, options);
  } else if (array.imaginary.size() > 0) {
    const Grid<double> magnitude = (array.real.square() + array.imaginary.square()).sqrt();
    file.image.level_db = magnitude.unaryExpr(
        [](double pressure) { return static_cast<float>(std::max(silence_db, pressure_level_db(pressure))); });
  } else {
    file.image.level_db = array.real.cast<float>();
  }
  return file;
}

/// A picture as `image --view grey` makes it: columns are beams from port, the first row is the farthest bin.
ComparedFile compared_png(const std::string& path, const CompareOptions& options) {
  const GreyPicture picture = load_grey_png(path);
  const Grid<std::uint16_t> beams = picture.value.colwise().reverse().transpose();
  ComparedFile file{grey_levels(path, beams, picture.bits, options), true};
  file.kind = "PNG of " + std::to_string(picture.bits) + " bits";
  return file;
}

/// Takes over the geometry of another image of the same size; the columns of a picture go to the beams of that fan.
void adopt_geometry(ComparedFile& file, const ComparedFile& other) {
  file.image.fan = other.image.fan, file.image.gate = other.image.gate;
  if (!file.from_port || !other.image.fan) return;
  const std::vector<double>& azimuth = other.image.fan->azimuth;
  std::vector<std::size_t> order(azimuth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return azimuth[x] > azimuth[y]; });
  const Grid<float> columns = file.image.level_db;
  for (std::size_t k = 0; k < order.size(); ++k)
    file.image.level_db.row(static_cast<Eigen::Index>(order[k])) = columns.row(static_cast<Eigen::Index>(k));
}

bool same_geometry(const ComparedImage& a, const ComparedImage& b) {
  return a.fan->azimuth == b.fan->azimuth && a.fan->elevation == b.fan->elevation &&
         a.gate->min_range == b.gate->min_range && a.gate->bin_size == b.gate->bin_size;
}

double strength_db(double value, const std::string& unit) {
  if (unit == "db") return value;
  return value > 0 ? (unit == "power" ? db_from_power(value) : db_from_amplitude(value))
                   : std::numeric_limits<double>::quiet_NaN();
}

/// The strength of the nearest point of another cloud; NaN if that is too far.
std::vector<double> repeated_strengths(const std::vector<Eigen::Vector3d>& positions, const CompareOptions& o) {
  const CloudField again = load_cloud_field(o.repeat, o.strength);
  std::vector<double> strengths(positions.size());
  parallel_for(positions.size(), o.common.threads, [&](std::size_t i) {
    double least = repeat_within * repeat_within, value = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < again.position.size(); ++k)
      if (const double d = (again.position[k] - positions[i]).squaredNorm(); d <= least)
        least = d, value = again.value[k];
    strengths[i] = strength_db(value, o.unit);
  });
  return strengths;
}

}  // namespace

GreyWindow parse_window(const std::string& option, const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == text.npos)
    fail(ErrorKind::argument, option, " = '", text, "' is not MIN:MAX in dB, e.g. ", option, " 40:100");
  const GreyWindow window{parse_number(option, text.substr(0, colon)), parse_number(option, text.substr(colon + 1))};
  if (!(window.min_db < window.max_db)) fail(ErrorKind::argument, option, " = ", text, ": MIN must be below MAX");
  return window;
}

bool is_waterfall(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string()) == ".xtf";
}

ComparedFile load_compared(const std::string& path, int ping, const CompareOptions& options, bool waterfall) {
  namespace fs = std::filesystem;
  if (!path_exists(path)) fail(ErrorKind::file, path, ": no such run or record");
  const std::string ending = lower_case(fs::path(path).extension().string());
  if (is_folder(path) || ending == ".h5") return waterfall ? compared_waterfall(path) : compared_run(path, ping);
  if (is_waterfall(path)) return compared_side_scan(path, options.channel);
  if (ending == ".aris") return compared_aris(path, options.frame);
  if (is_record(path)) return compared_oculus(path, options.frame);
  if (ending == ".npy") return compared_npy(path, options);
  if (ending == ".png") return compared_png(path, options);
  fail(ErrorKind::argument, path, ": must be a run directory, cube.h5, a recording (", record_extensions(),
       "), .npy or .png; of a cloud name its field by --strength");
}

void match(ComparedFile& a, ComparedFile& b, const CompareOptions& options) {
  const bool same_size =
      a.image.level_db.rows() == b.image.level_db.rows() && a.image.level_db.cols() == b.image.level_db.cols();
  if (a.waterfall && b.waterfall) {
    if (!(*a.image.gate == *b.image.gate))
      a.image.level_db = naming_both(options, [&] { return resampled_in_range(a.image, *b.image.gate); });
    a.image.gate = b.image.gate;
    const Eigen::Index pings = std::min(a.image.level_db.rows(), b.image.level_db.rows());
    for (ComparedFile* file : {&a, &b}) file->image.level_db = Grid<float>(file->image.level_db.topRows(pings));
    return;
  }
  if (a.image.fan && b.image.fan) {
    if (same_size && same_geometry(a.image, b.image)) return;
    a.image.level_db = naming_both(options, [&] { return resampled(a.image, *b.image.fan, *b.image.gate); });
    a.image.fan = b.image.fan, a.image.gate = b.image.gate;
    return;
  }
  if (!same_size)
    fail(ErrorKind::content, options.a, " has ", a.image.level_db.rows(), " beams x ", a.image.level_db.cols(),
         " bins, ", options.b, " ", b.image.level_db.rows(), " x ", b.image.level_db.cols(), ", and ",
         b.image.fan ? options.a : options.b,
         " has no geometry by which to resample; make the run with as many (--set sonar.beams, --range)");
  adopt_geometry(a.image.fan ? b : a, a.image.fan ? a : b);
}

ComparedPoints compared_points(const ComparedFile& a, const CompareOptions& o) {
  if (!a.world_from_head) fail(ErrorKind::argument, o.a, ": must be a run, to predict levels at the points of ", o.b);
  const CloudField cloud = load_cloud_field(o.b, o.strength);
  const Pose head_from_world = a.world_from_head->inverse();
  ComparedPoints points;
  std::vector<Eigen::Vector3d> positions;
  points.in_cloud = cloud.value.size();
  for (std::size_t i = 0; i < cloud.value.size(); ++i) {
    const Eigen::Vector3d p = head_from_world * cloud.position[i];
    const double strength = strength_db(cloud.value[i], o.unit),
                 bin = (p.norm() - a.image.gate->min_range) / a.image.gate->bin_size;
    if (std::isnan(strength) || !(bin >= 0 && bin < static_cast<double>(a.image.level_db.cols()))) continue;
    const auto beam = nearest_beam(*a.image.fan, p);
    const double level =
        beam ? static_cast<double>(a.image.level_db(static_cast<Eigen::Index>(*beam), static_cast<Eigen::Index>(bin)))
             : silence_db;
    if (level <= silence_db) continue;
    points.predicted_db.push_back(level);
    points.measured_db.push_back(strength);
    points.range.push_back(p.norm());
    positions.push_back(cloud.position[i]);
  }
  if (positions.size() < 3)
    fail(ErrorKind::content, o.b, ": ", positions.size(), " of ", cloud.value.size(),
         " points with a strength lie where ", o.a,
         " has a level, must be 3 at least; were cloud and run made in one frame?");
  if (!o.repeat.empty()) points.repeated_db = repeated_strengths(positions, o);
  return points;
}

}  // namespace insonify::tool

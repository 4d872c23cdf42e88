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
#include "formats/aris_file.hpp"
#include "formats/npy_file.hpp"
#include "returns/looks.hpp"
#include "scene_io/cloud_field.hpp"
#include "tool/command/parse_values.hpp"
#include "tool/run/run_pings.hpp"
#include "view/grey_file.hpp"

namespace insonify::tool {
namespace {

constexpr double repeat_within = 0.1;  // [m]: a point of the repeated record stands for one so near

ComparedFile compared_run(const std::string& path, int ping) {
  Cube cube = read_run_cube(path);
  if (ping < 0 || static_cast<std::size_t>(ping) >= cube.pings.size())
    fail(ErrorKind::argument, "--ping = ", ping, ", must be from 0 and below ", cube.pings.size(),
         ", the number of pings in ", path);
  const Ping& p = cube.pings[static_cast<std::size_t>(ping)];
  ComparedFile file{{shown_level_db(p), p.fan, p.gate, std::nullopt, p.expected_level}, false, p.world_from_head};
  file.kind = p.expected_level ? "run, expected level" : "run";
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
std::vector<double> repeated_strengths(const std::vector<Eigen::Vector3d>& places, const CompareOptions& o) {
  const CloudField again = load_cloud_field(o.repeat, o.strength);
  std::vector<double> strengths(places.size());
  parallel_for(places.size(), o.common.threads, [&](std::size_t i) {
    double least = repeat_within * repeat_within, value = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < again.position.size(); ++k)
      if (const double d = (again.position[k] - places[i]).squaredNorm(); d <= least) least = d, value = again.value[k];
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

ComparedFile load_compared(const std::string& path, int ping, const CompareOptions& options) {
  namespace fs = std::filesystem;
  if (!fs::exists(path)) fail(ErrorKind::file, path, ": no such run or record");
  const std::string ending = lower_case(fs::path(path).extension().string());
  if (fs::is_directory(path) || ending == ".h5") return compared_run(path, ping);
  if (ending == ".aris") return compared_aris(path, options.frame);
  if (ending == ".npy") return compared_npy(path, options);
  if (ending == ".png") return compared_png(path, options);
  fail(ErrorKind::argument, path,
       ": must be a run directory, cube.h5, .aris, .npy or .png; of a cloud name its field by --strength");
}

void match(ComparedFile& a, ComparedFile& b, const CompareOptions& options) {
  const bool same_size =
      a.image.level_db.rows() == b.image.level_db.rows() && a.image.level_db.cols() == b.image.level_db.cols();
  if (a.image.fan && b.image.fan) {
    if (same_size && same_geometry(a.image, b.image)) return;
    a.image.level_db = resampled(a.image, *b.image.fan, *b.image.gate);
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
  std::vector<Eigen::Vector3d> places;
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
    places.push_back(cloud.position[i]);
  }
  if (places.size() < 3)
    fail(ErrorKind::content, o.b, ": ", places.size(), " of ", cloud.value.size(), " points with a strength lie where ",
         o.a, " has a level, must be 3 at least; were cloud and run made in one frame?");
  if (!o.repeat.empty()) points.repeated_db = repeated_strengths(places, o);
  return points;
}

}  // namespace insonify::tool

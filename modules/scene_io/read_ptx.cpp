// SPDX-License-Identifier: BSD-3-Clause
// PTX: scans of laser scanners as text. Each scan begins with the numbers of its columns and rows, the position and axes of
// the scanner, and the matrix that takes its points to the world; a line for each direction follows, column by column,
// "0 0 0 ..." where nothing came back.
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr double largest_shear = 1e-3;  // of a matrix that counts as a rotation: the files have six digits

struct PtxScan {
  std::size_t columns = 0, rows = 0;
  Eigen::Isometry3d scanner = Eigen::Isometry3d::Identity();  ///< place and axes of the scanner
  Eigen::Isometry3d to_world = Eigen::Isometry3d::Identity();
  bool posed = false;  ///< the scanner has a position or axes

  /// Returns the position of the scanner in the world. Programs that write points of the world give no matrix, and others
  /// give the position in the matrix alone.
  Eigen::Vector3d viewpoint() const { return posed ? scanner.translation() : to_world.translation(); }
};

class PtxReader {
 public:
  PtxReader(std::string path, std::string_view text) : path_(std::move(path)), lines_(text) {}

  /// Reads the header of the next scan; returns false at the end of the file.
  bool next(PtxScan& scan) {
    if (!lines_.next_filled(line_)) return false;
    scan = {};
    scan.columns = count("columns");
    need_line();
    scan.rows = count("rows");
    if (scan.columns > most_points / scan.rows)
      fail(ErrorKind::content, where(), ": announces ", scan.columns, " x ", scan.rows, " directions, must be at most ",
           most_points, "; export the scan in pieces");
    const Eigen::Vector3d position = numbers<3>("the place of the scanner");
    Eigen::Matrix3d axes;
    for (int k = 0; k < 3; ++k) axes.col(k) = numbers<3>("an axis of the scanner");
    Eigen::Matrix4d matrix;
    for (int k = 0; k < 4; ++k) matrix.col(k) = numbers<4>("a row of the matrix");
    scan.scanner = pose(axes, position, "axes of the scanner");
    scan.to_world = pose(matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>(), "matrix");
    scan.posed = !scan.scanner.isApprox(Eigen::Isometry3d::Identity());
    return true;
  }

  /// Appends the points of a scan to `table`, in the axes of the world: x y z and the other numbers; NaN for holes.
  void read_points(const PtxScan& scan, std::size_t& width, std::vector<double>& table) {
    for (std::size_t i = 0; i < scan.columns * scan.rows; ++i) {
      need_line();
      cells_.clear();
      for (std::string_view word = take_word(line_); !word.empty(); word = take_word(line_))
        if (!to_number(word, cells_.emplace_back()))
          fail(ErrorKind::content, where(), ": '", shown(word),
               "' is not a number; expected x y z intensity, or x y z ", "intensity red green blue");
      if (width == 0) width = cells_.size();
      if (cells_.size() != width || width < 3)
        fail(ErrorKind::content, where(), ": expected ", std::max<std::size_t>(width, 3), " numbers, found ",
             cells_.size(), "; export the file again if it is cut off");
      Eigen::Map<Eigen::Vector3d> point(cells_.data());
      point = point.isZero(0) ? Eigen::Vector3d::Constant(NAN) : scan.to_world * point;
      table.insert(table.end(), cells_.begin(), cells_.end());
    }
  }

 private:
  static constexpr std::size_t most_points = std::size_t{1} << 32;

  std::string where() const { return path_ + ":" + std::to_string(lines_.number()); }

  void need_line() {
    if (!lines_.next_filled(line_))
      fail(ErrorKind::content, path_, ": cut off after line ", lines_.number(),
           ", within a scan; copy or export it again");
  }

  std::size_t count(const char* what) {
    std::size_t value = 0;
    const std::string_view word = take_word(line_);
    if (!to_number(word, value) || value == 0 || !trimmed(line_, " \t").empty())
      fail(ErrorKind::content, where(), ": expected the number of ", what, " of a scan, found '", shown(word),
           "'; a PTX file begins with the numbers of columns and rows, a line each");
    return value;
  }

  template <int size>
  Eigen::Matrix<double, size, 1> numbers(const char* what) {
    need_line();
    Eigen::Matrix<double, size, 1> values;
    for (double& value : values)
      if (!to_number(take_word(line_), value) || !std::isfinite(value))
        fail(ErrorKind::content, where(), ": expected ", size, " numbers, ", what, "; export the scan again");
    return values;
  }

  Eigen::Isometry3d pose(const Eigen::Matrix3d& axes, const Eigen::Vector3d& position, const char* what) const {
    if (!(axes.transpose() * axes).isIdentity(largest_shear) || axes.determinant() < 0)
      fail(ErrorKind::content, where(), ": the ", what,
           " above are no rotation; export the scan without scale and mirror");
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = axes, pose.translation() = position;
    return pose;
  }

  std::string path_;
  LineReader lines_;
  std::string_view line_;
  std::vector<double> cells_;
};

std::vector<std::string> names_of_cells(std::size_t cells) {
  std::vector<std::string> names = {"x", "y", "z", "intensity", "red", "green", "blue"};
  if (cells == 6) names.erase(names.begin() + 3);
  names.resize(cells, "ignored");
  return names;
}

}  // namespace

RawCloud read_ptx(const std::string& path, const ReadOptions& options) {
  const std::string text = read_whole_file(path);
  PtxReader reader(path, text);
  RawCloud raw;
  raw.path = path;
  raw.format = "PTX";
  std::vector<double> table;
  std::size_t cells = 0;
  PtxScan scan;
  while (reader.next(scan)) {
    reader.read_points(scan, cells, table);
    raw.stations.push_back(scan.viewpoint());
    raw.station.resize(table.size() / cells, static_cast<std::uint16_t>(raw.stations.size() - 1));
    raw.width = scan.rows, raw.height = scan.columns;
    if (raw.stations.size() > most_stations)
      fail(ErrorKind::content, path, ": holds more than ", most_stations, " scans; split the file");
  }
  if (table.empty()) fail(ErrorKind::content, path, ": holds no scan; export it again");
  if (raw.stations.size() == 1) {
    raw.viewpoint = raw.stations[0];
    raw.stations.clear(), raw.station.clear();
  } else {
    raw.width = table.size() / cells, raw.height = 1;
  }
  const std::vector<std::string> names = names_of_cells(cells);
  for (const std::string& name : names) raw.fields.push_back({name, "text"});
  fill_cloud(raw, table_of_doubles(names, std::move(table)), options);
  return raw;
}

}  // namespace insonify

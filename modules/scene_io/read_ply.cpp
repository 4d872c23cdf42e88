// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <functional>
#include <limits>
#include <tuple>

#include <pcl/io/ply/ply_parser.h>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/read_apart_internal.hpp"

// PCL's parser, and not pcl::PLYReader on top of it, since PLYReader 1.13 does these things without a message: it
// shifts coordinates that stand between or behind colours other than a run of red green blue, gives faces with 8 or
// 16-bit indices no corners, and ends the program if 'obj_info num_cols' contradicts the number of vertices.
namespace insonify {
namespace {

using pcl::io::ply::ply_parser;

template <typename Number>
constexpr NumberType number_type() {
  for (int t = 0; t <= static_cast<int>(NumberType::float64); ++t) {
    const auto type = static_cast<NumberType>(t);
    const bool real = type >= NumberType::float32, has_sign = real || t % 2 == 0;
    if (size_of(type) == sizeof(Number) && real == std::is_floating_point_v<Number> &&
        has_sign == std::is_signed_v<Number>)
      return type;
  }
}

/// Takes vertices from the parser into rows that are sent, faces into `raw`.
class PlyTaker {
 public:
  PlyTaker(ArraySender& to, RawCloud& raw) : to_(to), raw_(raw) {}

  /// Empty, or what PCL found wrong.
  std::string parse(const std::string& path) {
    std::string problem;
    take<pcl::io::ply::int8, pcl::io::ply::int16, pcl::io::ply::int32, pcl::io::ply::uint8, pcl::io::ply::uint16,
         pcl::io::ply::uint32, pcl::io::ply::float32, pcl::io::ply::float64>();
    ply_parser parser;
    parser.scalar_property_definition_callbacks(scalars_);
    parser.list_property_definition_callbacks(lists_);
    parser.warning_callback([this](std::size_t, const std::string& text) {
      if (text.find("extra data") != text.npos) raw_.notes.push_back("PCL: " + text);
    });
    parser.error_callback([&](std::size_t line, const std::string& text) {
      if (problem.empty()) problem = "after line " + std::to_string(line) + ", " + text;
    });
    parser.element_definition_callback([this](const std::string& element, std::size_t rows) {
      if (element == "vertex") set_vertices(rows);
      return ply_parser::element_callbacks_type();
    });
    parser.end_header_callback([this] {
      next_ = to_.take_array<char>(rows_.rows * rows_.stride);
      return true;
    });
    if (!parser.parse(path) && problem.empty()) problem = "without saying why";
    return problem;
  }

  const SentRows& rows() const { return rows_; }

 private:
  void set_vertices(std::size_t rows) {
    if (rows >= std::numeric_limits<std::uint32_t>::max())
      fail(ErrorKind::content, raw_.path, ": holds ", rows, " points, must be at most 4294967294; split it");
    rows_.rows = raw_.width = rows;
  }

  template <typename... Number>
  void take() {
    (take_vertices<Number>(), ...);
    (take_faces<pcl::io::ply::uint8, Number>(), ...);
    (take_faces<pcl::io::ply::uint16, Number>(), ...);
    (take_faces<pcl::io::ply::uint32, Number>(), ...);
  }

  template <typename Number>
  void take_vertices() {
    ply_parser::at<Number>(scalars_) = [this](const std::string& element,
                                              const std::string& name) -> std::function<void(Number)> {
      if (element != "vertex") return {};
      const NumberType type = number_type<Number>();
      rows_.columns.push_back({name, type, rows_.stride});
      raw_.fields.push_back({name, name_of(type)});
      rows_.stride += sizeof(Number);
      return [this](Number value) {
        std::memcpy(next_, &value, sizeof(Number));
        next_ += sizeof(Number);
      };
    };
  }

  template <typename Count, typename Number>
  void take_faces() {
    using Callbacks = std::tuple<std::function<void(Count)>, std::function<void(Number)>, std::function<void()>>;
    ply_parser::at<Count, Number>(lists_) = [this](const std::string& element, const std::string& name) -> Callbacks {
      if (element != "face" || (name != "vertex_indices" && name != "vertex_index")) return {};
      return {[this](Count) { corners_.clear(); },
              [this](Number corner) {
                const double number = static_cast<double>(corner);
                corners_.push_back(
                    number >= 0 && number < static_cast<double>(rows_.rows) ? static_cast<std::int64_t>(number) : -1);
              },
              [this] { add_polygon(raw_, corners_, rows_.rows); }};
    };
  }

  ArraySender& to_;
  RawCloud& raw_;
  ply_parser::scalar_property_definition_callbacks_type scalars_;
  ply_parser::list_property_definition_callbacks_type lists_;
  SentRows rows_;
  char* next_ = nullptr;  ///< where the next number of a vertex goes
  std::vector<std::int64_t> corners_;
};

}  // namespace

RawCloud read_ply(const std::string& path, const ReadOptions& options) {
  const PlyHeader header = probe_ply(path);
  RawCloud raw;
  raw.path = path;
  raw.tags = header.tags;
  raw.format = "PLY " + header.encoding;
  const std::size_t bytes = file_size_of(path);
  read_rows_apart(raw, bytes, options, [&](ArraySender& to, RawCloud& read) {
    PlyTaker taker(to, read);
    const std::string problem = taker.parse(path);
    if (!problem.empty())
      fail(ErrorKind::content, path, ": cut off, damaged or of an unknown kind: PCL stops reading ", problem,
           "; copy the file again, or save it from CloudCompare or MeshLab");
    return taker.rows();
  });
  if (raw.tags.prepared && raw.tags.heights)
    raw.surface = std::move(raw.triangle), raw.triangle.clear();
  else if (!raw.triangle.empty() || raw.bad_triangles > 0)
    raw.format += " mesh";
  return raw;
}

}  // namespace insonify

#include <cstring>
#include <functional>
#include <limits>
#include <tuple>

#include <pcl/io/ply/ply_parser.h>

#include "core/error.hpp"
#include "scene_io/pcl_rows_internal.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// PCL's parser, and not pcl::PLYReader on top of it, since PLYReader 1.13 does these things without a message: it shifts
// coordinates that stand between or behind colours other than a run of red green blue, gives faces with 8 or 16-bit
// indices no corners, and ends the program if 'obj_info num_cols' contradicts the number of vertices.
namespace insonify {
namespace {

using pcl::io::ply::ply_parser;

/// Takes vertices from the parser into a PCL cloud, faces into `raw`.
class PlyTaker {
 public:
  explicit PlyTaker(RawCloud& raw) : raw_(raw) { cloud_.height = 1; }

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
      cloud_.data.resize(std::size_t{cloud_.width} * cloud_.point_step);
      next_ = cloud_.data.data();
      return true;
    });
    if (!parser.parse(path) && problem.empty()) problem = "without saying why";
    return problem;
  }

  const pcl::PCLPointCloud2& cloud() const { return cloud_; }

 private:
  void set_vertices(std::size_t rows) {
    if (rows >= std::numeric_limits<std::uint32_t>::max())
      fail(ErrorKind::content, raw_.path, ": holds ", rows, " points, must be at most 4294967294; split it");
    cloud_.width = static_cast<pcl::uindex_t>(rows);
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
      pcl::PCLPointField field;
      field.name = name;
      field.datatype = pcl::traits::asEnum_v<Number>;
      field.offset = cloud_.point_step;
      field.count = 1;
      cloud_.fields.push_back(field);
      cloud_.point_step += static_cast<pcl::uindex_t>(sizeof(Number));
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
                corners_.push_back(number >= 0 && number < cloud_.width ? static_cast<std::int64_t>(number) : -1);
              },
              [this] { add_polygon(raw_, corners_, cloud_.width); }};
    };
  }

  RawCloud& raw_;
  ply_parser::scalar_property_definition_callbacks_type scalars_;
  ply_parser::list_property_definition_callbacks_type lists_;
  pcl::PCLPointCloud2 cloud_;
  std::uint8_t* next_ = nullptr;  ///< where the next number of a vertex goes
  std::vector<std::int64_t> corners_;
};

}  // namespace

RawCloud read_ply(const std::string& path, const ReadOptions& options) {
  const PlyHeader header = probe_ply(path);
  RawCloud raw;
  raw.path = path;
  raw.tags = header.tags;
  raw.format = "PLY " + header.encoding;
  PlyTaker taker(raw);
  const std::string problem = taker.parse(path);
  if (!problem.empty())
    fail(ErrorKind::content, path, ": cut off, damaged or of an unknown kind: PCL stops reading ", problem,
         "; copy the file again, or save it from CloudCompare or MeshLab");
  fill_cloud(raw, table_of(taker.cloud(), raw), options);
  if (!raw.triangle.empty() || raw.bad_triangles > 0) raw.format += " mesh";
  return raw;
}

}  // namespace insonify

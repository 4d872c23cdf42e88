// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/pcl_bridge.hpp"

#include <array>
#include <sstream>

#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include "core/parallel.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/packed_rows_internal.hpp"

namespace insonify {
namespace {

std::uint8_t pcl_type(NumberType type) {
  if (type == NumberType::float64) return pcl::PCLPointField::FLOAT64;
  if (type == NumberType::float32) return pcl::PCLPointField::FLOAT32;
  return type == NumberType::uint16 ? pcl::PCLPointField::UINT16 : pcl::PCLPointField::UINT32;
}

/// Returns an unorganised PCL cloud with the rows' fields and no data yet.
pcl::PCLPointCloud2 empty_cloud(const PackedRows& rows) {
  pcl::PCLPointCloud2 cloud;
  cloud.height = 1;
  cloud.width = static_cast<pcl::uindex_t>(rows.rows);
  cloud.is_dense = true;
  for (const PackedRows::Column& column : rows.columns) {
    pcl::PCLPointField field;
    field.name = column.name;
    field.offset = cloud.point_step;
    field.datatype = pcl_type(column.type);
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<pcl::uindex_t>(size_of(column.type));
  }
  cloud.row_step = cloud.width * cloud.point_step;
  return cloud;
}

/// Suppresses PCL's output during its lifetime.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_;
};

/// Returns the rows of a PCL cloud, which must outlive the table, and sets fields, width and height of `raw`. Throws
/// Error(content) naming raw.path if the cloud's sizes are inconsistent.
RowTable table_of(const pcl::PCLPointCloud2& cloud, RawCloud& raw) {
  // The types have the order of PCLPointField's datatypes, from 1 on.
  static const std::array types = {NumberType::int8,  NumberType::uint8,  NumberType::int16,   NumberType::uint16,
                                   NumberType::int32, NumberType::uint32, NumberType::float32, NumberType::float64,
                                   NumberType::int64, NumberType::uint64};
  RowTable table;
  table.stride = cloud.point_step;
  table.rows = static_cast<std::size_t>(cloud.width) * cloud.height;
  if (cloud.is_bigendian)
    fail(ErrorKind::content, raw.path, ": is_bigendian is set; turn the bytes of the numbers and clear it");
  if (table.rows * table.stride > cloud.data.size())
    fail(ErrorKind::content, raw.path, ": width x height x point_step = ", table.rows * table.stride,
         " bytes, the cloud holds ", cloud.data.size(), "; fill the cloud completely");
  if (cloud.height > 1 && cloud.row_step != cloud.width * cloud.point_step)
    fail(ErrorKind::content, raw.path, ": row_step = ", cloud.row_step,
         ", must be width x point_step = ", cloud.width * cloud.point_step, "; pack the rows");
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name == "_" || field.datatype < 1 || field.datatype > types.size()) continue;
    const NumberType type = types[field.datatype - 1];
    if (field.offset + size_of(type) > table.stride)
      fail(ErrorKind::content, raw.path, ": field '", field.name, "' ends beyond point_step = ", table.stride,
           " bytes; correct its offset");
    table.columns.push_back({field.name, type, field.offset});
    raw.fields.push_back({field.name, name_of(type)});
  }
  raw.width = cloud.width;
  raw.height = cloud.height;
  table.bytes = reinterpret_cast<const char*>(cloud.data.data());
  return table;
}

RawCloud raw_from(const pcl::PCLPointCloud2& cloud, const LoadOptions& options) {
  RawCloud raw;
  raw.path = "from_pcl";
  raw.format = "PCL cloud";
  fill_cloud(raw, table_of(cloud, raw), read_options(options));
  return raw;
}

/// Reads a typed cloud and its sensor pose; the identity means unknown.
template <typename Point>
LoadedScene from_typed(const pcl::PointCloud<Point>& cloud, const LoadOptions& options) {
  check_options(options, "from_pcl");
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  RawCloud raw = raw_from(blob, options);
  const bool posed = !cloud.sensor_origin_.template head<3>().isZero(0) ||
                     !cloud.sensor_orientation_.coeffs().isApprox(Eigen::Quaternionf::Identity().coeffs());
  if (posed)
    raw.viewpoint = raw.meaning.axes().position(cloud.sensor_origin_.template head<3>().template cast<double>());
  return complete_scene(std::move(raw), options);
}

}  // namespace

LoadedScene from_pcl(const pcl::PointCloud<pcl::PointNormal>& cloud, const LoadOptions& options) {
  return from_typed(cloud, options);
}

LoadedScene from_pcl(const pcl::PointCloud<pcl::PointXYZ>& cloud, const LoadOptions& options) {
  return from_typed(cloud, options);
}

LoadedScene from_pcl(const pcl::PCLPointCloud2& cloud, const LoadOptions& options) {
  check_options(options, "from_pcl");
  return complete_scene(raw_from(cloud, options), options);
}

LoadedScene from_pcl(const pcl::PolygonMesh& mesh, const LoadOptions& options) {
  check_options(options, "from_pcl");
  RawCloud raw = raw_from(mesh.cloud, options);
  raw.format = "PCL mesh";
  for (const pcl::Vertices& polygon : mesh.polygons)
    add_polygon(raw, {polygon.vertices.begin(), polygon.vertices.end()}, raw.point.size());
  return complete_scene(std::move(raw), options);
}

pcl::PCLPointCloud2 to_pcl(const Soundings& soundings) {
  const PackedRows rows = rows_of(soundings, false, "", "to_pcl");
  pcl::PCLPointCloud2 cloud = empty_cloud(rows);
  cloud.data.resize(rows.rows * rows.stride());
  rows.write(0, rows.rows, reinterpret_cast<char*>(cloud.data.data()));
  return cloud;
}

pcl::PointCloud<pcl::PointNormal> to_pcl(const SceneCloud& scene) {
  require_valid(scene, "to_pcl");
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.reserve(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    pcl::PointNormal point;
    point.getVector3fMap() = (scene.origin + scene.point[i].cast<double>()).cast<float>();
    point.getNormalVector3fMap() = scene.normal[i];
    cloud.push_back(point);
  }
  return cloud;
}

std::string pcd_header(const PackedRows& rows) {
  std::string header =
      pcl::PCDWriter().generateHeaderBinary(empty_cloud(rows), Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity());
  if (!rows.origin.isZero(0)) {
    const std::string nowhere = "VIEWPOINT 0 0 0 ";
    std::ostringstream there;
    there.precision(17);
    there << "VIEWPOINT " << rows.origin.x() << ' ' << rows.origin.y() << ' ' << rows.origin.z() << ' ';
    header.replace(header.find(nowhere), nowhere.size(), there.str());
  }
  std::string comments;
  for (const std::string& comment : rows.comments) comments += "# " + comment + "\n";
  header.insert(header.find('\n') + 1, comments);
  return header + "DATA binary\n";
}

std::vector<Eigen::Vector3f> estimate_normals(const std::vector<Eigen::Vector3f>& points,
                                              const std::vector<std::uint32_t>& wanted, int neighbours, int threads,
                                              const Eigen::Vector3f& towards) {
  const QuietPcl quiet;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  const auto indices = pcl::make_shared<pcl::Indices>(wanted.begin(), wanted.end());

  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNumberOfThreads(static_cast<unsigned>(thread_count(threads)));
  estimation.setInputCloud(cloud);
  if (wanted.size() < points.size()) estimation.setIndices(indices);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(neighbours);
  estimation.setViewPoint(towards.x(), towards.y(), towards.z());
  pcl::PointCloud<pcl::Normal> found;
  estimation.compute(found);

  // Normalise, since PCL's closed-form eigenvector has unit length only to a few ulp.
  std::vector<Eigen::Vector3f> normals(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3f n = found[i].getNormalVector3fMap();
    normals[i] = n / n.norm();
  }
  return normals;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "formats/ros_messages.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "formats/grey_fan.hpp"
#include "formats/packed_bytes_internal.hpp"
#include "returns/looks.hpp"

namespace insonify {
namespace {

/// A message being packed. Every number is aligned to its size, counted from behind the four bytes of the head.
class CdrMessage {
 public:
  template <typename Number>
  void put(Number number) {
    bytes_.append((sizeof(Number) - (bytes_.size() - 4) % sizeof(Number)) % sizeof(Number), '\0');
    put_little(bytes_, number);
  }
  void text(const std::string& text) {
    count(text.size() + 1);
    bytes_.append(text).push_back('\0');
  }
  void count(std::size_t number) { put(static_cast<std::uint32_t>(number)); }
  void vector(const Eigen::Vector3d& v) { put(v.x()), put(v.y()), put(v.z()); }
  void header(std::uint64_t time, const std::string& frame) {
    put(static_cast<std::int32_t>(time / 1000000000));
    put(static_cast<std::uint32_t>(time % 1000000000));
    text(frame);
  }
  std::string& raw() { return bytes_; }

 private:
  std::string bytes_{'\0', '\1', '\0', '\0'};
};

const std::string field_line = std::string(80, '=') + "\nMSG: ";
const std::string header_fields = field_line + "std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +
                                  field_line + "builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
const std::string vector_fields = field_line + "geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
constexpr std::uint32_t dtype_uint8 = 0, dtype_uint32 = 4;
constexpr std::uint8_t uint32_field = 6, float32_field = 7;  // types in PointField

Grid<std::uint8_t> greys_of(const Ping& ping, const Tvg& tvg, const GreyWindow& window) {
  return quantise_8(apply_tvg(shown_level_db(ping), ping.gate, tvg), window);
}

}  // namespace

RosType projected_sonar_image_type() {
  return {"marine_acoustic_msgs/msg/ProjectedSonarImage",
          "std_msgs/Header header\nmarine_acoustic_msgs/PingInfo ping_info\n"
          "geometry_msgs/Vector3[] beam_directions\nfloat32[] ranges\nmarine_acoustic_msgs/SonarImageData image\n" +
              header_fields + field_line +
              "marine_acoustic_msgs/PingInfo\nfloat32 frequency\nfloat32 sound_speed\nfloat32[] tx_beamwidths\n"
              "float32[] rx_beamwidths\n" +
              vector_fields + field_line +
              "marine_acoustic_msgs/SonarImageData\nuint32 DTYPE_UINT8=0\nuint32 DTYPE_INT8=1\nuint32 DTYPE_UINT16=2\n"
              "uint32 DTYPE_INT16=3\nuint32 DTYPE_UINT32=4\nuint32 DTYPE_INT32=5\nuint32 DTYPE_UINT64=6\n"
              "uint32 DTYPE_INT64=7\nuint32 DTYPE_FLOAT32=8\nuint32 DTYPE_FLOAT64=9\nbool is_bigendian\nuint32 dtype\n"
              "uint32 beam_count\nuint8[] data\n"};
}

RosType image_type() {
  return {"sensor_msgs/msg/Image",
          "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
          "uint8[] data\n" +
              header_fields};
}

RosType point_cloud_type() {
  return {"sensor_msgs/msg/PointCloud2",
          "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\nbool is_bigendian\n"
          "uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n" +
              header_fields + field_line +
              "sensor_msgs/PointField\nuint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
              "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\n"
              "uint32 count\n"};
}

RosType transforms_type() {
  return {"tf2_msgs/msg/TFMessage",
          "geometry_msgs/TransformStamped[] transforms\n" + field_line +
              "geometry_msgs/TransformStamped\nstd_msgs/Header header\nstring child_frame_id\n"
              "geometry_msgs/Transform transform\n" +
              header_fields + field_line +
              "geometry_msgs/Transform\ngeometry_msgs/Vector3 translation\n"
              "geometry_msgs/Quaternion rotation\n" +
              vector_fields + field_line + "geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"};
}

std::string projected_sonar_image(const Ping& ping, std::uint64_t time, double frequency, double sound_speed,
                                  const Tvg& tvg, const SonarImageScale& scale) {
  require_one_row(ping, "projected_sonar_image");
  CdrMessage message;
  message.header(time, "head_sonar");
  message.put(static_cast<float>(frequency));
  message.put(static_cast<float>(sound_speed));
  for (const double width : {ping.fan.elevation_width, ping.fan.beam_width}) {
    message.count(ping.fan.beams());
    for (std::size_t b = 0; b < ping.fan.beams(); ++b) message.put(static_cast<float>(width));
  }
  message.count(ping.fan.beams());
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const Eigen::Vector3d ahead = unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
    message.vector({ahead.z(), -ahead.y(), ahead.x()});  // up, starboard, forward
  }
  message.count(ping.gate.bins());
  for (std::size_t n = 0; n < ping.gate.bins(); ++n) message.put(static_cast<float>(ping.gate.centre(n)));

  message.put(std::uint8_t{0});  // little-endian
  message.put(scale.linear ? dtype_uint32 : dtype_uint8);
  message.count(ping.fan.beams());
  std::string data;
  if (scale.linear) {
    for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
      for (Eigen::Index b = 0; b < ping.pressure.rows(); ++b)
        put_little(data, static_cast<std::uint32_t>(std::nearbyint(
                             4294967295.0 *
                             std::min(1.0, static_cast<double>(std::abs(ping.pressure(b, n))) / scale.full_scale))));
  } else {
    const Grid<std::uint8_t> grey = greys_of(ping, tvg, scale.window);
    for (Eigen::Index n = 0; n < grey.cols(); ++n)
      for (Eigen::Index b = 0; b < grey.rows(); ++b) data.push_back(static_cast<char>(grey(b, n)));
  }
  message.count(data.size());
  message.raw() += data;
  return message.raw();
}

std::string fan_image(const Ping& ping, std::uint64_t time, const Tvg& tvg, const GreyWindow& window, int height) {
  const GreyFan raster = grey_fan(ping, tvg, window, height);
  CdrMessage message;
  message.header(time, "head");
  message.count(static_cast<std::size_t>(raster.grey.rows()));
  message.count(static_cast<std::size_t>(raster.grey.cols()));
  message.text("mono8");
  message.put(std::uint8_t{0});
  message.count(static_cast<std::size_t>(raster.grey.cols()));
  message.count(static_cast<std::size_t>(raster.grey.size()));
  message.raw().append(reinterpret_cast<const char*>(raster.grey.data()), static_cast<std::size_t>(raster.grey.size()));
  return message.raw();
}

RosType nav_sat_fix_type() {
  return {
      "sensor_msgs/msg/NavSatFix",
      "std_msgs/Header header\nsensor_msgs/NavSatStatus status\nfloat64 latitude\nfloat64 longitude\n"
      "float64 altitude\nfloat64[9] position_covariance\nuint8 COVARIANCE_TYPE_UNKNOWN=0\n"
      "uint8 COVARIANCE_TYPE_APPROXIMATED=1\nuint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2\nuint8 COVARIANCE_TYPE_KNOWN=3\n"
      "uint8 position_covariance_type\n" +
          header_fields + field_line +
          "sensor_msgs/NavSatStatus\nint8 STATUS_NO_FIX=-1\nint8 STATUS_FIX=0\nint8 STATUS_SBAS_FIX=1\n"
          "int8 STATUS_GBAS_FIX=2\nint8 status\nuint16 SERVICE_GPS=1\nuint16 SERVICE_GLONASS=2\n"
          "uint16 SERVICE_COMPASS=4\nuint16 SERVICE_GALILEO=8\nuint16 service\n"};
}

std::string point_cloud(const BottomSoundings& found, const Eigen::Vector3d& origin, std::uint64_t time) {
  constexpr std::size_t stride = 4 * std::size(ros_point_fields);
  CdrMessage message;
  message.header(time, "world");
  message.count(1);
  message.count(found.size());
  message.count(std::size(ros_point_fields));
  for (std::size_t k = 0; k < std::size(ros_point_fields); ++k) {
    message.text(ros_point_fields[k].name);
    message.count(4 * k);
    message.put(std::string_view(ros_point_fields[k].type) == "float32" ? float32_field : uint32_field);
    message.count(1);
  }
  message.put(std::uint8_t{0});  // little-endian
  message.count(stride);
  message.count(stride * found.size());
  message.count(stride * found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      put_little(message.raw(), static_cast<float>(found.position[i][axis] - origin[axis]));
    for (const float number :
         {found.level_db[i], static_cast<float>(found.range[i]), found.deviation[i], found.quality[i]})
      put_little(message.raw(), number);
    put_little(message.raw(), found.beam[i]);
    put_little(message.raw(), static_cast<std::uint32_t>(found.method[i]));
    put_little(message.raw(), static_cast<std::uint32_t>(found.reject[i]));
  }
  message.put(std::uint8_t{1});  // true: all points are finite
  return message.raw();
}

namespace {

std::string transform_message(const char* parent, const char* child, const Pose& parent_from_child,
                              std::uint64_t time) {
  CdrMessage message;
  message.count(1);
  message.header(time, parent);
  message.text(child);
  message.vector(parent_from_child.translation());
  const Eigen::Quaterniond q(parent_from_child.linear());
  message.put(q.x()), message.put(q.y()), message.put(q.z()), message.put(q.w());
  return message.raw();
}

}  // namespace

std::string head_transform(const Pose& world_from_head, const Eigen::Vector3d& origin, std::uint64_t time) {
  Pose pose = world_from_head;
  pose.translation() -= origin;
  return transform_message("world", "head", pose, time);
}

std::string sonar_transform(std::uint64_t time) {
  Pose head_from_sonar = Pose::Identity();  // columns: up, starboard, forward
  head_from_sonar.linear() << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  return transform_message("head", "head_sonar", head_from_sonar, time);
}

std::string nav_sat_fix(const GeoPosition& position, std::uint64_t time) {
  CdrMessage message;
  message.header(time, "head");
  message.put(std::int8_t{0});    // status: fix
  message.put(std::uint16_t{1});  // service: GPS
  for (const double number : {degrees(position.latitude), degrees(position.longitude), position.height})
    message.put(number);
  for (int k = 0; k < 9; ++k) message.put(0.0);
  message.put(std::uint8_t{0});  // covariance unknown
  return message.raw();
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "core/geodesy.hpp"
#include "returns/bottom_detection.hpp"
#include "returns/ping.hpp"
#include "returns/quantise.hpp"

// Messages of ROS 2 as bytes (CDR, little-endian), for McapFile. Times are UTC [ns since 1970].
namespace insonify {

/// A message type: its name, and its definition with those of its members.
struct RosType {
  std::string name, text;
};
RosType projected_sonar_image_type();  ///< marine_acoustic_msgs/msg/ProjectedSonarImage
RosType image_type();                  ///< sensor_msgs/msg/Image
RosType point_cloud_type();            ///< sensor_msgs/msg/PointCloud2
RosType transforms_type();             ///< tf2_msgs/msg/TFMessage
RosType nav_sat_fix_type();            ///< sensor_msgs/msg/NavSatFix

/// Scale of the numbers in an image.
struct SonarImageScale {
  bool linear = false;  ///< UINT32, 2^32 - 1 at `full_scale`; else UINT8, nearest grey of `window`: black 0, white 255
  GreyWindow window{};  ///< [dB re 1 uPa at 1 m]
  double full_scale = 1;  ///< [Pa]
};

/// Returns a ProjectedSonarImage of a ping with one row of beams in the frame "head_sonar" (Z forward, X up, Y to
/// starboard). It holds the ranges of the bins [m], the directions of the beams, then the samples of all beams for each
/// range in turn. UINT8: levels with the TVG. UINT32: magnitudes of pressure without TVG. tx_beamwidths is the
/// elevation width, rx_beamwidths the width at broadside [rad].
std::string projected_sonar_image(const Ping& ping, std::uint64_t time, double frequency, double sound_speed,
                                  const Tvg& tvg, const SonarImageScale& scale);

/// Returns an Image (mono8) of the fan seen from above with `height` rows (grey_fan): the head below the middle of the
/// last row, starboard to the right, 0 outside.
std::string fan_image(const Ping& ping, std::uint64_t time, const Tvg& tvg, const GreyWindow& window, int height);

/// A field of the points of point_cloud.
struct RosPointField {
  const char *name, *type, *unit, *meaning;
};
/// Fields of point_cloud in the order of the message, with the types of PointField.
inline constexpr RosPointField ros_point_fields[] = {
    {"x", "float32", "m", "position in the world, less the origin in the metadata"},
    {"y", "float32", "m", "position in the world, less the origin in the metadata"},
    {"z", "float32", "m", "height in the world, less the origin in the metadata; positive up"},
    {"intensity", "float32", "dB re 1 uPa", "level of the strongest sample of the echo"},
    {"range", "float32", "m", "c t / 2 with the sound speed at the head"},
    {"deviation", "float32", "m", "predicted standard deviation of the range"},
    {"quality", "float32", "", "log10(range / deviation)"},
    {"beam", "uint32", "", "number of the beam, from 0"},
    {"method", "uint32", "", "1: by amplitude, 2: by phase"},
    {"reject", "uint32", "", "0, or with --keep-rejected the bits of the reasons"}};

/// Returns a PointCloud2 of soundings in the frame "world", less `origin` [m], with the fields of ros_point_fields.
std::string point_cloud(const BottomSoundings& found, const Eigen::Vector3d& origin, std::uint64_t time);

/// Returns the transform from world to head (less `origin`), and the constant transform from head to head_sonar.
std::string head_transform(const Pose& world_from_head, const Eigen::Vector3d& origin, std::uint64_t time);
/// Returns the transform from head to head_sonar.
std::string sonar_transform(std::uint64_t time);

/// Returns a NavSatFix of the head: latitude and longitude on WGS 84, altitude above the ellipsoid, without covariance.
std::string nav_sat_fix(const GeoPosition& position, std::uint64_t time);

}  // namespace insonify

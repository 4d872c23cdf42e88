#pragma once
#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Core>

#include "returns/ping.hpp"
#include "returns/quantise.hpp"

// Messages of ROS 2 as bytes (CDR, little-endian), for McapFile. Times are UTC [ns since 1970].
namespace insonify {

/// A type of message and its definition, with those of its parts.
struct RosType {
  std::string name, text;
};
RosType projected_sonar_image_type();  ///< marine_acoustic_msgs/msg/ProjectedSonarImage
RosType image_type();                  ///< sensor_msgs/msg/Image
RosType point_cloud_type();            ///< sensor_msgs/msg/PointCloud2
RosType transforms_type();             ///< tf2_msgs/msg/TFMessage

/// What an image means in numbers.
struct SonarImageScale {
  bool linear = false;    ///< UINT32, 2^32 - 1 at `full_scale`; else UINT8, grey values of `window` (E58)
  GreyWindow window{};    ///< [dB re 1 uPa at 1 m]
  double full_scale = 1;  ///< [Pa]
};

/// Returns a ProjectedSonarImage of a ping with one row of beams in the frame "head_sonar" (Z forward, X up, Y to
/// starboard): ranges of the bins [m], directions of the beams, then range after range the samples of all beams. UINT8:
/// levels with the TVG; UINT32: magnitudes of pressure, without. tx_beamwidths is the elevation width, rx_beamwidths the
/// width at broadside [rad].
std::string projected_sonar_image(const Ping& ping, std::uint64_t time, double frequency, double sound_speed,
                                  const Tvg& tvg, const SonarImageScale& scale);

/// Returns an Image (mono8) of the fan seen from above, the head at the bottom: `height` rows, starboard to the right,
/// nearest beam and bin, 0 outside.
std::string fan_image(const Ping& ping, std::uint64_t time, const Tvg& tvg, const GreyWindow& window, int height);

/// Returns a PointCloud2 of world positions x, y, z [m] and intensities [dB re 1 uPa], float32, in the frame "world", less
/// `origin` [m].
std::string point_cloud(std::span<const Eigen::Vector3d> positions, std::span<const float> level_db,
                        const Eigen::Vector3d& origin, std::uint64_t time);

/// Returns the transforms world to head (less `origin`) and head to head_sonar.
std::string head_transforms(const Pose& world_from_head, const Eigen::Vector3d& origin, std::uint64_t time);

}  // namespace insonify

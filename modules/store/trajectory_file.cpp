#include "store/trajectory_file.hpp"

#include <array>
#include <cmath>

#include "core/units.hpp"
#include "store/csv_rows_internal.hpp"

namespace insonify {
namespace {

using Row = std::span<const double>;

const std::array<CsvColumns, 2> layouts = {
    CsvColumns{"time_s", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"},
    CsvColumns{"time_s", "x_m", "y_m", "z_m", "yaw_deg", "pitch_deg", "roll_deg"}};

Pose pose_from_quaternion(const Row& row, const FilePlace& place) {
  const Eigen::Quaterniond q(row[7], row[4], row[5], row[6]);
  if (!(std::abs(q.norm() - 1) <= 1e-3))
    place.fail_here("length of (qx, qy, qz, qw) = ", q.norm(), ", must be 1 within 0.001");
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(row[1], row[2], row[3]);
  return pose;
}

Pose pose_from_angles(const Row& row, const FilePlace& place) {
  for (std::size_t i = 4; i < 7; ++i)
    if (!(std::abs(row[i]) <= 360))
      place.fail_here(layouts[1][i], " = ", row[i], " degrees, must be within -360 and 360");
  return pose_from_yaw_pitch_roll({row[1], row[2], row[3]}, radians(row[4]), radians(row[5]), radians(row[6]));
}

}  // namespace

Trajectory load_trajectory(const std::string& path) {
  Trajectory trajectory;
  read_csv(path, layouts, [&](std::size_t layout) {
    return [&trajectory, layout](Row row, const FilePlace& place) {
      if (!trajectory.time.empty() && !(row[0] > trajectory.time.back()))
        place.fail_here("time_s = ", row[0], " s, must be later than the previous line, ", trajectory.time.back(),
                        " s");
      trajectory.time.push_back(row[0]);
      trajectory.pose.push_back(layout == 0 ? pose_from_quaternion(row, place) : pose_from_angles(row, place));
    };
  });
  if (trajectory.time.size() < 2)
    fail(ErrorKind::content, path, ": has ", trajectory.time.size(), " entries, must have at least two");
  return trajectory;
}

}  // namespace insonify

#pragma once
#include <string>

#include "acoustics/motion.hpp"

namespace insonify {

/// Reads a trajectory of the head from CSV with the header time_s,x_m,y_m,z_m,qx,qy,qz,qw (the unit quaternion of
/// world_from_head) or time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg (as pose_from_yaw_pitch_roll: world z up, pitch
/// positive nose down), its columns in any order; '#' starts a comment line. Quaternions within 1e-3 of unit length are
/// normalised; q and -q are equivalent.
/// Throws Error(file), or Error(content) with path, line, column, value and rule: times ascend strictly, angles are
/// within -360 and 360 degrees, there are at least two entries.
Trajectory load_trajectory(const std::string& path);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "run/ping_setup.hpp"
#include "scene/scene_cloud.hpp"

/// How far a scene reaches from a head: default ranges, and notes on heads that fit it badly.
namespace insonify {

/// Distance [m] from a head to the farthest corner of the box of a scene, straight or by way of the surface and the
/// bottom of the environment; 0 for an empty box.
double reach_of(const Bounds& box, const Eigen::Vector3d& head, const Environment& environment);

/// Returns the height from which a whole scene is seen [m]: a tenth of its width above it, below 0 if all of it lies there,
/// where scenes of the sea have the surface.
double height_over(const Bounds& box);

/// The end of a range [m] that holds a reach: a little more, in two digits.
double end_of_range(double reach);

/// "min:max" in metres, as --range takes it.
std::string range_text(double min, double max);

/// Ends the range of a head at `pose` where the scene ends, if neither the options nor a run say where: at most at the
/// sonar's own end, which stays that of a scene within its least range.
void end_range_with_scene(PingSetup& setup, const Bounds& box, const Pose& pose);

/// A sentence with the remedy if the range ends far beyond the scene; empty otherwise.
std::string far_range_note(const PingSetup& setup, double reach);

/// A sentence with the remedy if the sound-speed profile ends above what a head at `head` receives of the scene; else empty.
std::string shallow_profile_note(const PingSetup& setup, const Bounds& box, const Eigen::Vector3d& head);

/// Sentences with the remedy for a range far beyond the scene, a profile that ends above it, and a head within or behind its surface.
std::vector<std::string> fit_notes(const SceneCloud& cloud, const Bounds& box, const PingSetup& setup);

/// A pose as --pose takes it, in millimetres and hundredths of a degree.
std::string pose_text(const Eigen::Vector3d& position, double yaw, double pitch);

}  // namespace insonify

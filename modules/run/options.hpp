// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/meaning_override.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// How a cloud is read and completed.
struct SceneOptions {
  std::string path;
  std::optional<Eigen::Vector3d> viewpoint{};  ///< place of the scanner [m]; absent: as the file says
  std::string materials_file{};                ///< TOML table
  std::string material{};                      ///< name for every surfel, or empty
  std::string material_field{};  ///< field of the cloud whose numbers mean materials, or empty: found by name
  MeaningOverride meaning{};     ///< units, axes and holes of the file
  double mesh_spacing = 0;
  std::optional<double> scan_noise{};  ///< [m]; absent: the file's, else estimated
  bool keep_strays = false;
};

/// Sonar and water of a run.
struct HeadOptions {
  std::string sonar;                           ///< preset or file
  std::optional<std::array<double, 2>> range;  ///< least and greatest [m]; absent: the sonar's own, of a ping to the
                                               ///< end of the scene at most
  std::string environment;                     ///< TOML file, or empty
  std::string profile;                         ///< CSV of sound speed against depth, or empty
  std::vector<std::string> settings;           ///< such as "sonar.beams=256"
};

/// Folder of a run.
struct OutputOptions {
  std::string folder;
  int keep_bits = 24;  ///< significant bits of the cube's pressures; 24: all
  bool force = false;
  bool no_picture = false;
};

/// A pose in the numbers that it is given in: x, y, z [m], yaw, pitch, roll [deg].
using GivenPose = std::array<double, 6>;

/// Axes of given poses: z up and pitch positive nose down, or z down and pitch positive nose up.
enum class WorldAxes { z_up, ned };

/// Where and when a head pings, and how it moves.
struct Placement {
  std::optional<GivenPose> pose;             ///< pose of the vehicle
  std::optional<GivenPose> mount;            ///< mounting of the head on the vehicle, z up; absent: none
  WorldAxes world = WorldAxes::z_up;         ///< axes of pose
  std::string trajectory;                    ///< CSV of times and poses that replaces pose, or empty
  double time = 0;                           ///< time of transmission [s]
  int number = -1;                           ///< number of the ping; -1: time in milliseconds
  int draw = 0;                              ///< number of the draw of the scatters of a scene of parts
  std::optional<Eigen::Vector3d> velocity;   ///< [m/s]; absent: at rest
  std::optional<Eigen::Vector3d> turn_rate;  ///< [deg/s]
};

/// A ping as it is asked for. The fields that run.toml records are the rows of the table in setting_table.cpp.
struct Run {
  SceneOptions scene;
  HeadOptions head;
  Placement placement;
  SimulationOptions simulation;            ///< requested_simulation adds what `keep` names
  std::vector<std::string> keep;           ///< further outputs: words of kept_outputs, "contributors", "paths"
  int contributors = 4;                    ///< surfels kept for each pixel, if `keep` names them
  double memory_limit = 0;                 ///< [GiB] for a .tiles scene or a mesh; 0: see the help
  std::vector<std::string> with, without;  ///< stages of the plan forced in or out
  OutputOptions output;
};

}  // namespace insonify

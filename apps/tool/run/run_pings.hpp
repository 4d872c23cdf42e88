// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/environment.hpp"
#include "acoustics/motion.hpp"
#include "core/geodesy.hpp"
#include "returns/bottom_detection.hpp"
#include "run/options.hpp"
#include "store/cube.hpp"
#include "store/mission_file.hpp"
#include "survey/mission.hpp"

namespace insonify::tool {

/// The pings of a run or of one head of a survey: cubes whose pings are read one at a time.
struct RunPings {
  std::vector<std::string> cubes;    ///< paths
  std::vector<std::string> returns;  ///< paths of the returns of its pings, if it has any
  Environment environment{};         ///< environment in its run.toml; without one the default
  std::optional<Anchor> anchor{};    ///< anchor of its mission; absent: none
  std::string system{};              ///< projected system of its world, as FileMeaning has it; empty: unknown
  std::string start_utc;
  std::optional<Pose>
      vehicle_from_head{};  ///< place of the head by its mission or --mount, at scan angle 0; absent: unknown
  std::optional<Trajectory> trajectory{};  ///< world_from_vehicle, of its mission
  std::optional<Run> sent{};               ///< settings of its pings, of a run without a mission
  MissionWater water{};                    ///< water of its mission
  TideSeries tide{};                       ///< tide of its mission; without entries there is none
  std::optional<TideSeries> reduction{};   ///< tide by which heights are reduced to z = 0; absent: the true one
  std::string assumed_profile{};  ///< path of the profile by which its mission places soundings; empty: the true one
  std::optional<double> position_deviation{};  ///< deviation of each coordinate that its mission believes [m]; 0: exact
  std::optional<InstrumentDeviations> instruments{};  ///< deviations that its mission states; absent: none
  std::vector<MissionLeg> legs{};                     ///< legs of its mission
  std::vector<std::string> notes{};                   ///< on what is unknown because files are gone
};

/// Reads one ping of the cube of a run. Throws as StoredRun::cube and read_cube, and Error(argument) that names --ping
/// unless there is one.
Cube read_run_ping(const std::string& path, std::ptrdiff_t ping);

/// Number of the leg on which a ping was sent, from 1; 0: of none, as of a run without a mission.
std::size_t leg_at(const std::vector<MissionLeg>& legs, double time);

/// Finds the cubes of a run directory (also of a merged head of a survey), a cube, or a survey, of which `head` names
/// the head; "" if it has one only. Throws Error(file) for a run that does not exist, Error(content) for one without a
/// cube or a survey with blocks that are not done, Error(argument) for a head that is not named or not there.
RunPings find_run_pings(const std::string& run, const std::string& head);

/// Names of the heads of a survey; none of another run.
std::vector<std::string> head_names(const std::string& run);

/// Returns how depths are counted: "below MSL", or "below z = 0" if a mission names no datum.
std::string depth_datum(const MissionWater& water);

/// Returns the same of a run, or of a head of a survey; empty if it has neither a sea surface nor a water level.
std::string depth_datum_of_run(const std::string& run);

/// The heads of a survey that are the two sides of one side-scan.
struct SideScanHeads {
  std::string port, starboard;
};

/// Returns them if exactly one head looks to port, and one to starboard.
std::optional<SideScanHeads> side_scan_heads(const std::string& run);

/// Returns the name of what is written of one head of a survey: fan.png of head port is fan-port.png.
std::string output_of_head(const std::string& output, const std::string& head);

/// Calls `use` with each ping and the cube it is of, without pings: memory is that of one ping.
void each_ping(const RunPings& run, const std::function<void(const Cube&, const Ping&)>& use);

/// Height of the water level in the world [m] at a time: by the reduction, else of the mission, or of the environment's
/// sea surface; absent if none says it. Throws Error(argument) for a time outside of a tide.
std::optional<double> water_level(const RunPings& run, double time);

/// Height by which the reduction raises a vehicle and its soundings at a time [m]; 0 without one. Throws as
/// water_level.
double raised_by(const RunPings& run, double time);

/// Where the vehicle was when a head pinged: world_from_vehicle; absent if the run does not say how the head is
/// mounted.
std::optional<Pose> vehicle_pose(const RunPings& run, const Ping& ping);

/// Positions of the head at the begin and the end of its first and last cube [m].
std::vector<Eigen::Vector3d> ends_of(const RunPings& run);

/// The way of the vehicle: that of the mission; else of the trajectory or velocity that the run.toml of a ping names,
/// if it leads through all pings; else through the positions of the pings, head by head as they are stored, in the order
/// of time. Absent for a single ping at rest. Adds to `notes` why a trajectory that is named is not taken.
std::optional<Trajectory> way_of(const RunPings& run, std::vector<std::string>& notes);

/// Options to find the bottom in a ping of a cube: with the water at the head, and its depth in the profile, which is
/// the one that the mission assumes, if it does.
BottomOptions bottom_options(const Cube& cube, const Ping& ping, const RunPings& run, int per_beam);

/// Seconds since 1970 of a time as 2026-05-01T08:30:00Z; 0 for "". Throws Error(argument) for another text.
double seconds_of_utc(const std::string& text);

}  // namespace insonify::tool

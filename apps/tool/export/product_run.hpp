// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>

#include <Eigen/Core>

#include "core/geodesy.hpp"
#include "returns/quantise.hpp"
#include "store/run_directory.hpp"
#include "tool/export/export_product.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {

/// A run with its position and time.
struct PlacedRun {
  const ProductOptions& options;
  RunPings pings;
  std::vector<RunPings> others{};              ///< further heads of its survey, in an xtf
  std::optional<Georeference> georeference{};  ///< where its world is; csv, mcap and png need none
  double start = 0;                            ///< seconds since 1970 of time 0
  std::optional<SoundSpeedProfile>
      processing_profile{};  ///< profile by which soundings are placed; absent: the true one

  const Georeference& reference() const { return *georeference; }
};

/// How many soundings a product has, and how many were rejected, whether it has them or not; of an xtf its pings.
struct SoundingCount {
  std::size_t soundings = 0, rejected = 0, pings = 0;
  std::vector<std::string> notes{};  ///< on what the product lacks
};

/// The name of a file, without its folder.
std::string file_name_of(const std::string& path);
/// The name of the processing profile, without its folder.
std::string profile_name(const ProductOptions& options);
/// Returns the remark of the header of a product on its processing profile; empty without one.
std::string profile_remark(const ProductOptions& options);

/// Calls `use` with every ping and its soundings of the bottom, as far as the options keep them; returns how many there
/// were. Throws Error(content) for a run without pings.
SoundingCount each_swath(const PlacedRun& run,
                         const std::function<void(const Cube&, const Ping&, const BottomSoundings&)>& use);

/// How range-compensated levels become grey values: one window for all pings, from the first, and the gain of each.
struct GreyScale {
  GreyWindow window;
  explicit GreyScale(const Ping& first);
  static Tvg tvg_of(const Ping& ping) { return {40, ping.absorption_db_per_m}; }
};

// Writers of the products: each returns how many soundings there were, that of an xtf how many pings.
SoundingCount xtf_product(const PlacedRun& run);
SoundingCount gsf_product(const PlacedRun& run);
SoundingCount las_product(const PlacedRun& run);
SoundingCount geotiff_product(const PlacedRun& run);
SoundingCount csv_product(const PlacedRun& run);
SoundingCount mcap_product(const PlacedRun& run);
/// Returns a note if an mcap is not compressed as it was asked for; else an empty text.
std::string compression_note(const ProductOptions& options);
/// Writes pictures and how to read them; returns how many pings there were.
std::size_t png_product(const PlacedRun& run, RunDirectory& directory);
/// Writes images with poses, and the scene as truth.ply; adds to `notes` why there is none. Returns how many pings there
/// were. Throws Error(content) for fans that the layout cannot hold.
std::size_t neusis_product(const PlacedRun& run, RunDirectory& directory, std::vector<std::string>& notes);

// Which way a ship points, for products that have its attitude.

/// Level axes of a ship, and its attitude.
struct ShipAxes {
  Eigen::Vector3d ahead, starboard;
  double pitch = 0, roll = 0;  ///< bow up, starboard down [rad]

  /// Takes the axes from `x`, a direction ahead, level or not, or from the `port` axis if `x` is upright.
  ShipAxes(const Eigen::Vector3d& x, const Eigen::Vector3d& port);
};

/// Axes of the ship with its axes x ahead, y to port and z up as columns: pitch is of x, roll about it.
ShipAxes axes_of_ship(const Eigen::Matrix3d& axes);

/// Axes of the ship at a ping; of an unknown one by the port axis of the head, without pitch.
ShipAxes ship_axes(const RunPings& run, const Ping& ping);

/// Returns the axis of a beam in the world.
Eigen::Vector3d axis_of_beam(const Ping& ping, std::size_t beam);

/// An entry of the arrays of a swath: a beam, and its sounding, if it has one.
struct SwathEntry {
  std::size_t beam = 0;
  std::optional<std::size_t> sounding{};
};

/// Returns the entries of a ping from port to starboard, as GSF counts them: one for each sounding, which are ordered by
/// beams, and one for each beam without.
std::vector<SwathEntry> entries_from_port(const Ping& ping, const ShipAxes& ship, const BottomSoundings& found);

/// Velocity over ground at a time; 0 without a way.
Eigen::Vector3d level_velocity(const std::optional<Trajectory>& way, double time);

}  // namespace insonify::tool

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

/// Numbers for the checks, in metres of the world unless a member states otherwise.
struct SceneNumbers {
  const RawCloud& raw;
  double spacing;        ///< distance of neighbouring points
  double unit;           ///< [m] of one unit of the file
  Eigen::Vector3d size;  ///< size of the box
  double diagonal;
  double grid;           ///< spacing on the plan, if the points were spread evenly over the box
  HeightSpread heights;  ///< low below high
};

template <typename... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

/// Doubts lengths: degrees of longitude and latitude span little, and heights in metres stand far above them.
std::string degrees_doubt(const SceneNumbers& n) {
  const Eigen::Vector3d farthest = n.raw.box.max.cwiseAbs().cwiseMax(n.raw.box.min.cwiseAbs());
  const bool on_earth = farthest.x() <= 360 && farthest.y() <= 90 && n.raw.meaning.unit.origin != MeaningOrigin::option;
  const double across = std::max(n.size.x(), n.size.y());
  if (!on_earth || !(n.grid < 0.01) || farthest.z() < 10 || farthest.z() < 2 * across) return "";
  return sentence("x and y span ", n.size.x(), " x ", n.size.y(), " in steps of ", n.grid, ", and z reaches ",
                  farthest.z(),
                  ": degrees? A scene needs metres: project it first, for example by gdalwarp -t_srs "
                  "EPSG:326ZZ for a raster in UTM zone ZZ");
}

/// Doubts single heights that are far from all others.
std::string outlier_doubt(const SceneNumbers& n) {
  const double far = far_deviations * n.heights.deviation;
  const bool low = n.raw.box.min.z()<n.heights.low - far, high = n.raw.box.max.z()> n.heights.high + far;
  if (!(n.heights.deviation > 0) || (!low && !high)) return "";
  return sentence("heights reach ", low ? n.raw.box.min.z() : n.raw.box.max.z(), " m, whereas 98 % lie within ",
                  n.heights.low, " and ", n.heights.high, " m: no data, or stray points? --nodata V makes holes of V");
}

/// Doubts heights that may be depths, which count downwards, in a file that does not say so.
std::string depth_doubt(const SceneNumbers& n) {
  const bool heights = n.raw.heights || !n.raw.raster.empty() || !n.raw.surface_name.empty();
  if (!heights || n.raw.meaning.z_down.origin != MeaningOrigin::convention || !(n.heights.low > 0)) return "";
  return sentence("all heights are above 0 (", n.heights.low, " to ", n.heights.high,
                  " m): if they are depths, give --z down");
}

/// Doubts a mesh that lies on its side.
std::string y_up_doubt(const SceneNumbers& n) {
  const bool mesh = !n.raw.triangle.empty() || n.raw.format.starts_with("OBJ");
  if (!mesh || n.raw.meaning.y_up.value || n.raw.meaning.y_up.origin != MeaningOrigin::convention) return "";
  if (!(n.size.y() < 0.25 * std::min(n.size.x(), n.size.z()))) return "";
  return sentence("the scene is ", n.size.x(), " m wide along x and ", n.size.z(), " m along z, but only ", n.size.y(),
                  " m along y: if its y axis points up, give --up y");
}

/// Doubts metres: a scan in millimetres read as metres has a spacing of metres and the size of a city, but is not flat,
/// whereas the height of surveys of that size is a few per cent of their width. Coarse surveys in metres get a milder
/// note. Coordinates of a map grid, far from zero compared with the scene, are in metres.
std::string millimetres_doubt(const SceneNumbers& n) {
  const double nearest = n.raw.box.max.cwiseAbs().cwiseMin(n.raw.box.min.cwiseAbs()).maxCoeff();
  const bool on_map_grid = nearest > 1e5 && nearest > 10 * n.diagonal;
  if (!(n.spacing > 0.5 && n.diagonal > 100) || on_map_grid) return "";
  const bool flat = n.size.minCoeff() < 0.05 * n.diagonal;
  return sentence("typical spacing ", n.spacing, " m in a box of ", n.size.x(), " x ", n.size.y(), " x ", n.size.z(),
                  " m: ", flat ? "a coarse survey? If the file is not in metres" : "this looks like millimetres. If so",
                  ", give the unit (", 0.001 * n.unit, " for millimetres, ", 0.01 * n.unit, " for centimetres)");
}

std::string kilometres_doubt(const SceneNumbers& n) {
  if (!(n.diagonal > 0 && n.diagonal < 0.02)) return "";
  return sentence("the whole scene is ", 1000 * n.diagonal, " mm large: if the file is not in metres, give the unit (",
                  1000 * n.unit, " for kilometres)");
}

/// Doubts float32 coordinates whose rounding error, half a unit in the last place, is large.
std::string precision_doubt(const SceneNumbers& n) {
  const double farthest = std::max(n.raw.box.max.cwiseAbs().maxCoeff(), n.raw.box.min.cwiseAbs().maxCoeff());
  const double step = farthest > 0 ? std::exp2(std::floor(std::log2(farthest / n.unit)) - 23) * n.unit : 0;
  if (!n.raw.float_coordinates || !(farthest > 1e5 || (farthest > 1000 && step > 0.1 * n.spacing))) return "";
  return sentence("coordinates up to ", farthest, " m are stored as float32, in steps of ", 1000 * step,
                  " mm: precision is lost; export with double coordinates (PLY) or a local origin");
}

std::string distance_doubt(const SceneNumbers& n) {
  const double far = std::max((n.raw.box.max - n.raw.origin).cwiseAbs().maxCoeff(),
                              (n.raw.box.min - n.raw.origin).cwiseAbs().maxCoeff());
  if (!(far > 1e5)) return "";
  return sentence("the scene reaches ", far / 1000, " km from its middle, where float32 steps are ",
                  1000 * std::exp2(std::floor(std::log2(far)) - 23),
                  " mm: stray points? Crop the cloud to the part of interest");
}

/// The checks of every scene. Each returns a sentence with a remedy, or nothing.
constexpr std::string (*checks[])(const SceneNumbers&) = {
    degrees_doubt,     outlier_doubt,    depth_doubt,     y_up_doubt,
    millimetres_doubt, kilometres_doubt, precision_doubt, distance_doubt,
};

}  // namespace

std::vector<std::string> doubts_about(const RawCloud& raw, double spacing) {
  const Eigen::Vector3d size = raw.box.max - raw.box.min;
  std::vector<double> heights = raw.extent.heights;
  const double factor = raw.meaning.axes().factor.z();
  for (double& height : heights) height *= factor;
  const double points = static_cast<double>(std::max<std::size_t>(1, raw.points_in_file));
  const SceneNumbers numbers{raw,
                             spacing,
                             raw.meaning.unit.value,
                             size,
                             size.norm(),
                             std::sqrt(size.x() * size.y() / points),
                             heights.empty() ? HeightSpread{} : spread_of(std::move(heights))};
  std::vector<std::string> doubts;
  for (const auto& check : checks)
    if (std::string doubt = check(numbers); !doubt.empty()) doubts.push_back(std::move(doubt));
  return doubts;
}

}  // namespace insonify

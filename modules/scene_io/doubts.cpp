// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

template <typename... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

}  // namespace

std::vector<std::string> doubts_about(const RawCloud& raw, double spacing, double unit) {
  std::vector<std::string> doubts;
  const Eigen::Vector3d extent = raw.box.max - raw.box.min;
  const double diagonal = extent.norm();

  // A scan in millimetres read as metres has a spacing of metres and the size of a city, but is not flat, whereas the
  // height of surveys of that size is a few per cent of their width. Coarse surveys in metres get a milder note, and
  // coordinates of a map grid, far from zero compared with the scene, are in metres.
  const double nearest = raw.box.max.cwiseAbs().cwiseMin(raw.box.min.cwiseAbs()).maxCoeff();
  const bool on_map_grid = nearest > 1e5 && nearest > 10 * diagonal;
  if (spacing > 0.5 && diagonal > 100 && !on_map_grid) {
    const bool flat = extent.minCoeff() < 0.05 * diagonal;
    doubts.push_back(
        sentence("typical spacing ", spacing, " m in a box of ", extent.x(), " x ", extent.y(), " x ", extent.z(),
                 " m: ", flat ? "a coarse survey? If the file is not in metres" : "this looks like millimetres. If so",
                 ", give the unit (", 0.001 * unit, " for millimetres, ", 0.01 * unit, " for centimetres)"));
  }
  if (diagonal > 0 && diagonal < 0.02) {
    doubts.push_back(sentence("the whole scene is ", 1000 * diagonal,
                              " mm large: if the file is not in metres, give the "
                              "unit (",
                              1000 * unit, " for kilometres)"));
  }

  // Rounding error of float32, half a unit in the last place.
  const double farthest = std::max(raw.box.max.cwiseAbs().maxCoeff(), raw.box.min.cwiseAbs().maxCoeff());
  const double step = farthest > 0 ? std::exp2(std::floor(std::log2(farthest / unit)) - 23) * unit : 0;
  if (raw.float_coordinates && (farthest > 1e5 || (farthest > 1000 && step > 0.1 * spacing))) {
    doubts.push_back(sentence("coordinates up to ", farthest, " m are stored as float32, in steps of ", 1000 * step,
                              " mm: precision is lost; export with double coordinates (PLY) or a local origin"));
  }
  const double far_from_origin =
      std::max((raw.box.max - raw.origin).cwiseAbs().maxCoeff(), (raw.box.min - raw.origin).cwiseAbs().maxCoeff());
  if (far_from_origin > 1e5) {
    doubts.push_back(sentence("the scene reaches ", far_from_origin / 1000,
                              " km from its middle, where float32 steps are ",
                              1000 * std::exp2(std::floor(std::log2(far_from_origin)) - 23),
                              " mm: stray points? Crop the cloud to the part of interest"));
  }
  return doubts;
}

}  // namespace insonify

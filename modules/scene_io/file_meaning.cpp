// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/file_meaning.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "scene_io/raw_cloud_internal.hpp"

namespace insonify {
namespace {

const char* name_of(MeaningOrigin origin) {
  return std::array{"convention", "file", "guessed", "option"}[static_cast<std::size_t>(origin)];
}

template <typename Value>
void take(Meant<Value>& fact, const Value& value, const char* option) {
  fact = {value, MeaningOrigin::option, std::string("as given by ") + option};
}

void widen(Bounds& box, const Bounds& part) { box = {box.min.cwiseMin(part.min), box.max.cwiseMax(part.max)}; }

std::string metres(double unit) { return printed("%.10g m", unit); }

std::string names_of(const PointClasses& classes) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (!classes[i]) numbers.push_back(std::to_string(i));
  return numbers.empty() ? "all" : "all but " + joined(numbers, ",");
}

}  // namespace

bool FileAxes::mirrors() const {
  const bool turned = from[1] == 2;  // true: a quarter turn about x, which has one negative factor
  return (factor.prod() < 0) != turned;
}

Eigen::Vector3d FileAxes::normal(const Eigen::Vector3d& in_file) const {
  const bool even = factor.cwiseAbs().minCoeff() == factor.cwiseAbs().maxCoeff();
  Eigen::Vector3d turned;
  for (int axis = 0; axis < 3; ++axis)
    turned[axis] = even ? std::copysign(1.0, factor[axis]) * in_file[from[axis]] : in_file[from[axis]] / factor[axis];
  return even ? turned : Eigen::Vector3d(turned.normalized() * in_file.norm());
}

double FileAxes::area_factor(const Eigen::Vector3d& in_file) const {
  if (in_file.isZero() || !in_file.allFinite()) return std::abs(factor[0] * factor[1]);
  if (factor.cwiseAbs() == Eigen::Vector3d::Constant(std::abs(factor[0]))) return factor[0] * factor[0];
  Eigen::Vector3d shrunk;
  for (int axis = 0; axis < 3; ++axis) shrunk[axis] = in_file[from[axis]] / factor[axis];
  return std::abs(factor.prod()) * shrunk.norm() / in_file.norm();
}

FileAxes FileMeaning::axes() const {
  FileAxes axes;
  const double high = unit_z.value > 0 ? unit_z.value : unit.value;
  axes.factor = {unit.value, unit.value, z_down.value ? -high : high};
  if (y_up.value) {
    axes.from = {0, 2, 1};
    axes.factor.y() = -axes.factor.y();
  }
  return axes;
}

void FileMeaning::override_by(const MeaningOverride& requested) {
  if (requested.unit) {
    take(unit, *requested.unit, "--unit");
    unit_z = {};
  }
  if (requested.z_down) take(z_down, *requested.z_down, "--z");
  if (requested.y_up) take(y_up, *requested.y_up, "--up");
  if (!requested.band.empty()) take(band, requested.band, "--band");
  if (requested.band_number > 0) take(band, std::to_string(requested.band_number), "--band");
  if (requested.no_data) take(no_data, *requested.no_data, "--nodata"), valid = {};
  if (requested.classes) take(classes, *requested.classes, "--classes");
}

std::vector<MeaningItem> FileMeaning::items() const {
  std::vector<MeaningItem> items;
  const auto add = [&](const char* name, const std::string& value, const auto& fact, bool always = false) {
    if (always || fact.origin != MeaningOrigin::convention)
      items.push_back({name, value, name_of(fact.origin), fact.sentence});
  };
  add("unit", metres(unit.value), unit, true);
  if (unit_z.value > 0) add("unit of z", metres(unit_z.value), unit_z);
  add("z", z_down.value ? "down" : "up", z_down, true);
  add("up", y_up.value ? "y" : "z", y_up);
  add("band", band.value, band);
  const auto number = [](double v) { return printed("%.10g", v); };
  add("nodata", no_data.value.empty() ? "none" : joined(no_data.value, ",", number), no_data);
  add("valid", joined(valid.value, " to ", number), valid);
  add("classes", names_of(classes.value), classes);
  add("system", system.value, system);
  return items;
}

HeightSpread spread_of(std::vector<double> heights) {
  std::sort(heights.begin(), heights.end());
  const std::size_t cut = heights.size() / 100, middle = heights.size() - 2 * cut;
  const Eigen::Map<const Eigen::ArrayXd> kept(heights.data() + cut, static_cast<Eigen::Index>(middle));
  return {heights[heights.size() / 2], std::sqrt((kept - kept.mean()).square().mean()), kept(0), kept(kept.size() - 1)};
}

void RawExtent::add(const RawExtent& part) {
  widen(box, part.box);
  heights.insert(heights.end(), part.heights.begin(), part.heights.end());
  for (std::size_t k = 0; k < marked.size(); ++k) marked[k] += part.marked[k], widen(marked_box[k], part.marked_box[k]);
}

void resolve_meaning(RawCloud& raw) {
  RawExtent& extent = raw.extent;
  FileMeaning& meaning = raw.meaning;
  const bool cloud = raw.triangle.empty() && raw.bad_triangles == 0;
  const bool judged =
      cloud && !raw.tags.prepared && !extent.heights.empty() && meaning.no_data.origin != MeaningOrigin::option;
  const HeightSpread spread = extent.heights.empty() ? HeightSpread{} : spread_of(extent.heights);
  for (std::size_t k = 0; k < usual_marks.size(); ++k) {
    if (extent.marked[k] == 0) continue;
    if (!judged || std::abs(usual_marks[k] - spread.median) <= far_deviations * spread.deviation) {
      widen(extent.box, extent.marked_box[k]);
      continue;
    }
    raw.holes += extent.marked[k];
    meaning.no_data.value.push_back(usual_marks[k]);
    meaning.no_data.origin = MeaningOrigin::guessed;
    meaning.no_data.sentence +=
        (meaning.no_data.sentence.empty() ? "" : "; ") + std::to_string(extent.marked[k]) +
        printed(" heights are %.10g, far from all others: holes; --nodata none keeps them", usual_marks[k]);
  }
  if (raw.other_classes > 0 && meaning.classes.origin != MeaningOrigin::option) {
    meaning.classes.origin = MeaningOrigin::file;
    meaning.classes.sentence = std::to_string(raw.other_classes) + " of " + std::to_string(raw.points_in_file) +
                               " points are of class 7 or 18, which is noise: left out; --classes all keeps them";
  }
  if (raw.named_depth && meaning.z_down.origin == MeaningOrigin::convention && spread.median > 0)
    meaning.z_down = {true, MeaningOrigin::file,
                      "the heights are called depths: positive ones lie below 0; --z up keeps them"};
  if (extent.box.min.x() > extent.box.max.x()) return;
  const FileAxes axes = meaning.axes();
  raw.box = Bounds{};
  widen(raw.box, {axes.position(extent.box.min), axes.position(extent.box.min)});
  widen(raw.box, {axes.position(extent.box.max), axes.position(extent.box.max)});
}

std::vector<std::string> FileMeaning::notes() const {
  std::vector<std::string> notes;
  for (MeaningItem& item : items())
    if (item.origin != name_of(MeaningOrigin::option) && !item.sentence.empty())
      notes.push_back(std::move(item.sentence));
  return notes;
}

}  // namespace insonify

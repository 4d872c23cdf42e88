// SPDX-License-Identifier: BSD-3-Clause
#include "tool/scene/object_list.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace insonify::tool {
namespace {

std::string value_text(const ObjectOption& option) {
  return fmt::format("{:g}{}{}", option.standard, *option.unit ? " " : "", option.unit);
}

std::string range_text(const ObjectOption& option) { return fmt::format("{:g} to {:g}", option.least, option.most); }

}  // namespace

Eigen::Vector3d size_of(const SceneMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : mesh.point) box.extend(p);
  return box.sizes().cast<double>();
}

std::string size_text(const SceneMesh& mesh) {
  const Eigen::Vector3d size = size_of(mesh);
  return fmt::format("{:.4g} x {:.4g} x {:.4g}", size.x(), size.y(), size.z());
}

nlohmann::ordered_json object_json(const ObjectKind& kind) {
  const Eigen::Vector3d size = size_of(make_object(kind.name));
  nlohmann::ordered_json options = nlohmann::ordered_json::array();
  for (const ObjectOption& o : options_of(kind))
    options.push_back({{"key", o.key},
                       {"unit", o.unit},
                       {"default", o.standard},
                       {"least", o.least},
                       {"most", o.most},
                       {"whole", o.whole},
                       {"help", o.help}});
  return {{"name", kind.name},
          {"description", kind.description},
          {"source", kind.source},
          {"size_m", {size.x(), size.y(), size.z()}},
          {"materials", std::vector<std::string>(kind.materials.begin(), kind.materials.end())},
          {"options", options}};
}

void print_objects() {
  fmt::print("{:<14} {:<22} {:<26} {}\n", "name", "size [m]", "materials", "description");
  for (const ObjectKind& kind : object_kinds())
    fmt::print("{:<14} {:<22} {:<26} {}\n", kind.name, size_text(make_object(kind.name)), joined(kind.materials),
               kind.description);
  fmt::print("\nlength x width x height; options of one: insonify make-object NAME --list\n");
}

void print_object(const ObjectKind& kind) {
  fmt::print("{}: {}\n{} m; materials: {}\noutline: {}\n\n", kind.name, kind.description,
             size_text(make_object(kind.name)), joined(kind.materials), kind.source);
  fmt::print("{:<16} {:<10} {:<12} {}\n", "--set key", "default", "from to", "what");
  for (const ObjectOption& o : options_of(kind))
    fmt::print("{:<16} {:<10} {:<12} {}\n", o.key, value_text(o), range_text(o), o.help);
}

}  // namespace insonify::tool

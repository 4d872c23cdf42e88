// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "scene/objects.hpp"

/// The objects of make-object as lists, made from their table.
namespace insonify::tool {

/// Length, width and height of a mesh [m].
Eigen::Vector3d size_of(const SceneMesh& mesh);
/// Writes the size of a mesh [m] as text: "2 x 0.533 x 0.533".
std::string size_text(const SceneMesh& mesh);

/// Name, description, source, size, materials and options of an object.
nlohmann::ordered_json object_json(const ObjectKind& kind);

/// Prints one line for each object.
void print_objects();
/// Prints an object with its options.
void print_object(const ObjectKind& kind);

}  // namespace insonify::tool

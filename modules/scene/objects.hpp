// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene_mesh.hpp"

namespace insonify {

class ObjectMesh;
class ObjectSizes;

/// An option of an object: a number with its default and the range that it may have.
struct ObjectOption {
  const char* key;
  const char* unit;  ///< "": none
  double standard;   ///< default value
  double least, most;
  const char* help;
  bool whole = false;  ///< true: must be a whole number
};

/// An object that make_object builds: its description, the source of its outline, and its options.
struct ObjectKind {
  const char* name;
  const char* description;
  const char* source;                      ///< source of the outline
  bool one_solid;                          ///< false: several closed solids, which overlap where they are joined
  std::span<const ObjectOption> options;   ///< options beyond those of all objects
  std::span<const char* const> materials;  ///< names in the material library
  /// Adds the object to a mesh.
  void (*build)(const ObjectSizes& sizes, ObjectMesh& mesh);
};

/// Returns all objects, in the order of lists.
std::span<const ObjectKind> object_kinds();

/// Returns the object of this name; null if there is none.
const ObjectKind* find_object(const std::string& name);

/// Returns all options of an object: its own, and those that every object has.
std::vector<ObjectOption> options_of(const ObjectKind& kind);

/// Returns the rule for values of the option as text: "0.001 to 100".
std::string rule_of(const ObjectOption& option);

/// Options that are set: key and value.
using ObjectSettings = std::vector<std::pair<std::string, double>>;

/// Returns the object as a mesh in its own axes [m]: x forward, z up, the lowest point at z = 0, the origin in the
/// centre of its box as seen from above. All triangles are counter-clockwise seen from outside, and solids are closed.
/// A curved surface is within tolerance_mm of the true one, and its corners have the true normals. The materials carry
/// the names of the object's materials with default numbers. Throws Error(argument) for an object or key that does not
/// exist, a value that breaks its rule, sizes that do not fit each other, or more than three million corners.
SceneMesh make_object(const std::string& name, const ObjectSettings& settings = {});

}  // namespace insonify

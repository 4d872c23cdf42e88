// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/object_mesh_internal.hpp"

// Private to scene: the builders of the table of objects. They throw Error(argument) for sizes that do not match.
namespace insonify {

void build_cylinder_mine(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_cone_mine(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_wedge_mine(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_sphere(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_drum(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_pipe(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_tyre(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_cinder_block(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_crab_pot(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_anchor(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_ladder(const ObjectSizes& sizes, ObjectMesh& mesh);
void build_diver(const ObjectSizes& sizes, ObjectMesh& mesh);

}  // namespace insonify

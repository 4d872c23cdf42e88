// SPDX-License-Identifier: BSD-3-Clause
// Meshes of robots, games and CAD by Assimp, which is loaded when it is needed. It applies the transforms of nodes, and
// the unit and up axis of Collada and FBX; coordinates are float.
#include <memory>
#include <string>

#include <Eigen/Geometry>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/metadata.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <dlfcn.h>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/read_apart_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

using Eigen::Affine3d;

/// Returns a function of Assimp, which is called as its header declares it.
template <typename Function>
Function* in_assimp(Function&, const char* name) {
  static void* const library = dlopen(INSONIFY_ASSIMP, RTLD_LAZY | RTLD_LOCAL);
  void* const found = library ? dlsym(library, name) : nullptr;
  if (!found)
    fail(ErrorKind::runtime, "Assimp's library ", INSONIFY_ASSIMP,
         ", which reads this mesh, is not there; install libassimp5 or what holds it, or export the mesh as .glb");
  return reinterpret_cast<Function*>(found);
}
#define INSONIFY_ASSIMP_FUNCTION(name) in_assimp(name, #name)

using AssimpScene = std::unique_ptr<const aiScene, void (*)(const aiScene*)>;

/// Reads a file into triangles. Throws Error(content) with Assimp's reason.
AssimpScene import(const std::string& path) {
  const auto options = INSONIFY_ASSIMP_FUNCTION(aiCreatePropertyStore)();
  const auto set = INSONIFY_ASSIMP_FUNCTION(aiSetImportPropertyInteger);
  set(options, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  set(options, "AI_CONFIG_IMPORT_FBX_IGNORE_UP_DIRECTION", 1);  // the up axis is applied here, by its number
  const aiScene* const scene = INSONIFY_ASSIMP_FUNCTION(aiImportFileExWithProperties)(
      path.c_str(),
      aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GlobalScale | aiProcess_ValidateDataStructure, nullptr,
      options);
  INSONIFY_ASSIMP_FUNCTION(aiReleasePropertyStore)(options);
  if (!scene)
    fail(ErrorKind::content, path, ": cannot be read (", INSONIFY_ASSIMP_FUNCTION(aiGetErrorString)(),
         "); export it again, or as .glb");
  return {scene, INSONIFY_ASSIMP_FUNCTION(aiReleaseImport)};
}

/// Returns a number of the settings of a file, or `otherwise`.
int setting(const aiScene& scene, const char* name, int otherwise) {
  int value = otherwise;
  if (scene.mMetaData) scene.mMetaData->Get(name, value);
  return value;
}

Affine3d transform_of(const aiNode& node) {
  const aiMatrix4x4& m = node.mTransformation;
  Affine3d transform = Affine3d::Identity();
  transform.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0, 0, 1;
  return transform;
}

/// The corners and triangles of all nodes, in the axes of the world.
struct PlacedMeshes {
  const aiScene& scene;
  RawCloud& raw;
  std::vector<double> rows{};  ///< x y z label

  void add(const aiNode& node, const Affine3d& parent) {
    const Affine3d world = parent * transform_of(node);
    for (unsigned k = 0; k < node.mNumMeshes; ++k) add(*scene.mMeshes[node.mMeshes[k]], world);
    for (unsigned k = 0; k < node.mNumChildren; ++k) add(*node.mChildren[k], world);
  }

  void add(const aiMesh& mesh, const Affine3d& world) {
    const auto first = static_cast<std::uint32_t>(rows.size() / 4);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const Eigen::Vector3d local(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z), p = world * local;
      raw.float_coordinates = raw.float_coordinates || local.cwiseAbs().maxCoeff() > 1000;
      rows.insert(rows.end(), {p.x(), p.y(), p.z(), static_cast<double>(mesh.mMaterialIndex)});
    }
    // A mirror turns triangles over; exchange corners so that their outside stays outside.
    const bool mirrored = world.linear().determinant() < 0;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      const auto corner = [&](unsigned k) { return static_cast<std::int64_t>(first + face.mIndices[k]); };
      add_polygon(raw, {corner(0), corner(mirrored ? 2 : 1), corner(mirrored ? 1 : 2)}, first + mesh.mNumVertices);
    }
  }
};

/// Sets which axis points up: the importers of Collada and X3D make it y; FBX states it, and others leave it open.
void set_up_axis(const aiScene& scene, const std::string& extension, RawCloud& raw) {
  raw.meaning.y_up.value = extension == ".dae" || extension == ".x3d";
  if (extension != ".fbx") return;
  const int up = setting(scene, "UpAxis", 1);
  if ((up != 1 && up != 2) || setting(scene, "UpAxisSign", 1) < 0)
    fail(ErrorKind::content, raw.path, ": its up axis is neither y nor z; export it with one of these up");
  raw.meaning.y_up.value = up == 1;
}

SentRows send_assimp(ArraySender& to, RawCloud& raw) {
  const AssimpScene scene = import(raw.path);
  set_up_axis(*scene, extension_of(raw.path), raw);
  PlacedMeshes meshes{*scene, raw};
  meshes.add(*scene->mRootNode, Affine3d::Identity());
  if (meshes.rows.empty())
    fail(ErrorKind::content, raw.path, ": holds no triangle; export the mesh again, with its geometry");
  for (unsigned k = 0; k < scene->mNumMaterials; ++k) {
    aiString name;
    INSONIFY_ASSIMP_FUNCTION(aiGetMaterialString)(scene->mMaterials[k], AI_MATKEY_NAME, &name);
    raw.material_names.push_back(name.length > 0 ? name.C_Str() : "material " + std::to_string(k));
  }
  raw.width = meshes.rows.size() / 4;
  const SentRows sent = rows_of_doubles({"x", "y", "z", "label"}, raw.width);
  std::copy(meshes.rows.begin(), meshes.rows.end(),
            reinterpret_cast<double*>(to.take_array<char>(sent.rows * sent.stride)));
  return sent;
}

}  // namespace

RawCloud read_assimp(const std::string& path, const ReadOptions& options) {
  RawCloud raw;
  raw.path = path;
  for (const auto& [extension, name] :
       {std::pair{".dae", "Collada"}, {".fbx", "FBX"}, {".off", "OFF"}, {".x3d", "X3D"}})
    if (extension_of(path) == extension) raw.format = std::string(name) + " mesh";
  raw.fields = {{"x", "float"}, {"y", "float"}, {"z", "float"}};
  read_rows_apart(raw, file_size_of(path), options,
                  [](ArraySender& to, RawCloud& read) { return send_assimp(to, read); });
  for (const std::string& name : raw.material_names) raw.tags.materials.push_back({.name = name});
  return raw;
}

}  // namespace insonify

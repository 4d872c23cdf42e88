// SPDX-License-Identifier: BSD-3-Clause
// Meshes of robots, games and CAD by Assimp, which is loaded when it is needed. It applies the transforms of nodes, and
// the unit and up axis of Collada and FBX; the unit of 3MF is read here. Coordinates are float.
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
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#ifdef INSONIFY_GDAL
#include "scene_io/gdal_library_internal.hpp"
#endif
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
  constexpr unsigned steps =
      aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GlobalScale | aiProcess_ValidateDataStructure;
  const std::string extension = extension_of(path);
  const std::string x3d = extension == ".wrl"   ? x3d_for_assimp(path, vrml_as_x3d(path))
                          : extension == ".x3d" ? x3d_for_assimp(path, read_whole_file(path))
                                                : "";
  const aiScene* const scene =
      x3d.empty() ? INSONIFY_ASSIMP_FUNCTION(aiImportFileExWithProperties)(path.c_str(), steps, nullptr, options)
                  : INSONIFY_ASSIMP_FUNCTION(aiImportFileFromMemoryWithProperties)(
                        x3d.data(), static_cast<unsigned>(x3d.size()), steps, "x3d", options);
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

/// Returns the name of the material of a mesh of a node. The importer of 3MF puts "id", a number and "_" before it; that
/// of X3D keeps none, so that they are in the names of the nodes.
std::string material_of(const aiScene& scene, const aiNode& node, const aiMesh& mesh, const std::string& extension) {
  const std::string of_node = node.mName.C_Str();
  if (of_node.starts_with(x3d_material)) return of_node.substr(x3d_material.size());
  aiString found;
  INSONIFY_ASSIMP_FUNCTION(aiGetMaterialString)(scene.mMaterials[mesh.mMaterialIndex], AI_MATKEY_NAME, &found);
  const std::string name = found.C_Str();
  if (name == AI_DEFAULT_MATERIAL_NAME || extension == ".off") return "default";
  if (name.empty()) return "material " + std::to_string(mesh.mMaterialIndex);
  const std::size_t end = name.find_first_not_of("0123456789", 2);
  const bool numbered = extension == ".3mf" && name.starts_with("id") && end != name.npos && name[end] == '_';
  return numbered ? name.substr(end + 1) : name;
}

/// The corners and triangles of all nodes, in the axes of the world.
struct PlacedMeshes {
  const aiScene& scene;
  RawCloud& raw;
  MaterialNumbers materials{raw};
  std::vector<double> rows{};  ///< x y z label

  void add(const aiNode& node, const Affine3d& world) {
    for (unsigned k = 0; k < node.mNumMeshes; ++k) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[k]];
      add(mesh, materials.of(material_of(scene, node, mesh, extension_of(raw.path))), world);
    }
    for (unsigned k = 0; k < node.mNumChildren; ++k) add(*node.mChildren[k], world * transform_of(*node.mChildren[k]));
  }

  void add(const aiMesh& mesh, std::size_t label, const Affine3d& world) {
    const auto first = static_cast<std::uint32_t>(rows.size() / 4);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const Eigen::Vector3d local(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z), p = world * local;
      raw.float_coordinates = raw.float_coordinates || local.cwiseAbs().maxCoeff() > 1000;
      rows.insert(rows.end(), {p.x(), p.y(), p.z(), static_cast<double>(label)});
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

/// Sets the unit of a 3MF, which Assimp leaves out: GDAL reads the begin of its model from the zip.
void set_unit_of_3mf(RawCloud& raw) {
  std::string head;
#ifdef INSONIFY_GDAL
  head = beginning_in_zip(raw.path, "3D/3dmodel.model", 1 << 16);
#endif
  const std::size_t begin = head.find("<model"), end = begin == head.npos ? begin : head.find('>', begin);
  if (end == head.npos) {
    raw.meaning.no_lengths =
        "the unit in it cannot be read; give --unit mm, or what its model says: unzip -p FILE "
        "3D/3dmodel.model | head -c 1000";
    return;
  }
  const std::string tag = head.substr(begin, end - begin);
  const std::size_t at = tag.find(" unit=");
  const std::string name = at == tag.npos ? "millimeter" : tag.substr(at + 7, tag.find(tag[at + 6], at + 7) - at - 7);
  const std::optional<double> unit = name == "micron" ? 1e-6 : name == "inch" ? 0.0254 : unit_named(name);
  if (!unit) fail(ErrorKind::content, raw.path, ": its unit '", shown(name), "' is unknown; export it in millimetres");
  raw.meaning.unit = {*unit, MeaningOrigin::file, "unit of the file: " + name};
}

/// Notes what Assimp leaves out of X3D.
void note_left_out(RawCloud& raw) {
  const std::string text = read_whole_file(raw.path);
  if (text.find("ccw=\"false\"") != text.npos || text.find("ccw='false'") != text.npos)
    raw.notes.push_back("'ccw' is left out: faces with ccw false have their outside inside");
  for (const std::string node :
       {"Anchor",    "Billboard",        "CADAssembly",   "CADFace",           "CADLayer",      "CADPart",
        "Collision", "GeoElevationGrid", "GeoLOD",        "GeoTransform",      "HAnimHumanoid", "IndexedQuadSet",
        "Layer",     "LayoutLayer",      "LOD",           "NurbsPatchSurface", "PickableGroup", "ProtoInstance",
        "QuadSet",   "ScreenGroup",      "ViewpointGroup"})
    if (text.find("<" + node + ">") != text.npos || text.find("<" + node + " ") != text.npos)
      raw.notes.push_back("nodes of type " + node +
                          ", and what is in them, are left out: export it without them, or as .glb");
}

/// Sets which axis points up: the importers of Collada and X3D (of VRML, too) make it y; FBX states it, and others leave
/// it open.
void set_up_axis(const aiScene& scene, const std::string& extension, RawCloud& raw) {
  raw.meaning.y_up.value = extension == ".dae" || extension == ".x3d" || extension == ".wrl";
  if (extension != ".fbx") return;
  const int up = setting(scene, "UpAxis", 1);
  if ((up != 1 && up != 2) || setting(scene, "UpAxisSign", 1) < 0)
    fail(ErrorKind::content, raw.path, ": its up axis is neither y nor z; export it with one of these up");
  raw.meaning.y_up.value = up == 1;
}

SentRows send_assimp(ArraySender& to, RawCloud& raw) {
  const AssimpScene scene = import(raw.path);
  set_up_axis(*scene, extension_of(raw.path), raw);
  if (extension_of(raw.path) == ".x3d") note_left_out(raw);
  if (extension_of(raw.path) == ".3mf") set_unit_of_3mf(raw);
  PlacedMeshes meshes{*scene, raw};
  // The root of an FBX has no transform of its own. Assimp turns it by the axes of the file, each version otherwise; the
  // up axis is applied here instead.
  const bool is_fbx = extension_of(raw.path) == ".fbx";
  meshes.add(*scene->mRootNode, is_fbx ? Affine3d::Identity() : transform_of(*scene->mRootNode));
  if (meshes.rows.empty())
    fail(ErrorKind::content, raw.path, ": holds no triangle; export the mesh again, with its geometry");
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
  for (const auto& [extension, name] : {std::pair{".dae", "Collada"},
                                        {".fbx", "FBX"},
                                        {".off", "OFF"},
                                        {".x3d", "X3D"},
                                        {".wrl", "VRML"},
                                        {".3mf", "3MF"}})
    if (extension_of(path) == extension) raw.format = std::string(name) + " mesh";
  raw.fields = {{"x", "float"}, {"y", "float"}, {"z", "float"}};
  read_rows_apart(raw, file_size_of(path), options,
                  [](ArraySender& to, RawCloud& read) { return send_assimp(to, read); });
  return raw;
}

}  // namespace insonify

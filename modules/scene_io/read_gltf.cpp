// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/gltf_document_internal.hpp"
#include "scene_io/read_apart_internal.hpp"

// Meshes of glTF in the positions of their nodes. The y axis points up, as the meaning says.
namespace insonify {
namespace {

using Eigen::Affine3d;
using nlohmann::json;

/// A mesh in its own axes. It is read once, and placed by one node or more.
struct GltfMesh {
  std::vector<double> points;  ///< x y z label
  RawCloud faces;              ///< its triangles alone
};

/// Appends the triangles of a primitive, whose `count` points follow the first `first` points of its mesh.
void add_primitive(const GltfDocument& document, const json& primitive, std::size_t first, std::size_t count,
                   RawCloud& faces) {
  const auto corner = [&](auto i) { return static_cast<std::int64_t>(first) + static_cast<std::int64_t>(i); };
  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < count; ++i) corners.push_back(corner(i));
  if (primitive.contains("indices")) {
    corners.clear();
    const std::uint64_t index = document.number(primitive, "indices");
    const std::uint64_t type = document.number(document.entry("accessors", index), "componentType");
    const double restart = type == 5121 ? 0xff : type == 5123 ? 0xffff : 0xffffffff;
    for (const double i : document.numbers(index, "SCALAR"))
      corners.push_back(i == restart ? -1 : i >= 0 && i < static_cast<double>(count) ? corner(i) : -2);
  }
  const std::uint64_t mode = document.number(primitive, "mode", 4);
  if (mode == 5) add_strip(faces, corners, first + count);
  for (std::size_t i = 0; mode == 4 && i < corners.size(); i += 3)
    add_polygon(faces, {corners.begin() + i, corners.begin() + std::min(i + 3, corners.size())}, first + count);
  for (std::size_t i = 2; mode == 6 && i < corners.size(); ++i)
    add_polygon(faces, {corners[0], corners[i - 1], corners[i]}, first + count);
}

/// Returns the name of the material of a primitive in a document that has materials.
std::string material_of(const GltfDocument& document, const json& primitive) {
  if (!primitive.contains("material")) return "default";
  const std::uint64_t index = document.number(primitive, "material");
  const std::string name = document.entry("materials", index).value("name", "");
  return name.empty() ? "material " + std::to_string(index) : name;
}

GltfMesh read_mesh(const GltfDocument& document, std::uint64_t index, MaterialNumbers& materials) {
  GltfMesh mesh;
  // Accessors of points, and labels: begin and number of points.
  std::map<std::pair<std::uint64_t, std::size_t>, std::array<std::size_t, 2>> known_points;
  const bool named = !document.list(document.root, "materials").empty();
  const json& primitives = document.list(document.entry("meshes", index), "primitives");
  if (primitives.empty()) document.refuse("a mesh has no primitives");
  for (const json& primitive : primitives) {
    const json attributes = primitive.value("attributes", json::object());
    if (!attributes.contains("POSITION")) document.refuse("a primitive has no positions");
    const std::uint64_t accessor = document.number(attributes, "POSITION");
    const std::size_t label = named ? materials.of(material_of(document, primitive)) : 0;
    const auto [entry, is_new] = known_points.try_emplace({accessor, label});
    auto& [first, count] = entry->second;
    if (is_new) {
      const std::vector<double> points = document.numbers(accessor, "VEC3");
      first = mesh.points.size() / 4, count = points.size() / 3;
      for (std::size_t i = 0; i < points.size(); i += 3)
        mesh.points.insert(mesh.points.end(), {points[i], points[i + 1], points[i + 2], static_cast<double>(label)});
    }
    add_primitive(document, primitive, first, count, mesh.faces);
  }
  return mesh;
}

Affine3d transform_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                      const std::array<double, 3>& scale) {
  return Eigen::Translation3d(translation[0], translation[1], translation[2]) *
         Eigen::Quaterniond(rotation[3], rotation[0], rotation[1], rotation[2]).normalized() *
         Eigen::Scaling(scale[0], scale[1], scale[2]);
}

constexpr std::array<double, 3> no_move = {0, 0, 0}, no_scale = {1, 1, 1};
constexpr std::array<double, 4> no_turn = {0, 0, 0, 1};

Affine3d transform_of(const json& node) {
  if (!node.contains("matrix"))
    return transform_of(node.value("translation", no_move), node.value("rotation", no_turn),
                        node.value("scale", no_scale));
  const auto numbers = node["matrix"].get<std::array<double, 16>>();
  return Affine3d(Eigen::Map<const Eigen::Matrix4d>(numbers.data()));
}

/// Returns the transforms of the copies of a node's mesh: one, or those of EXT_mesh_gpu_instancing.
std::vector<Affine3d> copies_of(const GltfDocument& document, const json& node) {
  const json extensions = node.value("extensions", json::object());
  if (!extensions.contains("EXT_mesh_gpu_instancing")) return {Affine3d::Identity()};
  const json& attributes = extensions["EXT_mesh_gpu_instancing"].at("attributes");
  std::array<std::vector<double>, 3> numbers;
  std::size_t copies = 0;
  constexpr std::array names = {"TRANSLATION", "ROTATION", "SCALE"};
  for (const std::size_t i : {0, 1, 2}) {
    if (!attributes.contains(names[i])) continue;
    numbers[i] = document.numbers(document.number(attributes, names[i]), i == 1 ? "VEC4" : "VEC3");
    copies = std::max(copies, numbers[i].size() / (i == 1 ? 4 : 3));
  }
  std::vector<Affine3d> transforms;
  for (std::size_t k = 0; k < copies; ++k) {
    const auto row = [&]<std::size_t size>(std::size_t i, std::array<double, size> otherwise) {
      if (numbers[i].size() >= (k + 1) * size) std::copy_n(&numbers[i][k * size], size, otherwise.begin());
      return otherwise;
    };
    transforms.push_back(transform_of(row(0, no_move), row(1, no_turn), row(2, no_scale)));
  }
  return transforms;
}

/// Returns the nodes of the scene, or all nodes without a parent if the document names no scene.
json roots_of(const GltfDocument& document) {
  const json& root = document.root;
  if (!document.list(root, "scenes").empty())
    return document.list(document.entry("scenes", document.number(root, "scene", 0)), "nodes");
  std::vector<std::uint64_t> children, roots;
  const json& nodes = document.list(root, "nodes");
  for (const json& node : nodes)
    for (const json& child : document.list(node, "children")) children.push_back(child.get<std::uint64_t>());
  std::sort(children.begin(), children.end());
  for (std::uint64_t n = 0; n < nodes.size(); ++n)
    if (!std::binary_search(children.begin(), children.end(), n)) roots.push_back(n);
  return roots;
}

struct Placement {
  std::uint64_t mesh;
  Affine3d world;
};

/// Returns the placements of all meshes, from the roots to the leaves. Nodes must form trees.
std::vector<Placement> placements_of(const GltfDocument& document, RawCloud& raw) {
  std::vector<Placement> placements, nodes;  // nodes: number of a node, and place of its parent
  std::vector<bool> seen(document.list(document.root, "nodes").size());
  bool posed = document.root.contains("animations");
  for (const json& node : roots_of(document)) nodes.push_back({node.get<std::uint64_t>(), Affine3d::Identity()});
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const json& node = document.entry("nodes", nodes[i].mesh);
    if (seen[nodes[i].mesh]) document.refuse("node " + std::to_string(nodes[i].mesh) + " has several parents");
    seen[nodes[i].mesh] = true;
    const Affine3d world = nodes[i].world * transform_of(node);
    for (const json& child : document.list(node, "children")) nodes.push_back({child.get<std::uint64_t>(), world});
    if (!node.contains("mesh")) continue;
    const std::uint64_t mesh = document.number(node, "mesh");
    const json& primitives = document.list(document.entry("meshes", mesh), "primitives");
    posed = posed || node.contains("skin") ||
            std::any_of(primitives.begin(), primitives.end(), [](const json& p) { return p.contains("targets"); });
    for (const Affine3d& copy : copies_of(document, node)) placements.push_back({mesh, world * copy});
  }
  if (posed) raw.notes.push_back("animations, skins and morph targets are left out: the meshes are as without them");
  return placements;
}

/// Sends the points of all meshes, and adds their triangles.
SentRows send_meshes(const GltfDocument& document, ArraySender& to, RawCloud& raw) {
  const std::vector<Placement> placements = placements_of(document, raw);
  std::map<std::uint64_t, GltfMesh> meshes;
  MaterialNumbers materials(raw);
  double points = 0, triangles = 0;
  for (const Placement& placed : placements) {
    if (!meshes.contains(placed.mesh)) meshes[placed.mesh] = read_mesh(document, placed.mesh, materials);
    points += static_cast<double>(meshes[placed.mesh].points.size() / 4);
    triangles += static_cast<double>(meshes[placed.mesh].faces.triangle.size());
  }
  expect_from_file(raw.path, document.bytes, {points + triangles, "points and triangles", 32});
  if (points == 0) fail(ErrorKind::content, raw.path, ": holds no point; export the glTF again");
  SentRows rows = rows_of_doubles({"x", "y", "z", "label"}, static_cast<std::size_t>(points));
  if (raw.material_names.empty()) rows.columns.pop_back();
  auto* position = reinterpret_cast<double*>(to.take_array<char>(rows.rows * rows.stride));
  for (const auto& [index, world] : placements) {
    const GltfMesh& mesh = meshes[index];
    const auto first = static_cast<std::uint32_t>(raw.width);
    for (std::size_t i = 0; i < mesh.points.size(); i += 4) {
      const Eigen::Vector3d local(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]), p = world * local;
      raw.float_coordinates = raw.float_coordinates || local.cwiseAbs().maxCoeff() > 1000;
      *position++ = p.x(), *position++ = p.y(), *position++ = p.z(), *position++ = mesh.points[i + 3];
    }
    // A mirror turns triangles over; exchange corners so that their outside stays outside.
    const bool mirrored = world.linear().determinant() < 0;
    for (const auto& [a, b, c] : mesh.faces.triangle)
      raw.triangle.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
    raw.width += mesh.points.size() / 4;
    raw.triangles_in_file += mesh.faces.triangles_in_file, raw.bad_triangles += mesh.faces.bad_triangles;
  }
  return rows;
}

}  // namespace

RawCloud read_gltf(const std::string& path, const ReadOptions& options) {
  RawCloud raw;
  raw.path = path;
  raw.format = "glTF mesh";
  raw.meaning.y_up.value = true;
  raw.fields = {{"x", "float"}, {"y", "float"}, {"z", "float"}};
  read_rows_apart(raw, file_size_of(path), options, [](ArraySender& to, RawCloud& read) {
    try {
      return send_meshes(load_gltf(read.path), to, read);
    } catch (const json::exception& wrong) {
      fail(ErrorKind::content, read.path, ": its document has a value of another type (", wrong.what(),
           "); the file is damaged: copy or export it again");
    }
  });
  return raw;
}

}  // namespace insonify

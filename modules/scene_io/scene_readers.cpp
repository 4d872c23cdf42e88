// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/input_file.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/scene_readers_internal.hpp"
#include "tiles/tiled_scene.hpp"

namespace insonify {
namespace {

#ifdef INSONIFY_ASSIMP
constexpr auto read_by_assimp = read_assimp;
constexpr const char* without_assimp = "";
#else
constexpr RawCloud (*read_by_assimp)(const std::string&, const ReadOptions&) = nullptr;
constexpr const char* without_assimp = "export it as .glb, or build insonify with libassimp-dev";
#endif

}  // namespace

std::string surface_remedy(const std::string& extension) {
  const bool legacy = extension == ".vtk";
  return "save its surface as polydata first, by 'Extract Surface' of ParaView, or with the package python3-vtk9: "
         "/usr/bin/python3 -c \"from vtk import *; from sys import argv; r = " +
         std::string(legacy ? "vtkGenericDataObjectReader" : "vtkXMLGenericDataObjectReader") +
         "(); r.SetFileName(argv[1]); s = vtkGeometryFilter(); s.SetInputConnection(r.GetOutputPort()); "
         "w = vtkXMLPolyDataWriter(); w.SetInputConnection(s.GetOutputPort()); w.SetFileName(argv[2]); w.Write()\" in" +
         extension + " out.vtp";
}

const std::vector<SceneReader>& scene_readers() {
  static const std::vector<SceneReader> readers = {
      {{".pcd"}, {"# .PCD", "VERSION ", "FIELDS "}, "a PCD file", "PCL", "", read_pcd, find_pcd_rows},
      {{".ply"}, {"ply\n", "ply\r\n"}, "a PLY file", "insonify", "", read_ply, find_ply_rows},
      {{".obj"}, {}, "an OBJ file", "insonify", "", read_obj},
      {{".stl"}, {"solid "}, "an ASCII STL file", "insonify", "", read_stl},
      {{".vtk"}, {"# vtk DataFile"}, "a legacy VTK file", "VTK", "", read_vtk},
      {{".vtp"}, {"<VTKFile PolyData"}, "a VTK file of polydata", "VTK", "", read_vtk},
      {{".vtu", ".vts", ".vtr", ".vti"}, {"<VTKFile"}, "a VTK file that is no polydata", "", surface_remedy(".vtu")},
      {{".glb"}, {"glTF"}, "a binary glTF file", "insonify", "", read_gltf},
      {{".gltf"}, {}, "a glTF document", "insonify", "", read_gltf},
      {{".dae"}, {}, "a Collada document", "Assimp", without_assimp, read_by_assimp},
      {{".fbx"}, {"Kaydara FBX Binary", "; FBX "}, "an FBX file", "Assimp", without_assimp, read_by_assimp},
      {{".off"}, {"OFF"}, "an OFF file", "Assimp", without_assimp, read_by_assimp},
      {{".x3d"}, {}, "an X3D document", "Assimp", without_assimp, read_by_assimp},
      {{".3mf"}, {}, "a 3MF file", "Assimp", without_assimp, read_by_assimp},
      {{".wrl"}, {"#VRML"}, "a VRML file", "Assimp", without_assimp, read_by_assimp},
      {{".stp", ".step"}, {"ISO-10303-21"}, "a solid", "", "export its surface as .glb, .obj or .stl"},
      {{".xyz", ".txt", ".csv"}, {}, "text", "insonify", "", read_asc},
      {{".pts"}, {}, "points of a scanner as text", "insonify", "", read_text_cloud},
      {{".ptx"}, {}, "scans of a scanner as text", "insonify", "", read_ptx},
      {{".asc"}, {"ncols", "NCOLS"}, "text, or an ESRI ASCII grid", "GDAL", "", read_asc},
      {{".tif", ".tiff"}, {std::string("II*\0", 4), std::string("MM\0*", 4)}, "a TIFF file", "GDAL", "", read_raster},
      {{".bag"}, {}, "a BAG file", "GDAL", "", read_raster},
      {{".nc", ".grd"}, {"CDF"}, "a netCDF grid", "GDAL", "", read_raster},
      {{".tiles"}, {"\x89HDF\r\n\x1a\n"}, "an HDF5 file, if of insonify tiles", "HDF5", "", {}, {}, load_all_tiles},
      {{".las"}, {"LASF"}, "a LAS file", "insonify", "", read_las, find_las_rows},
      {{".laz"}, {}, "a LAZ file", "LASzip", laz_remedy, read_las, find_las_rows},
      {{".e57"},
       {"ASTM-E57"},
       "an E57 file",
       "",
       "make it .xyz first: docs/scene-files.md has the command (LAZ and E57)"},
  };
  return readers;
}

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

std::string vtk_tag(const std::string& head) {
  const std::size_t tag = head.find("<VTKFile");
  if (tag == head.npos) return {};
  return head.substr(tag, head.find('>', tag) - tag).find("PolyData") == head.npos ? "<VTKFile" : "<VTKFile PolyData";
}

std::string what_it_looks_like(const std::string& path) {
  std::string head = read_beginning(path, 512);
  if (const std::string tag = vtk_tag(head); !tag.empty()) head = tag;
  for (const SceneReader& reader : scene_readers())
    for (const std::string& magic : reader.magic)
      if (head.starts_with(magic)) {
        const auto& names = reader.extensions;
        if (std::find(names.begin(), names.end(), extension_of(path)) != names.end())
          return reader.name + ", as it should; copy or export it again";
        return reader.name + "; " + (reader.remedy.empty() ? "rename it to " + names[0] : reader.remedy);
      }
  return beginning_of(path);
}

std::string scene_extensions() {
  std::string all;
  for (const SceneReader& reader : scene_readers())
    for (const std::string& extension : reader.extensions)
      if (reader.remedy.empty()) all += (all.empty() ? "" : " ") + extension;
  return all;
}

std::vector<SceneFormat> scene_formats() {
  std::vector<SceneFormat> all;
  for (const SceneReader& reader : scene_readers())
    all.push_back({reader.extensions, reader.name, reader.package, reader.remedy});
  return all;
}

const SceneReader& reader_of(const std::string& path) {
  require_readable(path);
  const std::string extension = extension_of(path);
  for (const SceneReader& reader : scene_readers()) {
    if (std::count(reader.extensions.begin(), reader.extensions.end(), extension) == 0) continue;
    if (reader.remedy.empty()) return reader;
    fail(ErrorKind::content, path, ": is ", reader.name, ", which is not read; ", reader.remedy);
  }
  fail(ErrorKind::content, path, ": unknown extension '", extension, "', expected one of ", scene_extensions(),
       "; it looks like ", what_it_looks_like(path));
}

RawCloud read_cloud(const std::string& path, const ReadOptions& options) {
  const SceneReader& reader = reader_of(path);
  if (!reader.read) fail(ErrorKind::content, path, ": is ", reader.name, ", a prepared scene; give a cloud or mesh");
  return reader.read(path, options);
}

ReadOptions read_options(const LoadOptions& options) {
  ReadOptions reading{options.meaning, options.threads, options.material ? MaterialField{} : options.material_field};
  reading.keep_columns = options.keep_columns;
  return reading;
}

LoadedScene load_all_tiles(const std::string& path, const LoadOptions& options) {
  const TiledScene tiled(path);
  LoadedScene loaded{tiled.load(tiled.select_all(), 0, options.threads), {}};
  loaded.scene.part_of.reset();
  loaded.report.path = path;
  loaded.report.format = "insonify tiles";
  loaded.report.points_read = loaded.scene.size();
  loaded.report.materials_found = true;
  if (const std::string& system = tiled.info().system; !system.empty())
    loaded.report.meaning.system = {system, MeaningOrigin::file};
  loaded.columns.system = tiled.info().system;
  return loaded;
}

LoadedScene load_scene(const std::string& path, const LoadOptions& options) {
  check_options(options, "load_scene");
  const SceneReader& reader = reader_of(path);
  if (reader.load) return reader.load(path, options);
  return complete_scene(reader.read(path, read_options(options)), options);
}

}  // namespace insonify

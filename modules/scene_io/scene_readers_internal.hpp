// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/row_file_internal.hpp"

// Private to scene_io: which files a scene is read from. A new reader is one line in the table of scene_readers.cpp.
namespace insonify {

/// One kind of file.
struct SceneReader {
  std::vector<std::string> extensions;  ///< in lower case, with their dots; the first is the usual one
  std::vector<std::string> magic;       ///< possible first bytes of such files; empty: not known
  std::string name;                     ///< "a PLY file"
  std::string remedy;                   ///< for formats that are not read: how to convert them; else empty
  RawCloud (*read)(const std::string& path, const ReadOptions& options) = nullptr;
  std::optional<RowFile> (*find_rows)(const std::string& path) = nullptr;  ///< null: read as a whole only
  LoadedScene (*load)(const std::string& path,
                      const LoadOptions& options) = nullptr;  ///< of complete scenes, instead of read
};

const std::vector<SceneReader>& scene_readers();

/// How the surface of a VTK file that is no polydata becomes a .vtp; `extension` is that of the file.
std::string surface_remedy(const std::string& extension);
constexpr const char* laz_remedy = "make it .las first: docs/scene-files.md has the command (LAZ and E57)";

/// The reader of `path`, by its extension. Throws Error(file) if the file cannot be opened, Error(content) if it is
/// empty or its extension is none of scene_extensions().
const SceneReader& reader_of(const std::string& path);

/// Reads by the reader of `path`. Throws Error(content) for a complete scene too, which has no raw columns.
RawCloud read_cloud(const std::string& path, const ReadOptions& options);

/// A .tiles file as a whole.
LoadedScene load_all_tiles(const std::string& path, const LoadOptions& options);

/// Extension in lower case, with its dot.
std::string extension_of(const std::string& path);

/// The tag by which the first bytes tell a VTK file of XML: "<VTKFile PolyData", "<VTKFile" for another kind of data, or
/// nothing.
std::string vtk_tag(const std::string& head);

/// Guess of the format from the first bytes ("a PLY file; rename it to .ply", "text", "binary data", ...), for
/// messages.
std::string what_it_looks_like(const std::string& path);

}  // namespace insonify

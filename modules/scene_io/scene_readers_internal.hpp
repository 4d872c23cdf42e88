// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/row_file_internal.hpp"

// Private to scene_io: the kinds of files of a scene. A new reader is one line in the table of scene_readers.cpp.
namespace insonify {

/// A kind of file, and its readers.
struct SceneReader {
  std::vector<std::string> extensions;  ///< in lower case, with their dots; the first is the usual one
  std::vector<std::string> magic;       ///< possible first bytes of such files; empty: unknown
  std::string name;                     ///< "a PLY file"
  std::string package;                  ///< reader of such files; empty: none
  std::string remedy;                   ///< formats that are not read: command or way to convert them; else empty
  RawCloud (*read)(const std::string& path, const ReadOptions& options) = nullptr;
  std::optional<RowFile> (*find_rows)(const std::string& path) = nullptr;  ///< null: read as a whole only
  LoadedScene (*load)(const std::string& path,
                      const LoadOptions& options) = nullptr;  ///< reader of complete scenes, replaces read
};

const std::vector<SceneReader>& scene_readers();

/// Returns the remedy for a VTK file of this extension that is no polydata: to make its surface a .vtp.
std::string surface_remedy(const std::string& extension);
#ifdef INSONIFY_LASZIP
constexpr const char* laz_remedy = "";
#else
constexpr const char* laz_remedy =
    "make it .las first, or build insonify with liblaszip-dev: docs/scene-files.md has the commands (LAZ and E57)";
#endif

/// Returns the reader of `path` by its extension. Throws Error(file) if the file cannot be opened, Error(content) if it
/// is empty or its extension is none of scene_extensions().
const SceneReader& reader_of(const std::string& path);

/// Reads by the reader of `path`. Throws Error(content), too, for a complete scene, which has no raw columns.
RawCloud read_cloud(const std::string& path, const ReadOptions& options);

/// Returns the scene of a whole .tiles file.
LoadedScene load_all_tiles(const std::string& path, const LoadOptions& options);

/// Returns the extension of a path in lower case, with its dot.
std::string extension_of(const std::string& path);

/// Returns the tag in the first bytes of a VTK file of XML: "<VTKFile PolyData", "<VTKFile" for another kind of data;
/// empty for other files.
std::string vtk_tag(const std::string& head);

/// Returns a guess of the format from the first bytes ("a PLY file; rename it to .ply", "text", "binary data", ...),
/// for messages.
std::string what_it_looks_like(const std::string& path);

}  // namespace insonify

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/text_lines_internal.hpp"

namespace insonify {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void require_readable(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail(ErrorKind::file, path, ": no such file; check the path");
  if (std::filesystem::is_directory(status)) {
    fail(ErrorKind::file, path, ": is a folder, expected a cloud or mesh file; name a file in it");
  }
  if (!std::ifstream(path, std::ios::binary)) {
    fail(ErrorKind::file, path, ": cannot be opened for reading; check its permissions");
  }
  if (file_size_of(path) == 0) fail(ErrorKind::content, path, ": the file is empty (0 bytes); write or copy it again");
}

std::size_t file_size_of(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0 : static_cast<std::size_t>(size);
}

std::string read_whole_file(const std::string& path) { return read_beginning(path, file_size_of(path)); }

std::string read_beginning(const std::string& path, std::size_t count) {
  std::string bytes(std::min(count, file_size_of(path)), '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    fail(ErrorKind::file, path, ": reading failed after ", file.gcount(), " of ", bytes.size(),
         " bytes; check the disk and the permissions");
  }
  return bytes;
}

std::string what_it_looks_like(const std::string& path) {
  const std::string head = read_beginning(path, 512);
  const auto begins = [&](const char* magic) { return head.rfind(magic, 0) == 0; };
  if (begins("ply\n") || begins("ply\r\n")) return "a PLY file; rename it to .ply";
  if (begins("# .PCD") || begins("VERSION ") || begins("FIELDS ")) return "a PCD file; rename it to .pcd";
  if (begins("# vtk DataFile")) return "a legacy VTK file; rename it to .vtk";
  if (begins("<?xml") || begins("<VTKFile")) return "an XML file; a VTK polydata file is named .vtp";
  if (begins("LASF")) return "a LAS/LAZ file; convert it first: pdal translate in.las out.ply";
  if (begins("solid ")) return "an ASCII STL file; rename it to .stl";
  const bool text = std::all_of(head.begin(), head.end(),
                                [](unsigned char c) { return c >= 128 || std::isprint(c) || std::isspace(c); });
  if (!text) return "binary data";
  std::string_view line;
  LineReader(head).next_filled(line);
  return "text beginning with '" + shown(line) + "'";
}

RawCloud read_any(const std::string& path, const ReadOptions& options) {
  require_readable(path);
  const std::string extension = extension_of(path);
  if (extension == ".pcd") return read_pcd(path, options);
  if (extension == ".ply") return read_ply(path, options);
  if (extension == ".obj") return read_obj(path, options);
  if (extension == ".vtk" || extension == ".vtp" || extension == ".stl") return read_vtk(path, options);
  for (const char* text : {".xyz", ".txt", ".csv", ".asc"}) {
    if (extension == text) return read_text_cloud(path, options);
  }
  const char* las =
      extension == ".las" || extension == ".laz" || extension == ".e57" ? "; convert it first: pdal translate in" : "";
  fail(ErrorKind::content, path, ": unknown extension '", extension,
       "', expected .pcd .ply .obj .stl .vtk .vtp .xyz .txt .csv or .asc; it looks like ", what_it_looks_like(path),
       las, *las ? extension + " out.ply" : "");
}

}  // namespace insonify

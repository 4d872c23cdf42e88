// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

namespace insonify {

/// Extension in lower case, with its dot.
std::string extension_of(const std::string& path);

/// Throws Error(file) unless `path` is a file that can be opened; Error(content) if it is empty.
void require_readable(const std::string& path);

std::size_t file_size_of(const std::string& path);

/// The whole file. Throws Error(file) if it cannot be read.
std::string read_whole_file(const std::string& path);

/// First bytes of the file, at most `count`.
std::string read_beginning(const std::string& path, std::size_t count);

/// The tag by which the first bytes tell a VTK file of XML: "<VTKFile PolyData", "<VTKFile" for another kind of data, or
/// nothing.
std::string vtk_tag(const std::string& head);

/// Guess of the format from the first bytes ("a PLY file; rename it to .ply", "text", "binary data", ...), for
/// messages.
std::string what_it_looks_like(const std::string& path);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Extension in lower case, with its dot.
std::string extension_of(const std::string& path);

/// The tag by which the first bytes tell a VTK file of XML: "<VTKFile PolyData", "<VTKFile" for another kind of data, or
/// nothing.
std::string vtk_tag(const std::string& head);

/// Guess of the format from the first bytes ("a PLY file; rename it to .ply", "text", "binary data", ...), for
/// messages.
std::string what_it_looks_like(const std::string& path);

}  // namespace insonify

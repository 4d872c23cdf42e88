// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <type_traits>

#include <vtkSmartPointer.h>

namespace insonify {

/// Returns the data of a file by a reader of VTK.
template <typename Reader>
auto read_vtk(const std::string& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkSmartPointer<std::remove_pointer_t<decltype(reader->GetOutput())>>(reader->GetOutput());
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <vtkXMLPolyDataReader.h>

// Private to scene_io: checks that a VTK file holds what it announces. VTK allocates memory for whatever a file
// announces, and reads beyond it.
namespace insonify {

/// Throws Error(content) unless `path` is a legacy VTK file of DATASET POLYDATA, and every array holds the numbers, and
/// every cell the corners, that it announces.
void check_legacy_vtk(const std::string& path);

/// A reader of .vtp with two checks. It refuses arrays that a file of this size cannot hold before it allocates memory.
/// It refuses arrays that end before their announced number; VTK leaves uninitialised memory there.
class CheckedXmlReader : public vtkXMLPolyDataReader {
 public:
  static CheckedXmlReader* New();
  /// Defect of the file; empty: none.
  std::string problem;

 protected:
  int ReadPrimaryElement(vtkXMLDataElement* primary) override;
  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType at, vtkAbstractArray* array, vtkIdType first,
                      vtkIdType count, FieldType type) override;

 private:
  bool fits(vtkXMLDataElement* element, double rows, double most);
};

}  // namespace insonify

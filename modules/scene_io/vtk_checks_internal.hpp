// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <vtkXMLPolyDataReader.h>

// Private to scene_io: what a VTK file announces against what it holds. VTK takes memory for whatever a file announces,
// and reads beyond it.
namespace insonify {

/// Throws Error(content) unless `path` is a legacy VTK file of DATASET POLYDATA, and every array holds the numbers, and
/// every cell the corners, that it announces.
void check_legacy_vtk(const std::string& path);

/// A reader of .vtp that refuses what a file of this size cannot hold, before memory is taken for it, and arrays that
/// end before their announced number, which VTK leaves as the memory was.
class CheckedXmlReader : public vtkXMLPolyDataReader {
 public:
  static CheckedXmlReader* New();
  /// Empty, or what is wrong with the file.
  std::string problem;

 protected:
  int ReadPrimaryElement(vtkXMLDataElement* primary) override;
  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType at, vtkAbstractArray* array, vtkIdType first,
                      vtkIdType count, FieldType type) override;

 private:
  bool fits(vtkXMLDataElement* element, double rows, double most);
};

}  // namespace insonify

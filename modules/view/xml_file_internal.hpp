#pragma once
#include <string>
#include <vector>

#include <vtkFloatArray.h>
#include <vtkSmartPointer.h>

#include "view/save_vtk.hpp"

class vtkDataSet;
class vtkXMLWriter;

namespace insonify {

/// Writes a data set as a compressed VTK XML file, to a temporary name that is then renamed.
void write_xml(vtkXMLWriter& writer, vtkDataSet* data, const std::string& path, const char* who);

/// Lists the units of fields in the text array `units` of the field data; `places` is what coordinates are.
void list_units(vtkDataSet* data, const std::string& places, const std::vector<SampleField>& fields);

/// An array of cell data, with its unit as UNITS_LABEL if it has one.
vtkSmartPointer<vtkFloatArray> cell_array(const std::string& name, const float* values, std::size_t count,
                                          const std::string& unit = "");

}  // namespace insonify

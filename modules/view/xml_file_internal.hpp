// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkSmartPointer.h>

#include "view/off_screen_internal.hpp"
#include "view/save_vtk.hpp"

class vtkDataSet;
class vtkXMLWriter;

namespace insonify {

/// Writes a data set as a compressed VTK XML file, to a temporary name that is then renamed. `messages` must exist
/// since before `data` was made.
void write_xml(vtkXMLWriter& writer, vtkDataSet* data, const std::string& path, const VtkMessages& messages,
               const char* who);

/// A list of units, which becomes the text array `units` of the field data, "name: unit" each.
using UnitList = std::vector<std::string>;
void list_units(vtkDataSet* data, const UnitList& units);

/// Adds an array of one value per cell or point, with its unit as UNITS_LABEL and in the list if it has one.
template <typename Array, typename Values>
void add_array(vtkDataSetAttributes* data, const std::string& name, const Values& values, const std::string& unit,
               UnitList& units) {
  const auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->AddArray(array);
  if (unit.empty()) return;
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
  units.push_back(name + ": " + unit);
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>

#include "scene_io/file_probe_internal.hpp"
#include "scene_io/text_lines_internal.hpp"
#include "scene_io/vtk_checks_internal.hpp"

namespace insonify {
namespace {

// Numbers that a byte of a file can stand for: zlib packs at most 1032 bytes into one.
constexpr double unpacked_per_byte = 1032;

// A count among the attributes; 0 if absent.
double count_in(vtkXMLDataElement* element, const char* name) {
  double value = 0;
  const char* text = element->GetAttribute(name);
  return text && to_number(std::string_view(text), value) ? value : 0;
}

std::string name_of_array(vtkXMLDataElement* element) {
  const char* name = element->GetAttribute("Name");
  return name ? shown(name) : "without a name";
}

}  // namespace

vtkStandardNewMacro(CheckedXmlReader);

// Checks an element and those below it, whose arrays have up to `rows` rows.
bool CheckedXmlReader::fits(vtkXMLDataElement* element, double rows, double most) {
  for (const char* count : {"NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"}) {
    const double value = count_in(element, count);
    if (!(value >= 0 && value <= most)) {
      problem = std::string(count) + " = " + element->GetAttribute(count) + " is more than the file can hold";
      return false;
    }
    rows = std::max(rows, value);
  }
  const double components = element->GetAttribute("NumberOfComponents") ? count_in(element, "NumberOfComponents") : 1;
  if (!(components >= 1)) {
    problem = "array " + name_of_array(element) + " has no components";
    return false;
  }
  const double tuples = std::max(rows, count_in(element, "NumberOfTuples"));
  if (!(components * std::max(1.0, tuples) <= most)) {
    problem = "array " + name_of_array(element) + " announces more numbers than the file can hold";
    return false;
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
    if (!fits(element->GetNestedElement(i), rows, most)) return false;
  return true;
}

int CheckedXmlReader::ReadPrimaryElement(vtkXMLDataElement* primary) {
  const double most = unpacked_per_byte * static_cast<double>(file_size_of(this->GetFileName()));
  return fits(primary, 0, most) ? vtkXMLPolyDataReader::ReadPrimaryElement(primary) : 0;
}

int CheckedXmlReader::ReadArrayValues(vtkXMLDataElement* element, vtkIdType at, vtkAbstractArray* array,
                                      vtkIdType first, vtkIdType count, FieldType type) {
  const int whole = vtkXMLPolyDataReader::ReadArrayValues(element, at, array, first, count, type);
  if (!whole && problem.empty())
    problem = "array " + name_of_array(element) + " ends before the numbers that are announced";
  return whole;
}

}  // namespace insonify

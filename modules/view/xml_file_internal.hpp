#pragma once
#include <string>

class vtkDataSet;
class vtkXMLWriter;

namespace insonify {

/// Writes a data set as a compressed VTK XML file, to a temporary name that is then renamed.
void write_xml(vtkXMLWriter& writer, vtkDataSet* data, const std::string& path, const char* who);

}  // namespace insonify

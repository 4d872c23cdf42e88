#pragma once
#include <string>

#include <vtkDataSet.h>
#include <vtkXMLWriter.h>

#include "core/error.hpp"
#include "view/vtk_messages_internal.hpp"
#include "view/write_file_internal.hpp"

namespace insonify {

/// Writes a data set as a compressed VTK XML file, to a temporary name that is then renamed.
inline void write_xml(vtkXMLWriter& writer, vtkDataSet* data, const std::string& path, const char* who) {
  const VtkMessages messages;
  writer.SetInputData(data);
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.WriteToOutputStringOn();
  if (!writer.Write()) fail(ErrorKind::runtime, who, ": VTK cannot write ", path);
  messages.throw_first_error(who);
  const std::string bytes = writer.GetOutputString();
  write_file_atomically(path, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), who);
}

}  // namespace insonify

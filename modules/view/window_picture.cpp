#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include "core/error.hpp"
#include "view/window_picture_internal.hpp"
#include "view/write_file_internal.hpp"

namespace insonify {

void write_png(vtkPNGWriter* writer, const std::string& path, const VtkMessages& messages, const char* who) {
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (writer->GetErrorCode() != vtkErrorCode::NoError || !png || png->GetNumberOfTuples() == 0)
    fail(ErrorKind::file, who, ": cannot make the PNG for ", path, ": ",
         vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  messages.throw_first_error(who);
  write_file_atomically(path, png->GetPointer(0), static_cast<std::size_t>(png->GetNumberOfTuples()), who);
}

void save_window(vtkRenderWindow* window, const std::string& path, const VtkMessages& messages, const char* who) {
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->SetInputBufferTypeToRGB();
  picture->ReadFrontBufferOff();
  picture->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetCompressionLevel(3);
  write_png(writer, path, messages, who);
}

}  // namespace insonify

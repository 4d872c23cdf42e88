// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>

#include "core/error.hpp"
#include "core/library_turn.hpp"
#include "core/text_lines.hpp"
#include "files/input_file.hpp"
#include "scene_io/read_apart_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

// VTK allocates memory for everything that a file announces, and reads beyond its end: files are checked first.
namespace insonify {
namespace {

/// Collects the messages that VTK would print.
class VtkReadMessages : public vtkOutputWindow {
 public:
  static VtkReadMessages* New() { return new VtkReadMessages; }
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { add(errors, text); }
  void DisplayWarningText(const char* text) override { add(warnings, text); }
  /// VTK's legacy reader warns of missing numbers with a text that begins with Error.
  void DisplayGenericWarningText(const char* text) override {
    add(std::string_view(text).find("Error") == std::string_view::npos ? warnings : errors, text);
  }
  void DisplayDebugText(const char*) override {}
  std::vector<std::string> errors, warnings;

 private:
  /// Keeps the message alone of VTK's text "ERROR: In file.cxx, line n\nvtkX (0x..): message\n\n".
  void add(std::vector<std::string>& list, const char* text) {
    std::string message = text;
    message.erase(0, std::min(message.find('\n') + 1, message.size()));
    const std::size_t head = message.find("): ");
    if (head != message.npos) message.erase(0, head + 3);
    list.push_back(shown(message.substr(0, message.find('\n'))));
  }
};

/// Puts `messages` in the place of VTK's console and silences its log while it lives. Both exist once per process.
class QuietVtk {
 public:
  explicit QuietVtk(vtkOutputWindow* messages) : before_(vtkOutputWindow::GetInstance()) {
    vtkOutputWindow::SetInstance(messages);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~QuietVtk() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkOutputWindow::SetInstance(before_);
  }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

 private:
  VtkTurn turn_;
  vtkSmartPointer<vtkOutputWindow> before_;
  vtkLogger::Verbosity verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
};

// Largest number of bytes that zlib packs into one.
constexpr double unpacked_per_byte = 1032;

/// Returns a count among the attributes; 0 if absent.
double count_in(vtkXMLDataElement* element, const char* name) {
  double value = 0;
  const char* text = element->GetAttribute(name);
  return text && to_number(std::string_view(text), value) ? value : 0;
}

std::string name_of_array(vtkXMLDataElement* element) {
  const char* name = element->GetAttribute("Name");
  return name ? shown(name) : "without a name";
}

/// A reader of .vtp with two checks. It refuses arrays that a file of this size cannot hold before it allocates memory.
/// It refuses arrays with fewer numbers than announced, in which VTK leaves uninitialised memory.
class CheckedXmlReader : public vtkXMLPolyDataReader {
 public:
  static CheckedXmlReader* New() { VTK_STANDARD_NEW_BODY(CheckedXmlReader); }
  /// Defect of the file; empty: none.
  std::string problem;

 protected:
  int ReadPrimaryElement(vtkXMLDataElement* primary) override {
    check(primary, 0, unpacked_per_byte * static_cast<double>(file_size_of(this->GetFileName())));
    return problem.empty() ? vtkXMLPolyDataReader::ReadPrimaryElement(primary) : 0;
  }

  int ReadArrayValues(vtkXMLDataElement* element, vtkIdType at, vtkAbstractArray* array, vtkIdType first,
                      vtkIdType count, FieldType type) override {
    const int whole = vtkXMLPolyDataReader::ReadArrayValues(element, at, array, first, count, type);
    if (!whole) refuse("array " + name_of_array(element) + " ends before the numbers that are announced");
    return whole;
  }

 private:
  void refuse(const std::string& what) {
    if (problem.empty()) problem = what;
  }

  /// Checks an element and those below it, whose arrays have up to `rows` rows.
  void check(vtkXMLDataElement* element, double rows, double most) {
    for (const char* count : {"NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"}) {
      const double value = count_in(element, count);
      if (!(value >= 0 && value <= most))
        refuse(std::string(count) + " = " + element->GetAttribute(count) + " is more than the file can hold");
      rows = std::max(rows, value);
    }
    const double components = element->GetAttribute("NumberOfComponents") ? count_in(element, "NumberOfComponents") : 1;
    if (!(components >= 1)) refuse("array " + name_of_array(element) + " has no components");
    const double tuples = std::max(rows, count_in(element, "NumberOfTuples"));
    if (!(components * std::max(1.0, tuples) <= most))
      refuse("array " + name_of_array(element) + " announces more numbers than the file can hold");
    for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) check(element->GetNestedElement(i), rows, most);
  }
};

void check_xml(const std::string& path) {
  if (vtk_tag(read_beginning(path, 4096)) != "<VTKFile PolyData")
    fail(ErrorKind::content, path, ": not a VTK XML file of polydata: expected '<VTKFile type=\"PolyData\"', found ",
         what_it_looks_like(path));
}

/// Returns the data that VTK reads. Its messages go to its output window.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string& path) {
  const vtkNew<vtkPolyDataReader> legacy;
  const vtkNew<CheckedXmlReader> xml;
  const auto read = [&](auto& reader) {
    reader->SetFileName(path.c_str());
    reader->Update();
    return vtkSmartPointer<vtkPolyData>(reader->GetOutput());
  };
  const vtkSmartPointer<vtkPolyData> data = extension_of(path) == ".vtk" ? read(legacy) : read(xml);
  if (!xml->problem.empty())
    fail(ErrorKind::content, path, ": VTK cannot read it: ", xml->problem,
         "; the file is damaged or cut off: copy or export it again");
  return data;
}

/// Adds polygons and triangle strips as triangles.
void add_faces(vtkPolyData* data, RawCloud& raw) {
  if (!data->GetPolys()->IsValid() || !data->GetStrips()->IsValid())
    fail(ErrorKind::content, raw.path, ": its polygons begin and end at other places than its corners; the file is ",
         "damaged: copy or export it again");
  const std::size_t vertices = static_cast<std::size_t>(data->GetNumberOfPoints());
  std::vector<std::int64_t> corners;
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* polygons = data->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(count, ids);) {
    corners.assign(ids, ids + count);
    add_polygon(raw, corners, vertices);
  }
  vtkCellArray* strips = data->GetStrips();
  for (strips->InitTraversal(); strips->GetNextCell(count, ids);) {
    corners.assign(ids, ids + count);
    add_strip(raw, corners, vertices);
  }
}

/// Sends points, normals and point arrays of one component as rows of doubles.
SentRows send_rows(vtkPolyData* data, RawCloud& raw, ArraySender& to) {
  std::vector<vtkDataArray*> arrays = {data->GetPoints()->GetData()};
  std::vector<std::string> names = {"x", "y", "z"};
  for (const std::string& name : names) raw.fields.push_back({name, arrays[0]->GetDataTypeAsString()});
  if (vtkDataArray* normals = data->GetPointData()->GetNormals(); normals && normals->GetNumberOfComponents() == 3) {
    arrays.push_back(normals);
    for (const char* name : {"nx", "ny", "nz"}) {
      names.push_back(name);
      raw.fields.push_back({name, normals->GetDataTypeAsString()});
    }
  }
  for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data->GetPointData()->GetArray(a);
    if (!array || array->GetNumberOfComponents() != 1 || !array->GetName()) continue;
    arrays.push_back(array);
    names.push_back(array->GetName());
    raw.fields.push_back({array->GetName(), array->GetDataTypeAsString()});
  }
  const SentRows rows = rows_of_doubles(names, static_cast<std::size_t>(data->GetNumberOfPoints()));
  auto* out = reinterpret_cast<double*>(to.take_array<char>(rows.rows * rows.stride));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    for (vtkDataArray* array : arrays) {
      array->GetTuple(i, out);
      out += array->GetNumberOfComponents();
    }
  }
  return rows;
}

/// Reads a file that passed the checks of its format.
SentRows read_by_vtk(ArraySender& to, RawCloud& raw) {
  vtkNew<VtkReadMessages> messages;
  const QuietVtk quiet(messages);
  const vtkSmartPointer<vtkPolyData> data = read_polydata(raw.path);
  if (!messages->errors.empty())
    fail(ErrorKind::content, raw.path, ": VTK cannot read it: ", messages->errors.front(),
         "; the file is damaged or cut off: copy or export it again");
  for (const std::string& warning : messages->warnings) raw.notes.push_back("VTK: " + warning);
  if (!data || !data->GetPoints() || data->GetNumberOfPoints() == 0)
    fail(ErrorKind::content, raw.path, ": holds no point; export the ", raw.format, " again");
  raw.width = static_cast<std::size_t>(data->GetNumberOfPoints());
  raw.float_coordinates = data->GetPoints()->GetDataType() == VTK_FLOAT;
  add_faces(data, raw);
  if (!raw.triangle.empty() || raw.bad_triangles > 0) raw.format += " mesh";
  return send_rows(data, raw, to);
}

}  // namespace

RawCloud read_vtk(const std::string& path, const ReadOptions& options) {
  const std::string extension = extension_of(path);
  RawCloud raw;
  raw.path = path;
  raw.format = extension == ".vtk" ? "VTK legacy polydata" : "VTK XML polydata";
  extension == ".vtk" ? check_legacy_vtk(path) : check_xml(path);
  read_rows_apart(raw, file_size_of(path), options,
                  [](ArraySender& to, RawCloud& read) { return read_by_vtk(to, read); });
  return raw;
}

}  // namespace insonify

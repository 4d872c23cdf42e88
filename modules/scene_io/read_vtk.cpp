// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>

#include "core/error.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/read_apart_internal.hpp"
#include "scene_io/text_lines_internal.hpp"
#include "scene_io/vtk_checks_internal.hpp"
#include "scene_io/vtk_messages_internal.hpp"

namespace insonify {
namespace {

void check_xml(const std::string& path) {
  if (vtk_tag(read_beginning(path, 4096)) != "<VTKFile PolyData")
    fail(ErrorKind::content, path, ": not a VTK XML file of polydata: expected '<VTKFile type=\"PolyData\"', found ",
         what_it_looks_like(path));
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> output_of(Reader* reader, const std::string& path) {
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// What VTK reads; what it says goes to its output window.
vtkSmartPointer<vtkPolyData> read_polydata(const std::string& path, const std::string& extension) {
  if (extension == ".vtk") return output_of(vtkNew<vtkPolyDataReader>().Get(), path);
  const vtkNew<CheckedXmlReader> reader;
  const vtkSmartPointer<vtkPolyData> data = output_of(reader.Get(), path);
  if (!reader->problem.empty())
    fail(ErrorKind::content, path, ": VTK cannot read it: ", reader->problem,
         "; the file is damaged or cut off: copy or export it again");
  return data;
}

/// Polygons and triangle strips become triangles.
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

/// Points, normals and one-component point arrays as rows of doubles.
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
  const vtkSmartPointer<vtkPolyData> data = read_polydata(raw.path, extension_of(raw.path));
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
  read_rows_apart(raw, file_size_of(path), options, read_by_vtk);
  return raw;
}

}  // namespace insonify

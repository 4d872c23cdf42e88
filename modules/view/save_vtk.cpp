// SPDX-License-Identifier: BSD-3-Clause
#include "view/save_vtk.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <type_traits>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLWriter.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/pending_file.hpp"
#include "returns/sounding_columns.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/xml_file_internal.hpp"

namespace insonify {
void write_xml(vtkXMLWriter& writer, vtkDataSet* data, const std::string& path, const VtkMessages& messages,
               const char* who) {
  writer.SetInputData(data);
  writer.SetDataModeToAppended();
  writer.EncodeAppendedDataOff();
  writer.SetCompressorTypeToZLib();
  writer.WriteToOutputStringOn();
  if (!writer.Write()) fail(ErrorKind::runtime, who, ": VTK cannot write ", path);
  messages.throw_first_error(who);
  write_file(path, writer.GetOutputString());
}

void list_units(vtkDataSet* data, const UnitList& units) {
  vtkNew<vtkStringArray> array;
  array->SetName("units");
  for (const std::string& unit : units) array->InsertNextValue(unit);
  data->GetFieldData()->AddArray(array);
}
namespace {

void require_fields(const BeamFan& fan, const RangeGate& gate, const std::vector<SampleField>& fields,
                    const char* who) {
  require_valid(fan, who);
  require_valid(gate, who);
  if (fields.empty()) fail(ErrorKind::argument, who, ": no field to write");
  std::set<std::string> names;
  const auto beams = static_cast<Eigen::Index>(fan.beams()), bins = static_cast<Eigen::Index>(gate.bins());
  for (const SampleField& field : fields) {
    if (field.values.rows() != beams || field.values.cols() != bins)
      fail(ErrorKind::argument, who, ": field '", field.name, "' is ", field.values.rows(), " x ", field.values.cols(),
           ", must be beams x bins, ", beams, " x ", bins);
    if (!names.insert(field.name).second) fail(ErrorKind::argument, who, ": two fields are called '", field.name, "'");
  }
}

/// Returns the columns of an image that belong to one row of beams.
LevelImage part_of(const BeamFan& fan, const RangeGate& gate, const Grid<float>& values, const FanRow& row) {
  LevelImage part{{{}, {}, fan.beam_width, fan.elevation_width, 0}, gate, {}, {}};
  part.level_db.resize(static_cast<Eigen::Index>(row.beams.size()), values.cols());
  for (std::size_t b = 0; b < row.beams.size(); ++b) {
    part.fan.azimuth.push_back(fan.azimuth[row.beams[b]]);
    part.fan.elevation.push_back(row.elevation);
    part.level_db.row(static_cast<Eigen::Index>(b)) = values.row(static_cast<Eigen::Index>(row.beams[b]));
  }
  return part;
}

/// Returns the corners of the cells, ranges varying fastest, then bearings, then elevations.
vtkSmartPointer<vtkPoints> corners(const std::vector<double>& bearing_edges, const std::vector<double>& elevations,
                                   const RangeGate& gate, const Pose& world_from_head) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->Allocate(static_cast<vtkIdType>(elevations.size() * bearing_edges.size() * (gate.bins() + 1)));
  for (const double elevation : elevations)
    for (const double bearing : bearing_edges) {
      const Eigen::Vector3d direction = unit_vector({-bearing, elevation});
      for (std::size_t n = 0; n <= gate.bins(); ++n) {
        const double range = gate.min_range + static_cast<double>(n) * gate.bin_size;
        const Eigen::Vector3d corner = world_from_head * Eigen::Vector3d(range * direction);
        points->InsertNextPoint(corner.data());
      }
    }
  return points;
}

/// Returns the elevations between the cells of rows: halfway from row to row, and half a step beyond the outermost. A
/// single row has its own elevation.
std::vector<double> elevation_edges(const std::vector<FanRow>& rows) {
  if (rows.size() == 1) return {rows.front().elevation};
  std::vector<double> edges{1.5 * rows[0].elevation - 0.5 * rows[1].elevation};
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) edges.push_back(0.5 * (rows[r].elevation + rows[r + 1].elevation));
  edges.push_back(1.5 * rows.back().elevation - 0.5 * rows[rows.size() - 2].elevation);
  return edges;
}

/// Returns true if the beams of all rows have the same bearings, so that rows are the layers of a volume.
bool rows_are_alike(const BeamFan& fan, const std::vector<FanRow>& rows) {
  const auto bearing_of = [&](const FanRow& row, std::size_t b) { return fan.azimuth[row.beams[b]]; };
  for (const FanRow& row : rows) {
    if (row.beams.size() != rows.front().beams.size()) return false;
    for (std::size_t b = 0; b < row.beams.size(); ++b)
      if (bearing_of(row, b) != bearing_of(rows.front(), b)) return false;
  }
  return true;
}

/// Writes one grid of rows of the same bearings: a surface for one row, a volume for several.
void save_rows(const std::string& path, const BeamFan& fan, const RangeGate& gate,
               const std::vector<SampleField>& fields, const Pose& world_from_head, const std::vector<FanRow>& rows) {
  const VtkMessages messages;
  vtkNew<vtkStructuredGrid> grid;
  const std::vector<double> elevations = elevation_edges(rows);
  UnitList units{"Points: m"};
  for (const SampleField& field : fields) {
    std::vector<float> values;
    for (const FanRow& row : rows) {
      const BeamCells cells = order_beams(part_of(fan, gate, field.values, row));
      values.insert(values.end(), cells.level_db.data(), cells.level_db.data() + cells.level_db.size());
      if (grid->GetNumberOfPoints() > 0) continue;
      grid->SetDimensions(static_cast<int>(gate.bins()) + 1, static_cast<int>(cells.edges.size()),
                          static_cast<int>(elevations.size()));
      grid->SetPoints(corners(cells.edges, elevations, gate, world_from_head));
    }
    add_array<vtkFloatArray>(grid->GetCellData(), field.name, values, field.unit, units);
  }
  list_units(grid, units);
  grid->GetCellData()->SetActiveScalars(fields.front().name.c_str());
  vtkNew<vtkXMLStructuredGridWriter> writer;
  write_xml(*writer, grid, path, messages, "save_fan_grid");
}

void require_valid(const LineSet& lines) {
  for (std::size_t i = 0; i < lines.points.size(); ++i)
    if (lines.points[i].size() < 2)
      fail(ErrorKind::argument, "save_lines", ": line ", i, " has ", lines.points[i].size(),
           " points, must have at least 2");
  for (const LineSet::Field& field : lines.fields)
    if (field.values.size() != lines.points.size())
      fail(ErrorKind::argument, "save_lines", ": field '", field.name, "' has ", field.values.size(),
           " values, must have one per line (", lines.points.size(), ")");
}

}  // namespace

std::vector<std::string> save_fan_grid(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                                       const std::vector<SampleField>& fields, const Pose& world_from_head) {
  require_fields(fan, gate, fields, "save_fan_grid");
  const std::vector<FanRow> rows = fan_rows(fan);
  if (rows_are_alike(fan, rows)) {
    save_rows(path, fan, gate, fields, world_from_head, rows);
    return {path};
  }
  std::vector<std::string> files;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::filesystem::path file = path;
    file.replace_filename(file.stem().string() + printed("_row_%03zu.vts", r));
    save_rows(file.string(), fan, gate, fields, world_from_head, {rows[r]});
    files.push_back(file.string());
  }
  return files;
}

void save_sample_image(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                       const std::vector<SampleField>& fields) {
  require_fields(fan, gate, fields, "save_sample_image");
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(fan.beams()) + 1, static_cast<int>(gate.bins()) + 1, 1);
  image->SetOrigin(0, gate.min_range, 0);
  image->SetSpacing(1, gate.bin_size, 1);
  // Cells are ordered with beams varying fastest.
  UnitList units{"x: number of the beam, y: range in m"};
  for (const SampleField& field : fields)
    add_array<vtkFloatArray>(image->GetCellData(), field.name, field.values.reshaped(), field.unit, units);
  list_units(image, units);
  image->GetCellData()->SetActiveScalars(fields.front().name.c_str());
  vtkNew<vtkXMLImageDataWriter> writer;
  write_xml(*writer, image, path, messages, "save_sample_image");
}

void save_series(const std::string& path, const std::vector<SeriesEntry>& entries) {
  std::ostringstream text;
  text.precision(17);
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
       << "  <Collection>\n";
  for (const SeriesEntry& e : entries)
    text << "    <DataSet timestep=\"" << e.time << "\" part=\"" << e.part << "\" file=\""
         << std::filesystem::path(e.file).filename().string() << "\"/>\n";
  text << "  </Collection>\n</VTKFile>\n";
  write_file(path, text.str());
}

void save_lines(const std::string& path, const LineSet& lines) {
  require_valid(lines);
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> data = polylines(lines.points, VTK_DOUBLE);
  UnitList units;
  for (const LineSet::Field& field : lines.fields)
    add_array<vtkFloatArray>(data->GetCellData(), field.name, field.values, "", units);
  if (!lines.fields.empty()) data->GetCellData()->SetActiveScalars(lines.fields.front().name.c_str());
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, messages, "save_lines");
}

void save_points(const std::string& path, const Soundings& soundings, const std::vector<PointColumn>& more) {
  const auto count = static_cast<vtkIdType>(soundings.size());
  const auto require_length = [&](const std::string& name, std::size_t length) {
    if (length != soundings.size())
      fail(ErrorKind::argument, "save_points: ", path, ": column '", name, "' has ", length,
           " entries, must have one for each of the ", soundings.size(), " soundings");
  };
  const VtkMessages messages;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < count; ++i) {
    points->InsertNextPoint(soundings.position[static_cast<std::size_t>(i)].data());
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);

  UnitList units{"Points: m"};
  vtkPointData* columns = data->GetPointData();
  each_column(
      [&](const SoundingColumn& about, const auto& column) {
        require_length(about.name, column.size());
        using Real = std::is_same<typename std::decay_t<decltype(column)>::value_type, float>;
        using Array = std::conditional_t<Real::value, vtkFloatArray, vtkIntArray>;
        add_array<Array>(columns, about.name, column, signed_unit(about), units);
      },
      soundings);
  for (const PointColumn& column : more) {
    require_length(column.name, column.values.size());
    if (column.whole)
      add_array<vtkIntArray>(columns, column.name, column.values, column.unit, units);
    else
      add_array<vtkDoubleArray>(columns, column.name, column.values, column.unit, units);
  }
  columns->SetActiveScalars("level_db");
  list_units(data, units);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(*writer, data, path, messages, "save_points");
}

}  // namespace insonify

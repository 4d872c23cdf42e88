#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Polylines in space with scalar fields, as a structure of arrays.
struct LineSet {
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< of each line, world [m]
  struct Field {
    std::string name;
    std::vector<float> values;  ///< one per line
  };
  std::vector<Field> fields;
};

/// Writes lines as VTK polydata (.vtp), points in double, fields as cell data. Written to a temporary name, then
/// renamed. Throws Error(argument) for a line of fewer than two points or a field without exactly one value per line,
/// Error(file) if it cannot write.
void save_lines(const std::string& path, const LineSet& lines);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "scene/material_field.hpp"
#include "scene/scene_cloud.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/file_meaning.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/number_type_internal.hpp"
#include "tiles/scene_tags.hpp"

// Private to scene_io: output of the readers, input of complete_scene and describe_file.
namespace insonify {

/// Heights that usually mark holes, although their files do not say so [units of the file].
inline constexpr std::array<double, 3> usual_marks = {-9999, -32768, -99999};

/// Number of deviations above which a height is far from the middle 98 % of the others.
inline constexpr double far_deviations = 50;

/// The spread of the middle 98 % of the heights of a file [its units].
struct HeightSpread {
  double median = 0, deviation = 0, low = 0, high = 0;
};
/// Returns the spread of one height or more.
HeightSpread spread_of(std::vector<double> heights);

/// Facts about the coordinates of the usable points of a file [units of the file], before usual_marks are judged.
struct RawExtent {
  Bounds box;                                            ///< box without points whose height is one of usual_marks
  std::vector<double> heights;                           ///< heights of some of these points
  std::array<std::size_t, usual_marks.size()> marked{};  ///< number of points with each of usual_marks
  std::array<Bounds, usual_marks.size()> marked_box{};

  void add(const RawExtent& part);
};

/// A cloud or mesh as in its file, columns identified by name, before cleaning and completion. Absent columns are
/// empty.
struct RawCloud {
  std::string path, format;
  std::vector<FileDescription::Field> fields;
  std::size_t width = 0, height = 1;
  std::size_t points_in_file = 0;  ///< differs from point.size() for OBJ corners
  FileMeaning meaning;
  bool named_depth = false;  ///< true: the heights are called depths
  RawExtent extent;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Bounds box;                                        ///< box of the usable points, world [m]
  std::vector<Eigen::Vector3f> point;                ///< relative to origin [m]; all NaN if not finite, or withheld
  std::vector<Eigen::Vector3f> normal;
  std::vector<float> area;           ///< [m^2]
  std::vector<float> noise;          ///< [m]
  std::vector<std::uint16_t> label;  ///< no_label where the number is not an index, or in no interval
  std::string label_field;           ///< name of the field of the labels in the file
  std::vector<std::uint32_t> id;
  std::vector<double> extra;               ///< numbers of ReadOptions::extra_field, if the file has it
  std::vector<SceneColumn> columns;        ///< unused columns and that of the labels, with ReadOptions::keep_columns
  std::vector<std::string> other_columns;  ///< names of the unused columns
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<std::array<std::size_t, 2>>
      polygon;  ///< with more than three corners: first triangle, number of triangles
  std::vector<std::array<std::uint32_t, 3>> raster;   ///< triangles between the points, if they are a raster of heights
  std::vector<std::array<std::uint32_t, 3>> surface;  ///< triangles between the points of a height field
  std::vector<float> surface_height;  ///< z of the surface at each point [m]; empty: the points lie on the surface
  bool surface_normals = false;       ///< the surface has the normals of the points, not of its triangles
  std::string surface_name;           ///< description of the surface, for the report
  std::size_t triangles_in_file = 0, bad_triangles = 0;  ///< bad: polygons with bad indices
  std::size_t withheld = 0;                              ///< points that their file marks as not to be used
  std::size_t other_classes = 0;                         ///< points of classes that are not read
  std::size_t not_finite = 0;                            ///< points that are not finite, including too_far
  std::size_t too_far = 0;                               ///< points beyond farthest_coordinate
  std::size_t holes = 0;                                 ///< points whose height marks a hole
  bool float_coordinates = false;                        ///< true: stored as float32
  std::optional<Eigen::Vector3d> viewpoint;              ///< place from which all points were seen [m]
  std::vector<Eigen::Vector3d> stations;                 ///< places of the scanners of a cloud of several scans [m]
  std::vector<std::uint16_t> station;                    ///< index into `stations` of each point
  bool heights = false;       ///< points of a raster: seen from above unless a viewpoint is known
  bool only_surfels = false;  ///< no surface is wanted between the points of a height field
  SceneTags tags;
  std::vector<std::string> material_names;  ///< names of the materials of a mesh, by label
  std::vector<std::string> notes;

  /// Returns the position from which point i was seen [m], if it is known.
  std::optional<Eigen::Vector3d> seen_from(std::size_t i) const {
    return stations.empty() ? viewpoint : std::optional(stations[station[i]]);
  }
  std::size_t unused() const { return withheld + other_classes + not_finite + holes; }  ///< number of points
};

/// Labels for the names of the materials of a mesh: one for each name, from 0 in the order in which they are asked for.
class MaterialNumbers {
 public:
  explicit MaterialNumbers(RawCloud& raw) : raw_(raw) {}

  std::size_t of(const std::string& name) {
    const auto [entry, is_new] = known_.try_emplace(name, raw_.material_names.size());
    if (is_new) raw_.material_names.push_back(name);
    return entry->second;
  }

 private:
  RawCloud& raw_;
  std::unordered_map<std::string, std::size_t> known_;
};

constexpr std::uint16_t no_label = 65535;
constexpr std::size_t most_stations = 65535;
constexpr double farthest_coordinate = 1e9;  ///< [m]; larger coordinates mean "no data"

/// The bits of a row that withhold it, and its class. In a file without these, the bits are 0.
struct RowMarks {
  std::size_t withheld_at = 0, class_at = 0;  ///< offsets of their bytes within a row
  std::uint8_t withheld_bit = 0, class_bits = 0;

  bool withheld(const char* row) const { return (static_cast<unsigned char>(row[withheld_at]) & withheld_bit) != 0; }
  bool left_out(const char* row, const PointClasses& kept) const {
    return class_bits != 0 && !kept[static_cast<unsigned char>(row[class_at]) & class_bits];
  }
};

/// A table of packed rows in memory, or in a file that is read in blocks.
struct RowTable {
  struct Column {
    std::string name;
    NumberType type = NumberType::float64;
    std::size_t offset = 0;       ///< offset within a row [bytes]
    double scale = 1, shift = 0;  ///< the value is scale x number + shift
    std::uint8_t mask = 0xff;     ///< bits of a uint8 that are used

    double value(const char* row) const {
      if (mask != 0xff) return row[offset] & mask;
      return scale * read_number(row + offset, type) + shift;
    }
  };
  std::vector<Column> columns;
  std::size_t rows = 0, stride = 0;
  const char* bytes = nullptr;        ///< null: `read` returns the rows
  std::shared_ptr<const void> owner;  ///< owner of the bytes, unless they outlive the table
  RowMarks marks{};
  std::function<std::vector<char>(std::size_t first, std::size_t count)> read{};  ///< may be called by several threads

  /// Calls use(row) with the bytes of `count` rows from `first` on.
  template <typename Use>
  void with_rows(std::size_t first, std::size_t count, const Use& use) const {
    if (bytes) return use(bytes + first * stride);
    const std::vector<char> block = read(first, count);
    use(block.data());
  }
};

/// Returns the column of this name; null if there is none.
const RowTable::Column* column_named(const std::vector<RowTable::Column>& columns, const std::string& name);

/// Returns a table of doubles in row-major order, one column per name.
RowTable table_of_doubles(const std::vector<std::string>& names, std::vector<double> numbers);

struct ReadOptions {
  MeaningOverride meaning{};
  int threads = 0;
  MaterialField material_field{};  ///< source of the labels
  std::string extra_field{};       ///< a column that is read unchanged; empty: none
  bool keep_columns = false;
  std::optional<Eigen::Vector3d>
      origin{};  ///< origin of the whole cloud [m], if this is a batch of it, whose meaning is known; a batch may hold
                 ///< no usable point
};

/// Returns ReadOptions for `options`; labels are not read if all surfels get one material.
ReadOptions read_options(const LoadOptions& options);

/// Fills point, normal, area, label, id, box and origin of `raw` from the table's columns, identified by name, makes
/// the names of its materials a table, and moves its viewpoint from the axes of the file to the world. The meaning of the numbers is raw.meaning, completed by
/// the options and resolve_meaning. Throws Error(content) if x, y, z or the requested material field is missing, or no
/// point is finite.
void fill_cloud(RawCloud& raw, const RowTable& table, const ReadOptions& options);

/// Extends the extent of `whole` by that of `part`, and adds the counts of unused points.
void add_counts(RawCloud& whole, const RawCloud& part);

/// Decides from the extent which of usual_marks are holes, and whether heights called depths count downwards; sets the
/// box. Triangles have no holes.
void resolve_meaning(RawCloud& raw);

/// Throws Error(content) with the reason if none of the file's points is usable.
void require_usable_points(const RawCloud& raw, std::size_t points);

/// Returns the origin of a cloud [m]: the one in its tags, else the centre of the box in whole metres.
Eigen::Vector3d origin_of(const RawCloud& raw);

/// Returns the coordinates of the rows in double [m], relative to raw.origin; NaN where unusable.
std::vector<Eigen::Vector3d> read_positions(const RawCloud& raw, const RowTable& table, const ReadOptions& options);

/// Appends a polygon as a fan of triangles; counts it as bad if a corner is not in [0, vertices).
void add_polygon(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices);
/// Appends a strip of triangles, whose sides alternate. A corner of -1 ends a strip. A triangle that has a corner twice
/// joins two strips, and is left out.
void add_strip(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices);

/// Replaces the fans of polygons that are not convex by triangles that cover the polygon. Notes polygons whose edges
/// cross, which keep their fan, and polygons with a corner off their plane by more than 1 % of their size. Throws
/// Error(content) if a polygon takes too long.
void cut_polygons(RawCloud& raw);

RawCloud read_pcd(const std::string& path, const ReadOptions& options);
RawCloud read_ply(const std::string& path, const ReadOptions& options);
RawCloud read_obj(const std::string& path, const ReadOptions& options);
RawCloud read_text_cloud(const std::string& path, const ReadOptions& options);
RawCloud read_ptx(const std::string& path, const ReadOptions& options);
RawCloud read_gltf(const std::string& path, const ReadOptions& options);
RawCloud read_assimp(const std::string& path, const ReadOptions& options);  ///< .dae, .fbx, .off, .x3d, .wrl, .3mf
/// Returns the X3D of a VRML file, in which nodes and fields have the same names. Throws Error(content) with the line for
/// text that is no VRML 2.0, or that defines nodes of its own or refers to other files.
std::string vrml_as_x3d(const std::string& path);
/// Returns X3D in which no group is empty or the USE of another, which Assimp misplaces. Each shape stands in a group whose
/// name is `x3d_material` and the name of its material. Throws Error(content) if the text refers to other files, holds zero
/// bytes or more than 500 elements within each other, or grows by more than 64 MiB for copies of groups.
std::string x3d_for_assimp(const std::string& path, std::string_view text);
inline constexpr std::string_view x3d_material = "material of shape: ";
RawCloud read_las(const std::string& path, const ReadOptions& options);
RawCloud read_raster(const std::string& path, const ReadOptions& options);  ///< heights, by GDAL
/// Throws Error(content) for a classic netCDF file that ends before its variables do; other files pass.
void check_netcdf(const std::string& path);
RawCloud read_asc(const std::string& path, const ReadOptions& options);  ///< text, or an ESRI ASCII grid
RawCloud read_stl(const std::string& path, const ReadOptions& options);
/// Throws Error(content) unless `path` is a legacy VTK file of DATASET POLYDATA, and every array holds the numbers, and
/// every cell the corners, that it announces.
void check_legacy_vtk(const std::string& path);
RawCloud read_vtk(const std::string& path, const ReadOptions& options);  ///< .vtk, .vtp

}  // namespace insonify

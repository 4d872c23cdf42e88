#include "store/hdf5_internal.hpp"

#include <algorithm>
#include <filesystem>

#include "core/input_file.hpp"

namespace insonify::hdf5 {
namespace {

// H5Ewalk visits the innermost function first, which reports the cause.
herr_t take_first_reason(unsigned n, const H5E_error2_t* error, void* reason) {
  if (n == 0 && error->desc) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

// What the system said, if HDF5 quotes it among addresses and sizes of its own, else all of one line.
std::string plain_reason(const std::string& reason) {
  const std::string quote = "error message = '";
  const std::size_t begin = reason.find(quote);
  if (begin == std::string::npos) return reason.substr(0, reason.find('\n'));
  const std::size_t text = begin + quote.size();
  return reason.substr(text, reason.find('\'', text) - text);
}

void write_scalar(const Place& place, hid_t where, const char* name, hid_t file_type, hid_t memory_type,
                  const void* value) {
  const std::string what = std::string("attribute '") + name + "' cannot be written";
  const Handle space(place.checked(H5Screate(H5S_SCALAR), what), H5Sclose);
  const Handle attribute(place.checked(H5Acreate2(where, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), what),
                         H5Aclose);
  place.checked(H5Awrite(attribute, memory_type, value), what);
}

Handle open_attribute(const Place& place, hid_t where, const char* name) {
  if (H5Aexists(where, name) <= 0) fail(place.kind, place.path, ": attribute '", name, "' is missing");
  Handle attribute(place.checked(H5Aopen(where, name, H5P_DEFAULT), std::string("attribute '") + name + "'"), H5Aclose);
  const Handle space(place.checked(H5Aget_space(attribute), name), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1)
    fail(place.kind, place.path, ": attribute '", name, "' must hold one value");
  return attribute;
}

template <typename T>
T read_scalar(const Place& place, hid_t where, const char* name, hid_t memory_type) {
  const Handle attribute = open_attribute(place, where, name);
  T value{};
  place.checked(H5Aread(attribute, memory_type, &value), std::string("attribute '") + name + "' is not a number");
  return value;
}

}  // namespace

QuietErrors::QuietErrors() {
  // A file that could not be written to its end stays open within HDF5, which would crash when the program ends.
  static const herr_t no_exit_handler = H5dont_atexit();
  static_cast<void>(no_exit_handler);
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

void Place::fail_here(const std::string& what) const {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first_reason, &reason);
  fail(kind, path, ": ", what, reason.empty() ? "" : ": ", plain_reason(reason));
}

Handle text_type(const Place& place, std::size_t length) {
  Handle type(place.checked(H5Tcopy(H5T_C_S1), "text type"), H5Tclose);
  place.checked(H5Tset_size(type, length), "text type");
  place.checked(H5Tset_cset(type, H5T_CSET_UTF8), "text type");
  return type;
}

Handle complex_type(const Place& place, hid_t real_type) {
  const std::size_t size = H5Tget_size(real_type);
  Handle type(place.checked(H5Tcreate(H5T_COMPOUND, 2 * size), "complex type"), H5Tclose);
  place.checked(H5Tinsert(type, "r", 0, real_type), "complex type");
  place.checked(H5Tinsert(type, "i", size, real_type), "complex type");
  return type;
}

Extent extent_of(const Place& place, hid_t dataset, const std::string& name, std::size_t rank) {
  const Handle space(place.checked(H5Dget_space(dataset), name), H5Sclose);
  const int dimensions = place.checked(H5Sget_simple_extent_ndims(space), name);
  if (static_cast<std::size_t>(dimensions) != rank)
    fail(place.kind, place.path, ": ", name, " has ", dimensions, " dimensions, must have ", rank);
  Extent extent(rank);
  place.checked(H5Sget_simple_extent_dims(space, extent.data(), nullptr), name);
  return extent;
}

Handle select_row(const Place& place, hid_t dataset, const Extent& extent, hsize_t first) {
  Handle space(place.checked(H5Dget_space(dataset), "selection"), H5Sclose);
  Extent start(extent.size(), 0), count = extent;
  start[0] = first, count[0] = 1;
  place.checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "selection");
  return space;
}

void write_attribute(const Place& place, hid_t where, const char* name, double value) {
  write_scalar(place, where, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void write_attribute(const Place& place, hid_t where, const char* name, std::int64_t value) {
  write_scalar(place, where, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void write_attribute(const Place& place, hid_t where, const char* name, std::uint64_t value) {
  write_scalar(place, where, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &value);
}

void write_attribute(const Place& place, hid_t where, const char* name, const std::string& value) {
  const Handle type = text_type(place);
  const char* text = value.c_str();
  write_scalar(place, where, name, type, type, &text);
}

double read_number(const Place& place, hid_t where, const char* name) {
  return read_scalar<double>(place, where, name, H5T_NATIVE_DOUBLE);
}

std::int64_t read_integer(const Place& place, hid_t where, const char* name) {
  return read_scalar<std::int64_t>(place, where, name, H5T_NATIVE_INT64);
}

std::uint64_t read_unsigned(const Place& place, hid_t where, const char* name) {
  return read_scalar<std::uint64_t>(place, where, name, H5T_NATIVE_UINT64);
}

// Reads text of fixed length (as other programs write it) or of variable length.
std::string read_text(const Place& place, hid_t where, const char* name) {
  const Handle attribute = open_attribute(place, where, name);
  const Handle stored(place.checked(H5Aget_type(attribute), name), H5Tclose);
  if (H5Tget_class(stored) != H5T_STRING) fail(place.kind, place.path, ": attribute '", name, "' must be text");
  if (H5Tis_variable_str(stored) <= 0) {
    std::string text(H5Tget_size(stored), '\0');
    place.checked(H5Aread(attribute, stored, text.data()), name);
    return text.substr(0, text.find('\0'));
  }
  const Handle type = text_type(place);
  char* text = nullptr;
  place.checked(H5Aread(attribute, type, &text), name);
  const std::string result = text ? text : "";
  H5free_memory(text);
  return result;
}

Handle create_file(const Place& place, const std::string& name) {
  const Handle properties(place.checked(H5Pcreate(H5P_FILE_CREATE), "file"), H5Pclose);
  place.checked(H5Pset_obj_track_times(properties, false), "file");  // same input, same bytes
  return {place.checked(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT), "cannot be written"),
          H5Fclose};
}

Handle open_file(const Place& place) {
  require_regular_file(place.path);
  const htri_t is_hdf5 = H5Fis_hdf5(place.path.c_str());
  if (is_hdf5 < 0) fail(ErrorKind::file, place.path, ": cannot be read");
  if (is_hdf5 == 0) fail(place.kind, place.path, ": is not an HDF5 file");
  return {place.checked(H5Fopen(place.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "is damaged or cut short"), H5Fclose};
}

Handle create_dataset(const Place& place, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
                      const Extent& chunk, Packing packing) {
  const Handle space(
      place.checked(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), name.path), H5Sclose);
  const Handle properties(place.checked(H5Pcreate(H5P_DATASET_CREATE), name.path), H5Pclose);
  place.checked(H5Pset_obj_track_times(properties, false), name.path);
  if (!chunk.empty()) {
    place.checked(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), name.path);
    place.checked(H5Pset_fill_time(properties, H5D_FILL_TIME_ALLOC),
                  name.path);  // no undefined bytes in edge chunks
    if (packing == Packing::deflate) {
      place.checked(H5Pset_shuffle(properties), name.path);
      place.checked(H5Pset_deflate(properties, 1), name.path);
    }
  }
  Handle dataset(
      place.checked(H5Dcreate2(file, name.path, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), name.path),
      H5Dclose);
  if (*name.unit) write_attribute(place, dataset, "units", std::string(name.unit));
  return dataset;
}

Handle create_ordered_group(const Place& place, hid_t file, const char* name) {
  const Handle properties(place.checked(H5Pcreate(H5P_GROUP_CREATE), name), H5Pclose);
  place.checked(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), name);
  place.checked(H5Pset_obj_track_times(properties, false), name);
  return {place.checked(H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), name), H5Gclose};
}

std::vector<std::string> names_in(const Place& place, hid_t file, const char* group) {
  std::vector<std::string> names;
  if (H5Lexists(file, group, H5P_DEFAULT) <= 0) return names;
  const Handle opened(place.checked(H5Gopen2(file, group, H5P_DEFAULT), group), H5Gclose);
  const auto note = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  place.checked(H5Literate(opened, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, note, &names), group);
  return names;
}

namespace {

/// Refuses a dataset whose numbers lie in files that the user did not name: a cube from a stranger must not show others of
/// the user's files. Blocks of a survey beside the cube are its own.
void require_own_data(const Place& place, hid_t file, const DatasetName& name, hid_t dataset) {
  const auto refuse = [&](const char* what) {
    fail(place.kind, place.path, ": dataset ", name.path, " ", what,
         ", which is not read; get the file that holds the data itself");
  };
  H5L_info_t link;
  if (H5Lget_info(file, name.path, &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
    refuse("is a link to elsewhere");
  const Handle properties(place.checked(H5Dget_create_plist(dataset), name.path), H5Pclose);
  if (H5Pget_external_count(properties) > 0) refuse("is stored in another file");
  if (H5Pget_layout(properties) != H5D_VIRTUAL) return;
  std::size_t sources = 0;
  place.checked(H5Pget_virtual_count(properties, &sources), name.path);
  for (std::size_t i = 0; i < sources; ++i) {
    std::string source(
        static_cast<std::size_t>(std::max<ssize_t>(0, H5Pget_virtual_filename(properties, i, nullptr, 0))) + 1, '\0');
    H5Pget_virtual_filename(properties, i, source.data(), source.size());
    source.pop_back();
    const std::filesystem::path relative = std::filesystem::path(source).lexically_normal();
    if (relative.is_absolute() || (!relative.empty() && *relative.begin() == ".."))
      refuse("is stored outside its folder");
  }
}

}  // namespace

Handle open_dataset(const Place& place, hid_t file, const DatasetName& name) {
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0)
    fail(place.kind, place.path, ": dataset ", name.path, " is missing");
  Handle dataset{place.checked(H5Dopen2(file, name.path, H5P_DEFAULT), name.path), H5Dclose};
  require_own_data(place, file, name, dataset);
  return dataset;
}

}  // namespace insonify::hdf5

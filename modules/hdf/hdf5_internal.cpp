// SPDX-License-Identifier: BSD-3-Clause
#include "hdf/hdf5_internal.hpp"

#include <algorithm>

namespace insonify::hdf5 {
namespace {

// H5Ewalk visits the innermost function first, which reports the cause.
herr_t take_first_reason(unsigned n, const H5E_error2_t* error, void* reason) {
  if (n == 0 && error->desc) *static_cast<std::string*>(reason) = error->desc;
  return 0;
}

// Returns the system's error if HDF5 quotes one among addresses and sizes, otherwise the whole reason as one line.
std::string plain_reason(const std::string& reason) {
  const std::string quote = "error message = '";
  const std::size_t begin = reason.find(quote);
  if (begin == std::string::npos) return reason.substr(0, reason.find('\n'));
  const std::size_t text = begin + quote.size();
  return reason.substr(text, reason.find('\'', text) - text);
}

std::string reported_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first_reason, &reason);
  return plain_reason(reason);
}

Handle open_attribute(const FileContext& context, hid_t where, const char* name, hssize_t values = 1) {
  if (H5Aexists(where, name) <= 0) fail(context.kind, context.path, ": attribute '", name, "' is missing");
  Handle attribute(context.checked(H5Aopen(where, name, H5P_DEFAULT), std::string("attribute '") + name + "'"),
                   H5Aclose);
  const Handle space(context.checked(H5Aget_space(attribute), name), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != values)
    fail(context.kind, context.path, ": attribute '", name, "' must hold ", values, values == 1 ? " value" : " values");
  return attribute;
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

void FileContext::fail_here(const std::string& what) const {
  const std::string reason = reported_reason();
  fail(kind, path, ": ", what, reason.empty() ? "" : ": ", reason, kind == ErrorKind::content ? copy_again : "");
}

void note_failed_close() {
  if (failed_to_close.empty()) failed_to_close = reported_reason();
  if (failed_to_close.empty()) failed_to_close = "it cannot be closed";
}

Handle text_type(const FileContext& context, std::size_t length) {
  Handle type(context.checked(H5Tcopy(H5T_C_S1), "text type"), H5Tclose);
  context.checked(H5Tset_size(type, length), "text type");
  context.checked(H5Tset_cset(type, H5T_CSET_UTF8), "text type");
  return type;
}

Handle complex_type(const FileContext& context, hid_t real_type) {
  const std::size_t size = H5Tget_size(real_type);
  Handle type(context.checked(H5Tcreate(H5T_COMPOUND, 2 * size), "complex type"), H5Tclose);
  context.checked(H5Tinsert(type, "r", 0, real_type), "complex type");
  context.checked(H5Tinsert(type, "i", size, real_type), "complex type");
  return type;
}

Extent extent_of(const FileContext& context, hid_t dataset, const std::string& name) {
  const Handle space(context.checked(H5Dget_space(dataset), name), H5Sclose);
  Extent extent(static_cast<std::size_t>(context.checked(H5Sget_simple_extent_ndims(space), name)));
  context.checked(H5Sget_simple_extent_dims(space, extent.data(), nullptr), name);
  return extent;
}

Extent extent_of(const FileContext& context, hid_t dataset, const std::string& name, std::size_t rank) {
  const Extent extent = extent_of(context, dataset, name);
  if (extent.size() != rank)
    fail(context.kind, context.path, ": ", name, " has ", extent.size(), " dimensions, must have ", rank);
  return extent;
}

Handle space_of(const FileContext& context, const Extent& whole) {
  return {context.checked(H5Screate_simple(static_cast<int>(whole.size()), whole.data(), nullptr), "space"), H5Sclose};
}

Handle block_of(const FileContext& context, const Extent& whole, const Extent& start, const Extent& count) {
  Handle space = space_of(context, whole);
  context.checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
                  "selection");
  return space;
}

void write_values(const FileContext& context, hid_t where, const char* name, hid_t space, hid_t in_file,
                  hid_t in_memory, const void* values) {
  const std::string what = std::string("attribute '") + name + "' cannot be written";
  const Handle attribute(context.checked(H5Acreate2(where, name, in_file, space, H5P_DEFAULT, H5P_DEFAULT), what),
                         H5Aclose);
  context.checked(H5Awrite(attribute, in_memory, values), what);
}

void write_attribute(const FileContext& context, hid_t where, const char* name, const std::string& value) {
  const Handle type = text_type(context), space(context.checked(H5Screate(H5S_SCALAR), name), H5Sclose);
  const char* text = value.c_str();
  write_values(context, where, name, space, type, type, &text);
}

void write_attribute(const FileContext& context, hid_t where, const char* name, std::span<const double> values) {
  write_values(context, where, name, space_of(context, {values.size()}), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
               values.data());
}

void read_numbers(const FileContext& context, hid_t where, const char* name, hid_t in_memory, std::size_t count,
                  void* to) {
  const Handle attribute = open_attribute(context, where, name, static_cast<hssize_t>(count));
  context.checked(H5Aread(attribute, in_memory, to),
                  std::string("attribute '") + name + (count == 1 ? "' is not a number" : "' is not numbers"));
}

// Reads text of fixed length (as other programs write it) or of variable length.
std::string read_text(const FileContext& context, hid_t where, const char* name) {
  const Handle attribute = open_attribute(context, where, name);
  const Handle stored(context.checked(H5Aget_type(attribute), name), H5Tclose);
  if (H5Tget_class(stored) != H5T_STRING) fail(context.kind, context.path, ": attribute '", name, "' must be text");
  if (H5Tis_variable_str(stored) <= 0) {
    std::string text(H5Tget_size(stored), '\0');
    context.checked(H5Aread(attribute, stored, text.data()), name);
    return text.substr(0, text.find('\0'));
  }
  char* characters = nullptr;
  context.checked(H5Aread(attribute, stored, &characters), name);
  const std::string text = characters ? characters : "";
  H5free_memory(characters);
  return text;
}

Handle create_file(const FileContext& context, const std::string& name) {
  const Handle properties(context.checked(H5Pcreate(H5P_FILE_CREATE), "file"), H5Pclose);
  context.checked(H5Pset_obj_track_times(properties, false), "file");  // same input, same bytes
  return {context.checked(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT), "cannot be written"),
          H5Fclose};
}

namespace {

/// Creates a dataset without timestamps, whose other properties `set` sets, with its unit and name.
template <typename Set>
Handle create(const FileContext& context, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
              const Set& set) {
  const Handle space = space_of(context, extent);
  const Handle properties(context.checked(H5Pcreate(H5P_DATASET_CREATE), name.path), H5Pclose);
  context.checked(H5Pset_obj_track_times(properties, false), name.path);
  set(properties);
  Handle dataset(
      context.checked(H5Dcreate2(file, name.path, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), name.path),
      H5Dclose);
  if (*name.unit) write_attribute(context, dataset, "units", std::string(name.unit));
  if (*name.about) write_attribute(context, dataset, "long_name", std::string(name.about));
  return dataset;
}

}  // namespace

Handle create_dataset(const FileContext& context, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
                      const Extent& chunk, Packing packing) {
  return create(context, file, name, type, extent, [&](hid_t properties) {
    if (chunk.empty()) return;
    context.checked(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), name.path);
    context.checked(H5Pset_fill_time(properties, H5D_FILL_TIME_ALLOC),
                    name.path);  // no undefined bytes in edge chunks
    if (packing == Packing::none) return;
    context.checked(H5Pset_shuffle(properties), name.path);
    context.checked(H5Pset_deflate(properties, 1), name.path);
  });
}

std::uint64_t create_plain(const FileContext& context, hid_t file, const DatasetName& name, hid_t type,
                           const Extent& extent) {
  const Handle dataset = create(context, file, name, type, extent, [&](hid_t properties) {
    context.checked(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY), name.path);
    context.checked(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER), name.path);
  });
  const haddr_t offset = H5Dget_offset(dataset);
  return offset == HADDR_UNDEF ? 0 : offset;
}

Handle create_ordered_group(const FileContext& context, hid_t file, const char* name) {
  const Handle properties(context.checked(H5Pcreate(H5P_GROUP_CREATE), name), H5Pclose);
  context.checked(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), name);
  context.checked(H5Pset_obj_track_times(properties, false), name);
  return {context.checked(H5Gcreate2(file, name, H5P_DEFAULT, properties, H5P_DEFAULT), name), H5Gclose};
}

}  // namespace insonify::hdf5

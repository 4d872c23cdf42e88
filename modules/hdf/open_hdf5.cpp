// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "hdf/hdf5_internal.hpp"

// Validates files of unknown origin before HDF5 parses them.
namespace insonify::hdf5 {

std::vector<std::string> names_in(const FileContext& context, hid_t file, const char* group) {
  constexpr hsize_t most = 64;
  std::vector<std::string> names;
  if (H5Lexists(file, group, H5P_DEFAULT) <= 0) return names;
  const Handle opened(context.checked(H5Gopen2(file, group, H5P_DEFAULT), group), H5Gclose);
  H5G_info_t info{};
  context.checked(H5Gget_info(opened, &info), group);
  if (info.nlinks > most)
    fail(context.kind, context.path, ": ", group, " holds ", info.nlinks, " members, must hold at most ", most);
  const auto note = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  context.checked(H5Literate(opened, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, note, &names), group);
  return names;
}

Handle open_file(const FileContext& context) {
  require_regular_file(context.path);
  const htri_t is_hdf5 = H5Fis_hdf5(context.path.c_str());
  if (is_hdf5 < 0) fail(ErrorKind::file, context.path, ": cannot be read");
  if (is_hdf5 == 0) fail(context.kind, context.path, ": is not an HDF5 file");
  return {context.checked(H5Fopen(context.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "is damaged or cut short"),
          H5Fclose};
}

namespace {

/// Returns the file names of the sources of a virtual dataset.
std::vector<std::string> virtual_sources(const FileContext& context, const DatasetName& name, hid_t properties) {
  std::size_t count = 0;
  context.checked(H5Pget_virtual_count(properties, &count), name.path);
  std::vector<std::string> sources(count);
  for (std::size_t part = 0; part < count; ++part) {
    const ssize_t length = H5Pget_virtual_filename(properties, part, nullptr, 0);
    sources[part].resize(static_cast<std::size_t>(std::max<ssize_t>(0, length)));
    H5Pget_virtual_filename(properties, part, sources[part].data(), sources[part].size() + 1);
  }
  return sources;
}

/// Throws Error(content) for a dataset whose numbers lie in files that the user did not name, so that a stranger's cube
/// does not show other files of the user. Blocks of a survey beside the cube are its own.
void require_own_data(const FileContext& context, hid_t file, const DatasetName& name, hid_t dataset) {
  const auto refuse = [&](const char* what) {
    fail(context.kind, context.path, ": dataset ", name.path, " ", what,
         ", which is not read; get the file that holds the data itself");
  };
  H5L_info_t link;
  if (H5Lget_info(file, name.path, &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
    refuse("is a link to elsewhere");
  const Handle properties(context.checked(H5Dget_create_plist(dataset), name.path), H5Pclose);
  if (H5Pget_external_count(properties) > 0) refuse("is stored in another file");
  if (H5Pget_layout(properties) != H5D_VIRTUAL) return;
  for (const std::string& source : virtual_sources(context, name, properties)) {
    const std::filesystem::path relative = std::filesystem::path(source).lexically_normal();
    if (relative.is_absolute() || (!relative.empty() && *relative.begin() == ".."))
      refuse("is stored outside its folder");
  }
}

/// Returns the size of the files of a virtual dataset [bytes]. Throws Error(content) if one is missing: HDF5 would give
/// fill values in its position.
hsize_t bytes_of_sources(const FileContext& context, const DatasetName& name, hid_t properties) {
  hsize_t bytes = 0;
  for (const std::string& source : virtual_sources(context, name, properties)) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(std::filesystem::path(context.path).parent_path() / source, missing);
    if (missing) fail(context.kind, context.path, ": ", name.path, ": its part ", source, " is missing");
    bytes += size;
  }
  return bytes;
}

/// Throws Error(content) for a dataset that announces more values than are stored: HDF5 would make up the rest.
void require_stored(const FileContext& context, const DatasetName& name, hid_t dataset) {
  constexpr double unpacked_per_byte = 1032;  // largest ratio of zlib
  const Handle properties(context.checked(H5Dget_create_plist(dataset), name.path), H5Pclose);
  const Handle type(context.checked(H5Dget_type(dataset), name.path), H5Tclose);
  const Handle space(context.checked(H5Dget_space(dataset), name.path), H5Sclose);
  const double values = static_cast<double>(H5Sget_simple_extent_npoints(space));
  const bool is_virtual = H5Pget_layout(properties) == H5D_VIRTUAL;
  const hsize_t stored = is_virtual ? bytes_of_sources(context, name, properties) : H5Dget_storage_size(dataset);
  const bool is_packed = H5Pget_nfilters(properties) > 0 || is_virtual;
  const double most = static_cast<double>(stored) * (is_packed ? unpacked_per_byte : 1);
  if (values * static_cast<double>(H5Tget_size(type)) <= most)
    return expect_from_file(context.path, stored, {values, "values", static_cast<double>(H5Tget_size(type))});
  fail(context.kind, context.path, ": ", name.path, " announces ", values, " values of ", H5Tget_size(type),
       " bytes, and holds ", stored, " bytes", copy_again);
}

}  // namespace

void read_values(const FileContext& context, hid_t dataset, const Values& values, void* to, const std::string& what) {
  if (H5Dread(dataset, values.type, values.memory, values.selected, H5P_DEFAULT, to) < 0)
    fail(context.kind, context.path, ": ", what, ": a chunk of it is damaged", copy_again);
}

Handle open_dataset(const FileContext& context, hid_t file, const DatasetName& name) {
  if (context.checked(H5Lexists(file, name.path, H5P_DEFAULT), name.path) == 0)
    fail(context.kind, context.path, ": dataset ", name.path, " is missing");
  Handle dataset{context.checked(H5Dopen2(file, name.path, H5P_DEFAULT), name.path), H5Dclose};
  require_own_data(context, file, name, dataset);
  require_stored(context, name, dataset);
  return dataset;
}

std::uint64_t find_plain(const FileContext& context, hid_t file, const DatasetName& name, hid_t type,
                         const Extent& extent) {
  const Handle dataset = open_dataset(context, file, name);
  const Extent found = extent_of(context, dataset, name.path, extent.size());
  for (std::size_t d = 0; d < extent.size(); ++d)
    if (found[d] != extent[d])
      fail(context.kind, context.path, ": ", name.path, " has ", found[d], " entries, must have ", extent[d]);
  const Handle stored(context.checked(H5Dget_type(dataset), name.path), H5Tclose);
  const Handle properties(context.checked(H5Dget_create_plist(dataset), name.path), H5Pclose);
  if (H5Tequal(stored, type) <= 0) fail(context.kind, context.path, ": ", name.path, " is of another type");
  if (H5Pget_layout(properties) != H5D_CONTIGUOUS || H5Pget_nfilters(properties) > 0)
    fail(context.kind, context.path, ": ", name.path, " is stored in chunks, must be contiguous");
  const haddr_t offset = H5Dget_offset(dataset);
  if (offset == HADDR_UNDEF) return 0;
  const hsize_t bytes = H5Dget_storage_size(dataset), all = size_of_file(context.path);
  if (offset > all || bytes > all - offset)
    fail(context.kind, context.path, ": ", name.path, " takes ", bytes, " bytes from byte ", offset,
         " on, the file holds ", all, copy_again);
  return offset;
}

}  // namespace insonify::hdf5

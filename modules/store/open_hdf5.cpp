#include <algorithm>
#include <cstring>
#include <filesystem>
#include <new>
#include <sstream>

#include <sys/mman.h>

#include "core/child_process.hpp"
#include "core/input_file.hpp"
#include "store/hdf5_internal.hpp"

// What is read of files that others may have made: checked before HDF5 trusts it.
namespace insonify::hdf5 {

std::vector<std::string> names_in(const Place& place, hid_t file, const char* group) {
  constexpr hsize_t most = 64;
  std::vector<std::string> names;
  if (H5Lexists(file, group, H5P_DEFAULT) <= 0) return names;
  const Handle opened(place.checked(H5Gopen2(file, group, H5P_DEFAULT), group), H5Gclose);
  H5G_info_t info{};
  place.checked(H5Gget_info(opened, &info), group);
  if (info.nlinks > most)
    fail(place.kind, place.path, ": ", group, " holds ", info.nlinks, " members, must hold at most ", most);
  const auto note = [](hid_t, const char* name, const H5L_info_t*, void* to) -> herr_t {
    static_cast<std::vector<std::string>*>(to)->emplace_back(name);
    return 0;
  };
  place.checked(H5Literate(opened, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, note, &names), group);
  return names;
}

namespace {

/// Text of any length that was found, as object, name and text, each ended by a zero.
struct FoundTexts {
  std::string object, all;
  void add(const char* name, const char* text) {
    for (const std::string& part : {object, std::string(name), std::string(text ? text : "")}) (all += part) += '\0';
  }
};

herr_t read_attribute(hid_t object, const char* name, const H5A_info_t*, void* found) {
  constexpr hssize_t most = 1 << 20;
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose), type(H5Aget_type(attribute), H5Tclose),
      space(H5Aget_space(attribute), H5Sclose);
  const auto size = static_cast<hssize_t>(H5Tget_size(type)), values = H5Sget_simple_extent_npoints(space);
  if (size <= 0 || values <= 0 || values > most / size) return 0;
  std::vector<char> value(static_cast<std::size_t>(values * size));
  if (H5Aread(attribute, type, value.data()) < 0) return 0;
  if (values == 1 && H5Tis_variable_str(type) > 0) {
    const char* text = nullptr;
    std::memcpy(&text, value.data(), sizeof text);
    static_cast<FoundTexts*>(found)->add(name, text);
  }
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, value.data());
  return 0;
}

herr_t open_object(hid_t file, const char* name, const H5O_info_t* info, void* found) {
  const Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  if (object < 0) return 0;
  const std::string path = name;
  static_cast<FoundTexts*>(found)->object = path == "." ? "/" : "/" + path;
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, read_attribute, found);
  if (info->type == H5O_TYPE_DATASET) H5Dget_storage_size(object);
  return 0;
}

/// Opens everything in a file that has a name, and reads attributes and where the data lie. Returns the texts it found.
std::string walk_over(const std::string& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file < 0) return {};
  FoundTexts found;
  H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, open_object, &found);
  try {
    names_in({path, ErrorKind::content}, file, layers_group);
  } catch (const Error&) {  // the reader will meet it again
  }
  return found.all;
}

}  // namespace

Handle open_file(Place& place) {
  require_regular_file(place.path);
  // A damaged file can end a process within HDF5.
  constexpr ChildLimits limits{std::size_t{256} << 20, 8};
  std::string texts;
  read_in_child(place.path, limits, [&](ArraySender& to) { to(walk_over(place.path)); })(texts);
  std::istringstream parts(texts);
  for (std::string object, name, text;
       std::getline(parts, object, '\0') && std::getline(parts, name, '\0') && std::getline(parts, text, '\0');)
    place.texts[{object, name}] = text;
  const htri_t is_hdf5 = H5Fis_hdf5(place.path.c_str());
  if (is_hdf5 < 0) fail(ErrorKind::file, place.path, ": cannot be read");
  if (is_hdf5 == 0) fail(place.kind, place.path, ": is not an HDF5 file");
  return {place.checked(H5Fopen(place.path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "is damaged or cut short"), H5Fclose};
}

namespace {

/// File name of a part of a virtual dataset.
std::string virtual_source(hid_t properties, std::size_t part) {
  const ssize_t length = H5Pget_virtual_filename(properties, part, nullptr, 0);
  std::string source(static_cast<std::size_t>(std::max<ssize_t>(0, length)) + 1, '\0');
  H5Pget_virtual_filename(properties, part, source.data(), source.size());
  source.pop_back();
  return source;
}

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
    const std::string source = virtual_source(properties, i);
    const std::filesystem::path relative = std::filesystem::path(source).lexically_normal();
    if (relative.is_absolute() || (!relative.empty() && *relative.begin() == ".."))
      refuse("is stored outside its folder");
  }
}

/// Bytes of the files of which a virtual dataset is put together. Refuses one of which a part is missing: HDF5 would give
/// fill values in its place.
hsize_t bytes_of_sources(const Place& place, const DatasetName& name, hid_t properties) {
  std::size_t sources = 0;
  place.checked(H5Pget_virtual_count(properties, &sources), name.path);
  hsize_t bytes = 0;
  for (std::size_t i = 0; i < sources; ++i) {
    const std::string source = virtual_source(properties, i);
    std::error_code missing;
    const auto size = std::filesystem::file_size(std::filesystem::path(place.path).parent_path() / source, missing);
    if (missing) fail(place.kind, place.path, ": ", name.path, ": its part ", source, " is missing");
    bytes += size;
  }
  return bytes;
}

/// Whether values are unpacked, or put together of other files, when they are read: HDF5 trusts that a chunk unpacks to what its extent announces.
bool is_packed(const Place& place, hid_t dataset, const std::string& what) {
  const Handle properties(place.checked(H5Dget_create_plist(dataset), what), H5Pclose);
  return H5Pget_nfilters(properties) > 0 || H5Pget_layout(properties) == H5D_VIRTUAL;
}

/// Refuses a dataset that announces more values than are stored: HDF5 would make up the rest.
void require_stored(const Place& place, const DatasetName& name, hid_t dataset) {
  constexpr double unpacked_per_byte = 1032;  // by zlib, at most
  const Handle properties(place.checked(H5Dget_create_plist(dataset), name.path), H5Pclose);
  const Handle type(place.checked(H5Dget_type(dataset), name.path), H5Tclose);
  const Handle space(place.checked(H5Dget_space(dataset), name.path), H5Sclose);
  const double values = static_cast<double>(H5Sget_simple_extent_npoints(space));
  const bool is_virtual = H5Pget_layout(properties) == H5D_VIRTUAL;
  const hsize_t stored = is_virtual ? bytes_of_sources(place, name, properties) : H5Dget_storage_size(dataset);
  const double most = static_cast<double>(stored) * (is_packed(place, dataset, name.path) ? unpacked_per_byte : 1);
  if (values * static_cast<double>(H5Tget_size(type)) <= most) return;
  fail(place.kind, place.path, ": ", name.path, " announces ", values, " values of ", H5Tget_size(type),
       " bytes, and holds ", stored, " bytes; copy the file again, or run the ping again");
}

/// Memory that a child process shares.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes)
      : bytes_(bytes), start_(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (start_ == MAP_FAILED) throw std::bad_alloc();
  }
  ~SharedMemory() { munmap(start_, bytes_); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  char* start() const { return static_cast<char*>(start_); }

 private:
  std::size_t bytes_;
  void* start_;
};

}  // namespace

void read_values(const Place& place, hid_t dataset, const Values& values, void* to, const std::string& what) {
  const auto read = [&](void* memory) {
    return H5Dread(dataset, values.type, values.memory, values.selected, H5P_DEFAULT, memory);
  };
  if (!is_packed(place, dataset, what)) {
    place.checked(read(to), what);
    return;
  }
  const Handle space(place.checked(values.selected == H5S_ALL ? H5Dget_space(dataset) : H5Scopy(values.selected), what),
                     H5Sclose);
  const std::size_t bytes = H5Tget_size(values.type) * static_cast<std::size_t>(H5Sget_select_npoints(space));
  const SharedMemory shared(bytes + 1);  // and whether it was read
  constexpr std::size_t more_memory = std::size_t{256} << 20, bytes_per_second = 10 << 20;
  try_in_child(place.path, {bytes + more_memory, static_cast<unsigned>(8 + bytes / bytes_per_second)},
               [&] { shared.start()[bytes] = static_cast<char>(read(shared.start()) >= 0); });
  if (shared.start()[bytes] == 0)
    fail(place.kind, place.path, ": ", what, ": a chunk of it is damaged; copy or export the file again");
  std::memcpy(to, shared.start(), bytes);
}

Handle open_dataset(const Place& place, hid_t file, const DatasetName& name) {
  if (H5Lexists(file, name.path, H5P_DEFAULT) <= 0)
    fail(place.kind, place.path, ": dataset ", name.path, " is missing");
  Handle dataset{place.checked(H5Dopen2(file, name.path, H5P_DEFAULT), name.path), H5Dclose};
  require_own_data(place, file, name, dataset);
  require_stored(place, name, dataset);
  return dataset;
}

}  // namespace insonify::hdf5

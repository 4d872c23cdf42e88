// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <hdf5.h>

#include "core/error.hpp"
#include "core/library_turn.hpp"
#include "files/input_file.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "files/read_apart.hpp"
#include "hdf/dataset_name_internal.hpp"

// Private to the modules that read and write HDF5 files.
namespace insonify::hdf5 {

/// Suppresses HDF5's error output during its lifetime; failures become Error instead. It also holds the turn in HDF5:
/// all calls of HDF5 in this process are made during the lifetime of one.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  Hdf5Turn turn_;
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The remedy for a damaged file, whether HDF5 or its caller found the damage.
inline constexpr const char* copy_again = "; copy or export it again";

/// The file of an operation, and the kind of its errors: file when writing, content when reading.
struct FileContext {
  std::string path;
  ErrorKind kind;

  /// Throws Error "path: what: HDF5's reason", with the remedy when reading.
  [[noreturn]] void fail_here(const std::string& what) const;
  /// Returns `status` unless it is negative, which indicates failure.
  template <typename Status>
  Status checked(Status status, const std::string& what) const {
    if (status < 0) fail_here(what);
    return status;
  }
};

/// First reason why a Handle of this thread could not be closed; empty: all could. HDF5 writes buffered data of a
/// dataset when the dataset is closed, and does not report a failure later.
inline thread_local std::string failed_to_close;
/// Sets failed_to_close to the reason that HDF5 reports.
void note_failed_close();

/// Owns an HDF5 identifier and closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0 && close_(id_) < 0) note_failed_close();
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

using Extent = std::vector<hsize_t>;

/// Creates a file without timestamps: same input, same bytes.
Handle create_file(const FileContext& context, const std::string& name);

/// Calls write(), which writes to the file of `context`. Throws Error(file) with the first failure, such as a full disk;
/// later calls of HDF5 on the file only report its consequences.
template <typename Write>
void write_checked(const FileContext& context, Write&& write) {
  failed_to_close.clear();
  try {
    write();
  } catch (const Error&) {
    if (failed_to_close.empty()) throw;
  }
  if (!failed_to_close.empty()) fail(context.kind, context.path, ": cannot be written: ", failed_to_close);
}

/// Writes a file by body(place, file), to a temporary name that is then renamed.
template <typename Body>
void write_hdf5(const std::string& path, Body&& body) {
  const FileContext context{path, ErrorKind::file};
  PendingFile pending(path);
  {
    const QuietErrors quiet;
    write_checked(context, [&] { body(context, create_file(context, pending.temporary())); });
  }
  pending.commit();  // waits for the disk, without the turn
}

/// Opens an existing file for reading, within read_hdf5. Throws Error(file) if the file is missing or a folder, Error(content) if it is not HDF5.
Handle open_file(const FileContext& context);

/// Returns what read(place, file, to, arguments...) sends, as read_apart. Throws as open_file and read do, too.
template <typename Read, typename... Arguments>
ArrayReceiver read_hdf5(const std::string& path, Read, const Arguments&... arguments) {
  static_assert(std::is_empty_v<Read>, "captures do not reach another process");
  require_regular_file(path);
  const auto open_and_read = [](ArraySender& to, const std::string& name, const auto&... values) {
    const QuietErrors quiet;
    const FileContext context{name, ErrorKind::content};
    const Handle file = open_file(context);
    Read{}(context, file, to, values...);
  };
  return read_apart(path, limits_of_file(size_of_file(path)), open_and_read, path, arguments...);
}

/// Storage of the chunks of a dataset: unchanged, or shuffled and deflated at level 1, without loss.
enum class Packing { none, deflate };

/// Creates a dataset without timestamps, with its unit and name as attributes "units" and "long_name"; chunked if
/// `chunk` is not empty.
Handle create_dataset(const FileContext& context, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
                      const Extent& chunk = {}, Packing packing = Packing::none);

/// Creates a dataset with contiguous values, and returns the offset of the first [bytes]; 0 for none. The values are
/// written there without HDF5, once the file is closed, and are undefined until then.
std::uint64_t create_plain(const FileContext& context, hid_t file, const DatasetName& name, hid_t type,
                           const Extent& extent);
/// Returns this offset for a dataset of any file. Throws Error(content) unless its values have this type and extent and
/// lie contiguous and unpacked in the file.
std::uint64_t find_plain(const FileContext& context, hid_t file, const DatasetName& name, hid_t type,
                         const Extent& extent);

/// Creates a group that keeps the order in which its members are written.
Handle create_ordered_group(const FileContext& context, hid_t file, const char* name);

/// Returns the names in such a group in the order of writing; none if it is absent.
std::vector<std::string> names_in(const FileContext& context, hid_t file, const char* group);

/// Returns the HDF5 type of a number in the file (little-endian) or in memory. Enumerations of one byte are as uint8.
template <typename Number>
hid_t type_of(bool in_file) {
  if constexpr (std::is_same_v<Number, double>) return in_file ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Number, float>) return in_file ? H5T_IEEE_F32LE : H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<Number, std::int64_t>) return in_file ? H5T_STD_I64LE : H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<Number, std::uint64_t>) return in_file ? H5T_STD_U64LE : H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<Number, std::uint32_t>) return in_file ? H5T_STD_U32LE : H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<Number, std::int16_t>) return in_file ? H5T_STD_I16LE : H5T_NATIVE_INT16;
  if constexpr (std::is_same_v<Number, std::uint16_t>) return in_file ? H5T_STD_U16LE : H5T_NATIVE_UINT16;
  return in_file ? H5T_STD_U8LE : H5T_NATIVE_UINT8;
}

/// Writes a dataset of numbers.
template <typename Number>
void write_numbers(const FileContext& context, hid_t file, const DatasetName& name, const Extent& extent,
                   const Number* numbers) {
  const Handle dataset = create_dataset(context, file, name, type_of<Number>(true), extent);
  context.checked(H5Dwrite(dataset, type_of<Number>(false), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers), name.path);
}

/// Opens a dataset; throws Error(content) if it is missing.
Handle open_dataset(const FileContext& context, hid_t file, const DatasetName& name);

/// A selection of values of a dataset: their type, selection in memory, and selection in the dataset.
struct Values {
  hid_t type, memory = H5S_ALL, selected = H5S_ALL;
};

/// Reads values of a dataset. Throws Error(content) that names `what`.
void read_values(const FileContext& context, hid_t dataset, const Values& values, void* to, const std::string& what);

/// Returns the type of UTF-8 text padded with zeros to `length` bytes, or of any length.
Handle text_type(const FileContext& context, std::size_t length = H5T_VARIABLE);
/// Returns the type of complex<float> as in h5py: compound {r, i} of `real_type`.
Handle complex_type(const FileContext& context, hid_t real_type);

/// Returns the extent of a dataset.
Extent extent_of(const FileContext& context, hid_t dataset, const std::string& name);
/// Returns it too. Throws Error(content) unless it has `rank` dimensions.
Extent extent_of(const FileContext& context, hid_t dataset, const std::string& name, std::size_t rank);

/// Returns the space of all values of an array, and of a block of `count` values from `start` on.
Handle space_of(const FileContext& context, const Extent& whole);
Handle block_of(const FileContext& context, const Extent& whole, const Extent& start, const Extent& count);

/// Writes an attribute with the values of `space`, of a type in the file and in memory.
void write_values(const FileContext& context, hid_t where, const char* name, hid_t space, hid_t in_file,
                  hid_t in_memory, const void* values);
/// Writes an attribute with a single value, or with several.
template <typename Number>
requires std::is_arithmetic_v<Number>
void write_attribute(const FileContext& context, hid_t where, const char* name, Number value) {
  const Handle space(context.checked(H5Screate(H5S_SCALAR), name), H5Sclose);
  write_values(context, where, name, space, type_of<Number>(true), type_of<Number>(false), &value);
}
void write_attribute(const FileContext& context, hid_t where, const char* name, const std::string& value);
void write_attribute(const FileContext& context, hid_t where, const char* name, std::span<const double> values);

/// Reads an attribute of so many numbers. Throws Error(content) naming it if it is missing or has others.
void read_numbers(const FileContext& context, hid_t where, const char* name, hid_t in_memory, std::size_t count,
                  void* to);
/// Returns the text of an attribute. Throws as read_numbers.
std::string read_text(const FileContext& context, hid_t where, const char* name);
/// Returns the number of an attribute. Throws as read_numbers.
template <typename Value = double>
Value read_attribute(const FileContext& context, hid_t where, const char* name) {
  Value value{};
  read_numbers(context, where, name, type_of<Value>(false), 1, &value);
  return value;
}

/// Reads a whole dataset, which must have the expected extent.
template <typename T>
std::vector<T> read_all(const FileContext& context, hid_t file, const DatasetName& name, const Extent& expected) {
  const Handle dataset = open_dataset(context, file, name);
  const Extent extent = extent_of(context, dataset, name.path, expected.size());
  std::size_t values = 1;
  for (std::size_t d = 0; d < extent.size(); ++d) {
    if (extent[d] != expected[d])
      fail(context.kind, context.path, ": ", name.path, " has ", extent[d], " entries, ", expected[d],
           " expected from /pressure");
    values *= extent[d];
  }
  std::vector<T> result(values);
  read_values(context, dataset, {type_of<T>(false)}, result.data(), name.path);
  return result;
}

}  // namespace insonify::hdf5

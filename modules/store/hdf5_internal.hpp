#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

#include "core/error.hpp"
#include "store/cube_layout_internal.hpp"

namespace insonify::hdf5 {

/// Keeps HDF5 from printing its error stack while it lives; failures become Error instead.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The file an operation works on, and what a failure means: Error(file) when writing, Error(content) when
/// reading.
struct Place {
  std::string path;
  ErrorKind kind;

  /// Throws Error "path: what: reason given by HDF5".
  [[noreturn]] void fail_here(const std::string& what) const;
  /// Returns what HDF5 returned unless it is negative, the sign of failure.
  template <typename Status>
  Status checked(Status status, const std::string& what) const {
    if (status < 0) fail_here(what);
    return status;
  }
};

/// Owns one HDF5 identifier and closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }
  /// Closes now; negative on failure.
  herr_t close() { return close_(std::exchange(id_, H5I_INVALID_HID)); }

 private:
  hid_t id_;
  Close close_;
};

using Extent = std::vector<hsize_t>;

/// A new file without timestamps: same input, same bytes.
Handle create_file(const Place& place, const std::string& name);

/// An existing file, to be read. Throws Error(file) if it is missing or a folder, Error(content) if it is no HDF5.
Handle open_file(const Place& place);

/// A dataset without timestamps, with its unit as attribute "units"; with `chunk` if not empty.
Handle create_dataset(const Place& place, hid_t file, const DatasetName& name, hid_t type, const Extent& extent,
                      const Extent& chunk = {});

/// Throws Error(content) if it is missing.
Handle open_dataset(const Place& place, hid_t file, const DatasetName& name);

/// complex<float> as h5py knows it: compound {r, i}; little endian in files.
Handle complex_type(const Place& place, hid_t real_type);

/// A dataset's extent; Error(content) if it has not `rank` dimensions.
Extent extent_of(const Place& place, hid_t dataset, const std::string& name, std::size_t rank);

/// The whole of `extent` but for its first dimension, at index `first` of it.
Handle select_row(const Place& place, hid_t dataset, const Extent& extent, hsize_t first);

/// Attributes of one value each. Names are part of the file format.
void write_attribute(const Place& place, hid_t where, const char* name, double value);
void write_attribute(const Place& place, hid_t where, const char* name, std::int64_t value);
void write_attribute(const Place& place, hid_t where, const char* name, std::uint64_t value);
void write_attribute(const Place& place, hid_t where, const char* name, const std::string& value);

/// Throw Error(content) naming the attribute if it is missing or of another type.
double read_number(const Place& place, hid_t where, const char* name);
std::int64_t read_integer(const Place& place, hid_t where, const char* name);
std::uint64_t read_unsigned(const Place& place, hid_t where, const char* name);
std::string read_text(const Place& place, hid_t where, const char* name);

}  // namespace insonify::hdf5

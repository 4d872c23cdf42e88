// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <hdf5.h>

namespace insonify {

/// Opens a file as another program would, to look at it or to damage it.
class RawFile {
 public:
  explicit RawFile(const std::string& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)) {}
  ~RawFile() { H5Fclose(file_); }
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;
  operator hid_t() const { return file_; }

 private:
  hid_t file_;
};

std::vector<hsize_t> raw_extent(hid_t file, const char* dataset);

/// Return the numbers of a dataset of any type, and overwrite them.
std::vector<double> raw_values(hid_t file, const char* dataset);
void raw_overwrite(hid_t file, const char* dataset, const std::vector<double>& values);

/// Returns the text of an attribute of variable length.
std::string raw_text(hid_t file, const char* object, const char* name);

/// Return the number of an attribute of the file, and overwrite it.
double raw_number(hid_t file, const char* name);
void raw_set(hid_t file, const char* name, double value);

/// Expects the same bytes of write("first.h5") and write("second.h5"), which return the paths of their files. The
/// second is written a day later by the clock of this program, into memory that malloc filled with another byte.
void expect_same_bytes_a_day_later(const std::function<std::string(const std::string&)>& write);

}  // namespace insonify

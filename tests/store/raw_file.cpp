// SPDX-License-Identifier: BSD-3-Clause
#include "store/raw_file.hpp"

#include <ctime>

#include <malloc.h>
#include <sys/time.h>

#include "support/test.hpp"

namespace {
time_t seconds_ahead = 0;
}  // namespace

// Sets the clock that HDF5 reads, too: symbols of a program come before those of libraries.
extern "C" int gettimeofday(timeval* now, void*) noexcept {
  timespec t;
  clock_gettime(CLOCK_REALTIME, &t);
  *now = {t.tv_sec + seconds_ahead, t.tv_nsec / 1000};
  return 0;
}

extern "C" time_t time(time_t* now) noexcept {
  timeval t;
  gettimeofday(&t, nullptr);
  if (now) *now = t.tv_sec;
  return t.tv_sec;
}

namespace insonify {

std::vector<hsize_t> raw_extent(hid_t file, const char* name) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
  std::vector<hsize_t> extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  H5Sclose(space);
  H5Dclose(dataset);
  return extent;
}

std::vector<double> raw_values(hid_t file, const char* name) {
  const std::vector<hsize_t> extent = raw_extent(file, name);
  std::vector<double> values(std::accumulate(extent.begin(), extent.end(), hsize_t{1}, std::multiplies<>()));
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
  EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  H5Dclose(dataset);
  return values;
}

void raw_overwrite(hid_t file, const char* name, const std::vector<double>& values) {
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
  H5Dclose(dataset);
}

double raw_number(hid_t file, const char* name) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  double value = 0;
  EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), 0) << name;
  H5Aclose(attribute);
  return value;
}

void raw_set(hid_t file, const char* name, double value) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), 0) << name;
  H5Aclose(attribute);
}

std::string raw_text(hid_t file, const char* object, const char* name) {
  const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT), type = H5Aget_type(attribute);
  char* text = nullptr;
  H5Aread(attribute, type, &text);
  const std::string result = text;
  H5free_memory(text);
  H5Tclose(type);
  H5Aclose(attribute);
  return result;
}

void expect_same_bytes_a_day_later(const std::function<std::string(const std::string&)>& write) {
  mallopt(M_PERTURB, 0x55);
  const std::string first = file_bytes(write("first.h5"));
  seconds_ahead = 24 * 60 * 60;
  mallopt(M_PERTURB, 0xA3);
  const std::string second = file_bytes(write("second.h5"));
  mallopt(M_PERTURB, 0);
  seconds_ahead = 0;
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(first == second);
}

}  // namespace insonify

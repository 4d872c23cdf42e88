// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// The classic netCDF formats (CDF-1, -2 and -5; NetCDF User's Guide, appendix B) do not say how long a file is, and its
// library reads zeros behind the end: the header gives where each variable begins and how much it holds.
namespace insonify {
namespace {

/// Numbers of the header, highest byte first.
class NetcdfHeader {
 public:
  NetcdfHeader(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

  std::uint64_t number(int size) {
    need(static_cast<std::size_t>(size));
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
    return value;
  }
  void skip(std::uint64_t size) {
    need(size);
    at_ += size;
  }
  void skip_name(int count_size) { skip_padded(number(count_size)); }
  void skip_padded(std::uint64_t size) { skip((size + 3) / 4 * 4); }
  [[noreturn]] void cut_off() const {
    fail(ErrorKind::content, path_, ": cut off: the header of a netCDF file ends at byte ", bytes_.size(),
         "; copy or export the file again");
  }

 private:
  void need(std::uint64_t size) const {
    if (size > bytes_.size() || at_ > bytes_.size() - size) cut_off();
  }
  const std::string& path_;
  const std::string& bytes_;
  std::size_t at_ = 4;
};

/// Bytes of a number of a netCDF type.
std::uint64_t netcdf_bytes(const std::string& path, std::uint64_t type) {
  constexpr std::uint64_t bytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  if (type == 0 || type >= std::size(bytes))
    fail(ErrorKind::content, path, ": has a netCDF variable of type ", type, ", expected 1 to 11; export it again");
  return bytes[type];
}

void skip_attributes(NetcdfHeader& header, const std::string& path, int count_size) {
  header.number(4);
  for (std::uint64_t n = header.number(count_size); n > 0; --n) {
    header.skip_name(count_size);
    const std::uint64_t bytes = netcdf_bytes(path, header.number(4)), values = header.number(count_size);
    if (values > std::uint64_t{1} << 40) header.cut_off();
    header.skip_padded(bytes * values);
  }
}

}  // namespace

void check_netcdf(const std::string& path) {
  const std::string bytes = read_beginning(path, 1 << 20);
  if (bytes.size() < 4 || bytes.compare(0, 3, "CDF") != 0) return;
  const int version = bytes[3];
  if (version != 1 && version != 2 && version != 5) return;
  const int count_size = version == 5 ? 8 : 4, place_size = version == 1 ? 4 : 8;
  NetcdfHeader header(path, bytes);
  const std::uint64_t records = header.number(count_size);
  header.number(4);
  std::vector<std::uint64_t> dimensions;
  for (std::uint64_t n = header.number(count_size); n > 0; --n) {
    header.skip_name(count_size);
    dimensions.push_back(header.number(count_size));  // 0: the records
  }
  skip_attributes(header, path, count_size);

  // The end of each variable; those of records stand one record after the other.
  header.number(4);
  std::uint64_t end = 0, record_bytes = 0, record_end = 0;
  for (std::uint64_t n = header.number(count_size); n > 0; --n) {
    header.skip_name(count_size);
    std::uint64_t values = 1;
    bool of_records = false;
    for (std::uint64_t d = header.number(count_size); d > 0; --d) {
      const std::uint64_t dimension = header.number(count_size);
      if (dimension >= dimensions.size())
        fail(ErrorKind::content, path, ": has a netCDF variable of a dimension that is not there; export it again");
      if (dimensions[dimension] == 0)
        of_records = true;
      else
        values *= dimensions[dimension];
    }
    skip_attributes(header, path, count_size);
    const std::uint64_t size = values * netcdf_bytes(path, header.number(4));
    header.number(count_size);  // the same, padded
    const std::uint64_t begin = header.number(place_size);
    if (of_records)
      record_bytes += (size + 3) / 4 * 4, record_end = std::max(record_end, begin + size);
    else
      end = std::max(end, begin + size);
  }
  if (records > 0 && records < 0xffffffff) end = std::max(end, record_end + (records - 1) * record_bytes);
  if (const std::size_t held = file_size_of(path); held < end)
    fail(ErrorKind::content, path, ": cut off: its variables end at byte ", end, ", the file has ", held,
         " bytes; copy or export the file again");
}

}  // namespace insonify

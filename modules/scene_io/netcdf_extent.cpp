// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Checks the length of a file. The classic netCDF formats (CDF-1, -2 and -5; NetCDF User's Guide, appendix B) do not
// state it, and their library reads zeros beyond the end. The header has begin and size of each variable.
namespace insonify {
namespace {

/// Numbers of the header, highest byte first.
class NetcdfHeader {
 public:
  NetcdfHeader(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

  std::uint64_t number(int size = 4) {
    need(static_cast<std::size_t>(size));
    std::uint64_t value = 0;
    for (int i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(bytes_[at_++]);
    return value;
  }
  std::uint64_t count() { return number(bytes_[3] == 5 ? 8 : 4); }
  std::uint64_t offset() { return number(bytes_[3] == 1 ? 4 : 8); }
  std::uint64_t bytes_of_type() {
    constexpr std::uint64_t bytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::uint64_t type = number();
    if (type == 0 || type >= std::size(bytes))
      fail(ErrorKind::content, path_, ": has a netCDF variable of type ", type, ", expected 1 to 11; export it again");
    return bytes[type];
  }
  void skip_name() { skip(count()); }
  void skip_attributes() {
    number();
    for (std::uint64_t n = count(); n > 0; --n) {
      skip_name();
      const std::uint64_t bytes = bytes_of_type(), values = count();
      skip(values > bytes_.size() ? values : bytes * values);
    }
  }

 private:
  /// Skips `size` bytes, which are padded to a multiple of four.
  void skip(std::uint64_t size) {
    need(size);
    at_ += (size + 3) / 4 * 4;
  }
  void need(std::uint64_t size) const {
    if (size > bytes_.size() || at_ > bytes_.size() - size)
      fail(ErrorKind::content, path_, ": cut off: the header of a netCDF file ends at byte ", bytes_.size(),
           "; copy or export the file again");
  }
  const std::string& path_;
  const std::string& bytes_;
  std::size_t at_ = 4;
};

}  // namespace

void check_netcdf(const std::string& path) {
  const std::string bytes = read_beginning(path, 1 << 20);
  if (bytes.size() < 4 || bytes.compare(0, 3, "CDF") != 0) return;
  const int version = bytes[3];
  if (version != 1 && version != 2 && version != 5) return;
  NetcdfHeader header(path, bytes);
  const std::uint64_t records = header.count();
  header.number();
  std::vector<std::uint64_t> dimensions;
  for (std::uint64_t n = header.count(); n > 0; --n) {
    header.skip_name();
    dimensions.push_back(header.count());  // 0: dimension of the records
  }
  header.skip_attributes();

  // Find the end of each variable. Variables of records stand one record after the other.
  header.number();
  std::uint64_t end = 0, record_bytes = 0, record_end = 0;
  for (std::uint64_t n = header.count(); n > 0; --n) {
    header.skip_name();
    std::uint64_t values = 1;
    bool of_records = false;
    for (std::uint64_t d = header.count(); d > 0; --d) {
      const std::uint64_t dimension = header.count();
      if (dimension >= dimensions.size())
        fail(ErrorKind::content, path, ": has a netCDF variable of a dimension that is not there; export it again");
      if (dimensions[dimension] == 0)
        of_records = true;
      else
        values *= dimensions[dimension];
    }
    header.skip_attributes();
    const std::uint64_t size = values * header.bytes_of_type();
    header.count();  // skips the padded size
    const std::uint64_t begin = header.offset();
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

// SPDX-License-Identifier: BSD-3-Clause
// Points of LAZ by LASzip, as the rows of the LAS file from which they were packed (ASPRS, LAS Specification 1.4 R15).
#include <algorithm>
#include <string>

#include <laszip/laszip_api.h>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "files/read_apart.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// A LAZ that LASzip has opened.
class PackedPoints {
 public:
  explicit PackedPoints(const std::string& path) : path_(path) {
    if (laszip_create(&reader_) != 0) fail(ErrorKind::runtime, path, ": LASzip cannot be started; install it again");
    laszip_BOOL packed = 0;
    check(laszip_open_reader(reader_, path.c_str(), &packed));
    check(laszip_get_header_pointer(reader_, &header_));
    check(laszip_get_point_pointer(reader_, &point_));
  }
  ~PackedPoints() {
    laszip_close_reader(reader_);
    laszip_destroy(reader_);
  }
  PackedPoints(const PackedPoints&) = delete;
  PackedPoints& operator=(const PackedPoints&) = delete;

  /// Writes the points from `first` on as rows of `stride` bytes.
  void write_rows(std::size_t first, std::size_t count, std::size_t stride, char* out) const {
    check(laszip_seek_point(reader_, static_cast<laszip_I64>(first)));
    for (std::size_t i = 0; i < count; ++i, out += stride) {
      check(laszip_read_point(reader_));
      if (row_bytes() != stride) damaged("its points differ in size from those in its header");
      write_row(out);
    }
  }

 private:
  bool has_time() const { return format() == 1 || format() >= 3; }
  bool has_colour() const {
    return format() == 2 || format() == 3 || format() == 5 || format() == 7 || format() == 8 || format() == 10;
  }
  bool has_infrared() const { return format() == 8 || format() == 10; }
  bool has_wave() const { return format() == 4 || format() == 5 || format() == 9 || format() == 10; }
  unsigned format() const { return header_->point_data_format; }

  std::size_t row_bytes() const {
    const std::size_t begin = format() < 6 ? 20 : 22;
    return begin + (has_time() ? sizeof point_->gps_time : 0) +
           sizeof(laszip_U16) * ((has_colour() ? 3u : 0u) + (has_infrared() ? 1u : 0u)) +
           (has_wave() ? sizeof point_->wave_packet : 0) + static_cast<std::size_t>(point_->num_extra_bytes);
  }

  void write_row(char* out) const {
    const laszip_point_struct& p = *point_;
    put(out, p.X), put(out, p.Y), put(out, p.Z), put(out, p.intensity);
    const int line = p.scan_direction_flag << 6 | p.edge_of_flight_line << 7;
    if (format() < 6) {
      put_byte(out, p.return_number | p.number_of_returns << 3 | line);
      put_byte(out, p.classification | p.synthetic_flag << 5 | p.keypoint_flag << 6 | p.withheld_flag << 7);
      put(out, p.scan_angle_rank), put(out, p.user_data);
    } else {
      put_byte(out, p.extended_return_number | p.extended_number_of_returns << 4);
      put_byte(out, p.extended_classification_flags | p.extended_scanner_channel << 4 | line);
      put(out, p.extended_classification), put(out, p.user_data), put(out, p.extended_scan_angle);
    }
    put(out, p.point_source_ID);
    if (has_time()) put(out, p.gps_time);
    if (has_colour()) put(out, p.rgb[0]), put(out, p.rgb[1]), put(out, p.rgb[2]);
    if (has_infrared()) put(out, p.rgb[3]);
    if (has_wave()) std::copy_n(p.wave_packet, sizeof p.wave_packet, out), out += sizeof p.wave_packet;
    std::copy_n(p.extra_bytes, p.num_extra_bytes, out);
  }

  static void put_byte(char*& out, int bits) { put(out, static_cast<std::uint8_t>(bits)); }

  void check(laszip_I32 failed) const {
    if (failed == 0) return;
    laszip_CHAR* reason = nullptr;
    laszip_get_error(reader_, &reason);
    damaged(reason ? reason : "LASzip does not say why");
  }

  [[noreturn]] void damaged(const char* reason) const {
    fail(ErrorKind::content, path_, ": cannot be unpacked (", reason,
         "); it is damaged or cut off: copy or export it again");
  }

  std::string path_;
  laszip_POINTER reader_ = nullptr;
  laszip_header_struct* header_ = nullptr;
  laszip_point_struct* point_ = nullptr;
};

ReadLimits limits_of_rows(const RowFile& file, std::size_t rows) {
  constexpr std::size_t bytes_per_second = 5 << 20;  // LASzip does five times as many
  ReadLimits limits = limits_of_file(file_size_of(file.path));
  limits.seconds += static_cast<unsigned>(std::min<std::size_t>(rows * file.stride / bytes_per_second, 100'000));
  return limits;
}

}  // namespace

RowTable unpack_rows(const RowFile& file, std::size_t first, std::size_t count) {
  const auto unpack = [](ArraySender& to, const std::string& path, std::size_t from, std::size_t rows,
                         std::size_t row) {
    expect_from_file(path, file_size_of(path), {static_cast<double>(rows), "points", static_cast<double>(row)});
    PackedPoints(path).write_rows(from, rows, row, to.take_array<char>(rows * row));
  };
  // A file without chunks is unpacked from its begin.
  ArrayReceiver sent =
      read_apart(file.path, limits_of_rows(file, first + count), unpack, file.path, first, count, file.stride);
  std::size_t bytes = 0;
  const char* const rows = sent.take_array<char>(bytes);
  return {file.columns, count, file.stride, rows, sent.owner(), file.marks};
}

}  // namespace insonify

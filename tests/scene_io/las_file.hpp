// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// LAS files, written here byte by byte from the specification.
#include "scene_io/test_files.hpp"

namespace insonify {

/// Returns a variable-length record with its head, of 54 bytes, or of 60 if it is an extended one.
inline std::string las_record(const std::string& user, int number, const std::string& body, bool extended = false) {
  std::string head(extended ? 60 : 54, '\0');
  head.replace(2, user.size(), user);
  head.replace(18, 2, bytes_of(static_cast<std::uint16_t>(number)));
  if (extended)
    head.replace(20, 8, bytes_of(std::uint64_t{body.size()}));
  else
    head.replace(20, 2, bytes_of(static_cast<std::uint16_t>(body.size())));
  return head + body;
}

struct LasFile {
  int minor = 2, format = 0;
  double scale = 0.001;
  Eigen::Vector3d offset = {500000, 5400000, -20};
  bool extra = false;  ///< true: an 'area' of uint16 in cm2, after two bytes without a meaning, and an 'id' of uint32
  int points = 0;      ///< announced points beyond those there are
  std::size_t withheld = 0;               ///< the first of so many points is withheld; 0: none
  bool normals = false;                   ///< true: upright normals after the others
  std::string normal_name = "n%";         ///< name with the axis in place of %
  std::vector<std::string> records = {};  ///< further records, with their heads
  std::function<int(std::size_t)> class_of = [](std::size_t i) { return i % 2 ? 2 : 0; };
  std::string extended = "";  ///< a record behind the points, with its head
  int pair_type = 0;          ///< type of the extra bytes 'pair', before the normals; 0: none

  std::size_t pair_bytes() const {
    constexpr std::array<std::size_t, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    const auto type = static_cast<std::size_t>(pair_type);
    return type == 0 || type > 30 ? 0 : sizes[(type - 1) % 10] * ((type - 1) / 10 + 1);
  }

  std::size_t stride() const {
    return std::array{20u, 28u, 26u, 34u, 57u, 63u, 30u, 36u, 38u, 59u, 67u}[format] + (extra ? 8u : 0u) +
           (normals ? 12u : 0u) + pair_bytes();
  }

  std::string extra_record() const {
    if (!extra && !normals && pair_type == 0) return "";
    const auto described = [](int type, int options, const std::string& name, double factor) {
      std::string d(192, '\0');
      d[2] = static_cast<char>(type);
      d[3] = static_cast<char>(options);
      d.replace(4, name.size(), name);
      d.replace(112, 8, bytes_of(factor));
      return d;
    };
    std::string body;
    if (extra) body = described(0, 2, "", 0) + described(3, 8, "area", 1e-4) + described(5, 0, "id", 0);
    if (pair_type > 0) body += described(pair_type, 8, "pair", 0.5);
    for (const char axis : {'x', 'y', 'z'})
      if (normals) body += described(9, 0, replaced(normal_name, "%", std::string(1, axis)), 0);
    return las_record("LASF_Spec", 4, body);
  }

  std::string bytes(const std::vector<Eigen::Vector3d>& positions) const {
    const std::size_t header_size = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    std::string described = extra_record();
    const auto count_of_records = static_cast<std::uint32_t>(records.size() + (described.empty() ? 0 : 1));
    for (const std::string& record : records) described += record;
    std::string h(header_size, '\0');
    const auto put = [&](std::size_t at, const std::string& value) { h.replace(at, value.size(), value); };
    put(0, "LASF");
    put(24, {1, static_cast<char>(minor)});
    put(94, bytes_of(static_cast<std::uint16_t>(header_size)));
    put(96, bytes_of(static_cast<std::uint32_t>(header_size + described.size())));
    put(100, bytes_of(count_of_records));
    put(104, std::string(1, static_cast<char>(format)));
    put(105, bytes_of(static_cast<std::uint16_t>(stride())));
    const auto count = static_cast<std::uint32_t>(positions.size() + static_cast<std::size_t>(points));
    if (minor == 4)
      put(247, bytes_of(std::uint64_t{count}));
    else
      put(107, bytes_of(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<int>(axis);
      const auto less = [&](const auto& a, const auto& b) { return a[at] < b[at]; };
      const auto [low, high] = std::minmax_element(positions.begin(), positions.end(), less);
      put(179 + 16 * axis, bytes_of((*high)[at]));
      put(187 + 16 * axis, bytes_of((*low)[at]));
      put(131 + 8 * axis, bytes_of(scale));
      put(155 + 8 * axis, bytes_of(offset[static_cast<int>(axis)]));
    }
    std::string rows;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      std::string row(stride(), '\0');
      for (int axis = 0; axis < 3; ++axis)
        row.replace(4 * static_cast<std::size_t>(axis), 4,
                    bytes_of(static_cast<std::int32_t>(std::lround((positions[i] - offset)[axis] / scale))));
      // Up to format 5 the upper bits of the class are flags.
      row[format < 6 ? 15 : 16] = static_cast<char>(class_of(i) | (format < 6 ? 0x20 : 0));
      // A synthetic point, as above, is not withheld.
      if (format >= 6) row[15] = 1;
      if (withheld > 0 && i % withheld == 0) row[15] = static_cast<char>(row[15] | (format < 6 ? 0x80 : 4));
      if (extra) {
        row.replace(stride() - 6, 2, bytes_of(static_cast<std::uint16_t>(100 + i)));
        row.replace(stride() - 4, 4, bytes_of(static_cast<std::uint32_t>(1000 + i)));
      }
      if (normals) row.replace(stride() - 4, 4, bytes_of(1.0F));
      rows += row;
    }
    if (!extended.empty()) {
      h.replace(235, 8, bytes_of(std::uint64_t{h.size() + described.size() + rows.size()}));
      h.replace(243, 4, bytes_of(std::uint32_t{1}));
    }
    return h + described + rows + extended;
  }
};

}  // namespace insonify

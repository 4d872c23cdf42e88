// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/pending_file.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/ply_header_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

/// Throws Error(runtime) unless the header of a written file names the columns of its rows.
void check_header(const std::string& path, const std::string& written, bool ply, const PackedRows& rows) {
  if (rows.rows == 0) return;
  const std::string wanted = joined(rows.columns, " ", &PackedRows::Column::name);
  const std::string found = ply ? joined(probe_ply(written).vertex().properties, " ", &PlyProperty::name)
                                : joined(find_pcd_rows(written).value().columns, " ", &RowTable::Column::name);
  if (found != wanted)
    fail(ErrorKind::runtime, path, ": its header was written with the columns '", wanted, "' and reads back as '",
         found, "'; rename the columns of the input");
}

}  // namespace

void write_rows(const std::string& path, const std::string& header, const PackedRows& rows) {
  PendingFile pending(path);
  errno = 0;
  std::ofstream file(pending.temporary(), std::ios::binary);
  file << header;
  constexpr std::size_t block = 1 << 12;  // rows that fit into a cache
  const std::size_t stride = rows.stride();
  std::vector<char> bytes(block * stride);
  for (std::size_t first = 0; first < rows.rows && file; first += block) {
    const std::size_t count = std::min(block, rows.rows - first);
    rows.write(first, count, bytes.data());
    file.write(bytes.data(), static_cast<std::streamsize>(count * stride));
  }
  // Append the faces of a PLY: the number of their corners, and the corners.
  constexpr std::size_t face = 1 + 3 * sizeof(std::uint32_t);
  bytes.resize(block * face);
  for (std::size_t first = 0; first < rows.triangles.size() && file; first += block) {
    char* out = bytes.data();
    const std::size_t count = std::min(block, rows.triangles.size() - first);
    for (const auto& triangle : rows.triangles.subspan(first, count)) {
      put(out, std::uint8_t{3});
      for (const std::uint32_t corner : triangle) put(out, corner);
    }
    file.write(bytes.data(), static_cast<std::streamsize>(count * face));
  }
  file.flush();
  if (file) check_header(path, pending.temporary(), header.starts_with("ply"), rows);
  pending.commit(file);
}

}  // namespace insonify

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "core/pending_file.hpp"
#include "scene_io/write_rows_internal.hpp"

namespace insonify {

void write_rows(const std::string& path, const std::string& header, const PackedRows& rows) {
  PendingFile pending(path);
  errno = 0;
  std::ofstream file(pending.temporary(), std::ios::binary);
  file << header;
  constexpr std::size_t block = 1 << 15;
  const std::size_t stride = rows.stride();
  std::vector<char> bytes(block * stride);
  for (std::size_t first = 0; first < rows.rows && file; first += block) {
    const std::size_t count = std::min(block, rows.rows - first);
    for (std::size_t i = 0; i < count; ++i) rows.write_row(first + i, bytes.data() + i * stride);
    file.write(bytes.data(), static_cast<std::streamsize>(count * stride));
  }
  pending.commit(file);
}

}  // namespace insonify

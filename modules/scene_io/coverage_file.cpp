// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/coverage_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <queue>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/row_file_internal.hpp"

namespace insonify {
namespace {

constexpr const char* no_coverage = "is not the coverage of a survey";
constexpr std::size_t joined_bytes = 64 << 20;  // memory for all parts together

const std::vector<PackedRows::Column>& coverage_columns() {
  static const std::vector<PackedRows::Column> columns = {{"x", NumberType::float64},
                                                          {"y", NumberType::float64},
                                                          {"z", NumberType::float64},
                                                          {"scalar_intensity", NumberType::float64},
                                                          {"scalar_level_db", NumberType::float32},
                                                          {"scalar_grazing_deg", NumberType::float32},
                                                          {"scalar_range", NumberType::float32},
                                                          {"scalar_pings", NumberType::uint32},
                                                          {"scalar_id", NumberType::uint32}};
  return columns;
}

void put_row(const CoveredSurfel& s, char* out) {
  for (const double coordinate : s.position) put(out, coordinate);
  put(out, s.intensity);
  put(out, static_cast<float>(db_from_power(s.intensity / (micropascal * micropascal))));
  put(out, static_cast<float>(degrees(static_cast<double>(s.grazing_angle))));
  put(out, s.range);
  put(out, s.pings);
  put(out, s.id);
}

CoveredSurfel row_at(const char* row) {
  CoveredSurfel s;
  for (int k = 0; k < 3; ++k) s.position[k] = read_as<double>(row + 8 * k);
  s.intensity = read_as<double>(row + 24);
  s.grazing_angle = static_cast<float>(radians(static_cast<double>(read_as<float>(row + 36))));
  s.range = read_as<float>(row + 40);
  s.pings = read_as<std::uint32_t>(row + 44);
  s.id = read_as<std::uint32_t>(row + 48);
  return s;
}

/// Reads the surfels of a part in batches, one after the other.
class CoverageReader {
 public:
  CoverageReader(const std::string& path, std::size_t batch)
      : file_(rows_of_ply(path, no_coverage)), batch_(std::max<std::size_t>(64, batch)) {
    if (!same_columns(file_.columns, coverage_columns())) fail(ErrorKind::content, path, ": ", no_coverage);
  }
  std::optional<CoveredSurfel> next() {
    if (next_ == file_.rows) return std::nullopt;
    if (next_ >= begin_ + rows_.rows) {
      begin_ = next_;
      rows_ = read_rows(file_, begin_, std::min(batch_, file_.rows - begin_));
    }
    return row_at(rows_.bytes + (next_++ - begin_) * rows_.stride);
  }

 private:
  RowFile file_;
  RowTable rows_;
  std::size_t batch_, begin_ = 0, next_ = 0;
};

/// Calls use(surfel) for every surfel of all parts by ascending id, with its entries added up.
template <typename Use>
void each_joined(const std::vector<std::string>& parts, const Use& use) {
  const std::size_t batch = joined_bytes / (52 * parts.size());
  std::vector<CoverageReader> readers;
  readers.reserve(parts.size());
  using Head = std::pair<std::uint32_t, std::size_t>;  // id, and index of the part
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heads;
  std::vector<std::optional<CoveredSurfel>> first;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    first.push_back(readers.emplace_back(parts[p], batch).next());
    if (first[p]) heads.emplace(first[p]->id, p);
  }
  std::optional<CoveredSurfel> sum;
  while (!heads.empty()) {
    const auto [id, p] = heads.top();
    heads.pop();
    if (sum && sum->id == id) {
      add(*sum, *first[p]);
    } else {
      if (sum) use(*sum);
      sum = first[p];
    }
    first[p] = readers[p].next();
    if (first[p] && first[p]->id <= id)
      fail(ErrorKind::content, parts[p], ": ids do not ascend; make the survey again");
    if (first[p]) heads.emplace(first[p]->id, p);
  }
  if (sum) use(*sum);
}

/// Writes `rows` surfels. make(use) passes them to use(surfel).
template <typename Make>
void write_coverage(const std::string& path, std::size_t rows, const Make& make) {
  PackedRows packed;
  packed.columns = coverage_columns();
  packed.rows = rows;
  PendingFile pending(path);
  errno = 0;
  std::ofstream file(pending.temporary(), std::ios::binary);
  file << ply_header(packed);
  std::vector<char> row(packed.stride());
  make([&](const CoveredSurfel& s) {
    put_row(s, row.data());
    file.write(row.data(), static_cast<std::streamsize>(row.size()));
  });
  pending.commit(file);
}

}  // namespace

void save_coverage(const std::string& path, const std::vector<CoveredSurfel>& covered) {
  for (std::size_t i = 1; i < covered.size(); ++i)
    if (covered[i].id <= covered[i - 1].id)
      fail(ErrorKind::argument, "save_coverage: covered[", i, "].id = ", covered[i].id, ", must ascend");
  write_coverage(path, covered.size(), [&](const auto& use) { std::for_each(covered.begin(), covered.end(), use); });
}

void join_coverage(const std::string& path, const std::vector<std::string>& parts) {
  if (parts.empty()) fail(ErrorKind::argument, "join_coverage: ", path, ": no parts, must be at least one");
  std::size_t rows = 0;  // the header needs their number
  each_joined(parts, [&](const CoveredSurfel&) { ++rows; });
  write_coverage(path, rows, [&](const auto& use) { each_joined(parts, use); });
}

}  // namespace insonify

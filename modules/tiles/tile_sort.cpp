// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"
#include "tiles/tile_sort_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t chunk = 1 << 15;        // records read or written at once
constexpr std::uint64_t cells_per_axis = 16;  // most cells of one subdivision
constexpr std::size_t cells = cells_per_axis * cells_per_axis * cells_per_axis;
constexpr std::size_t sorted_at_once = 1 << 14;  // records that one thread sorts

/// Aligned cells over a box, numbered along the curve.
class Cells {
 public:
  void enclose(const CurvePosition& position) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      low_[axis] = std::min(low_[axis], position[axis]), high_[axis] = std::max(high_[axis], position[axis]);
  }
  bool is_one_place() const { return low_ == high_; }
  /// Numbers the cells, after all positions are enclosed.
  void number() {
    const auto wide = [&](std::size_t axis) {
      return (high_[axis] >> shift_) - (low_[axis] >> shift_) >= cells_per_axis;
    };
    while (wide(0) || wide(1) || wide(2)) ++shift_;
    std::vector<std::size_t> order(cells);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return MortonCurve::before(corner(a), corner(b)); });
    for (std::size_t k = 0; k < cells; ++k) number_[order[k]] = static_cast<std::uint32_t>(k);
  }
  std::size_t cell(const CurvePosition& position) const {
    std::size_t index = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      index = index * cells_per_axis + ((position[axis] >> shift_) - (low_[axis] >> shift_));
    return number_[index];
  }

 private:
  CurvePosition corner(std::size_t index) const {
    return {(low_[0] >> shift_) + index / (cells_per_axis * cells_per_axis),
            (low_[1] >> shift_) + index / cells_per_axis % cells_per_axis,
            (low_[2] >> shift_) + index % cells_per_axis};
  }

  CurvePosition low_{~std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0}}, high_{};
  int shift_ = 0;
  std::array<std::uint32_t, cells> number_{};
};

/// A range of records of a file.
struct Segment {
  std::uint64_t first = 0, count = 0;
};

template <typename Body>
void for_each_record(const RecordFile& file, Segment segment, const CurveSort& sort, const Body& body) {
  for (std::uint64_t done = 0; done < segment.count; done += chunk) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(chunk, segment.count - done));
    for (const TileRecord& record : file.read(segment.first + done, count))
      body(record, sort.curve.at(record.position));
    sort.moved(count);
  }
}

/// Groups runs of cells with at most `most` records in total, or single cells with more. Sets the group of each cell.
std::vector<Segment> plan_parts(const std::array<std::uint64_t, cells>& counts, std::size_t most,
                                std::array<std::uint32_t, cells>& block_of_cell) {
  std::vector<Segment> parts;
  for (std::size_t c = 0; c < cells; ++c) {
    if (parts.empty() || (parts.back().count > 0 && parts.back().count + counts[c] > most))
      parts.push_back({parts.empty() ? 0 : parts.back().first + parts.back().count, 0});
    parts.back().count += counts[c];
    block_of_cell[c] = static_cast<std::uint32_t>(parts.size() - 1);
  }
  return parts;
}

/// Copies a segment into `to`, each record to its group.
void distribute(const RecordFile& from, Segment segment, const Cells& grid, const CurveSort& sort,
                const std::array<std::uint32_t, cells>& block_of_cell, std::vector<Segment> parts, RecordFile& to) {
  const std::size_t room = std::max<std::size_t>(16, std::min(chunk, sort.most / parts.size()));
  std::vector<std::vector<TileRecord>> waiting(parts.size());
  const auto write_out = [&](std::size_t p) {
    to.write(parts[p].first, waiting[p]);
    parts[p].first += waiting[p].size();
    waiting[p].clear();
  };
  for_each_record(from, segment, sort, [&](const TileRecord& record, const CurvePosition& at) {
    const std::size_t p = block_of_cell[grid.cell(at)];
    waiting[p].push_back(record);
    if (waiting[p].size() == room) write_out(p);
  });
  for (std::size_t p = 0; p < parts.size(); ++p) write_out(p);
}

/// Returns the records of a segment that fits into memory, sorted along the curve.
std::vector<PlacedRecord> sorted(const RecordFile& file, Segment segment, const CurveSort& sort) {
  std::vector<PlacedRecord> group;
  group.reserve(segment.count);
  for_each_record(file, segment, sort, [&](const TileRecord& record, const CurvePosition& at) {
    group.push_back({at, record});
  });
  const auto before = [](const PlacedRecord& a, const PlacedRecord& b) {
    return a.at == b.at ? a.record.id < b.record.id : MortonCurve::before(a.at, b.at);
  };
  const auto at = [&](std::size_t k) { return group.begin() + static_cast<std::ptrdiff_t>(std::min(k, group.size())); };
  parallel_blocks(group.size(), sorted_at_once, sort.threads,
                  [&](std::size_t begin, std::size_t end) { std::sort(at(begin), at(end), before); });
  for (std::size_t width = sorted_at_once; width < group.size(); width *= 2)
    parallel_blocks(group.size(), 2 * width, sort.threads, [&](std::size_t begin, std::size_t end) {
      std::inplace_merge(at(begin), at(begin + width), at(end), before);
    });
  return group;
}

void visit(std::shared_ptr<const RecordFile> file, Segment segment, const CurveSort& sort) {
  if (segment.count == 0) return;
  if (segment.count <= sort.most) return sort.take(sorted(*file, segment, sort));
  Cells grid;
  for_each_record(*file, segment, sort, [&](const TileRecord&, const CurvePosition& at) { grid.enclose(at); });
  if (grid.is_one_place()) {
    for (std::uint64_t done = 0; done < segment.count; done += sort.most)
      sort.take(sorted(*file, {segment.first + done, std::min<std::uint64_t>(sort.most, segment.count - done)}, sort));
    return;
  }
  grid.number();
  std::array<std::uint64_t, cells> counts{};
  for_each_record(*file, segment, sort, [&](const TileRecord&, const CurvePosition& at) { ++counts[grid.cell(at)]; });
  std::array<std::uint32_t, cells> block_of_cell{};
  const std::vector<Segment> parts = plan_parts(counts, sort.most, block_of_cell);
  const auto divided = std::make_shared<RecordFile>(file->path());
  distribute(*file, segment, grid, sort, block_of_cell, parts, *divided);
  file.reset();  // releases the disk space after the last use
  for (const Segment& part : parts) visit(divided, part, sort);
}

}  // namespace

void RecordFile::append(const TileRecord& record) {
  buffer_.push_back(record);
  if (buffer_.size() == chunk) flush();
}

void RecordFile::flush() {
  write(size_, buffer_);
  size_ += buffer_.size();
  buffer_.clear();
}

std::vector<TileRecord> RecordFile::read(std::uint64_t first, std::size_t count) const {
  std::vector<TileRecord> records(count);
  file_.read(first * sizeof(TileRecord), bytes_in(records));
  return records;
}

void RecordFile::write(std::uint64_t first, std::span<const TileRecord> records) {
  file_.write(first * sizeof(TileRecord),
              {reinterpret_cast<const char*>(records.data()), records.size() * sizeof(TileRecord)});
}

MortonCurve::MortonCurve(double largest, bool single)
    : cells_per_metre_(std::ldexp(1.0, 51 - std::ilogb(std::max(largest, 1e-3)))), single_(single) {}

CurvePosition MortonCurve::at(const double (&position)[3]) const {
  constexpr double middle = 0x1p52;
  CurvePosition result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double p = single_ ? static_cast<double>(static_cast<float>(position[axis])) : position[axis];
    result[axis] = static_cast<std::uint64_t>(std::floor(p * cells_per_metre_) + middle);
  }
  return result;
}

std::size_t MortonCurve::highest(const CurvePosition& a, const CurvePosition& b) {
  std::size_t axis = 2;
  for (const std::size_t other : {std::size_t{1}, std::size_t{0}}) {
    const std::uint64_t most = a[axis] ^ b[axis], bits = a[other] ^ b[other];
    if (most < bits && most < (most ^ bits)) axis = other;  // the highest bit of `bits` is higher
  }
  return axis;
}

void sort_along_curve(std::unique_ptr<RecordFile> file, const CurveSort& sort) {
  file->flush();
  const std::uint64_t count = file->size();
  visit(std::shared_ptr<const RecordFile>(std::move(file)), {0, count}, sort);
}

}  // namespace insonify

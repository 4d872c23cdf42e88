// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "core/morton.hpp"
#include "scene_io/tile_sort_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t chunk = 1 << 15;        // records read or written at once
constexpr std::uint32_t cells_per_axis = 16;  // of one subdivision
constexpr std::size_t cells = 4096;

using Place = Eigen::Map<const Eigen::Vector3d>;

// Cubic cells over a box, numbered along a Morton curve, so that cells with adjacent numbers are neighbours.
struct Cells {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = Eigen::Vector3d::Constant(-1e300);

  void enclose(const TileRecord& record) {
    low = low.cwiseMin(Place(record.place));
    high = high.cwiseMax(Place(record.place));
  }
  double extent() const { return (high - low).maxCoeff(); }
  std::size_t cell(const TileRecord& record) const {
    std::array<std::uint32_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = (record.place[axis] - low[axis]) / extent() * cells_per_axis;
      place[axis] = std::min(static_cast<std::uint32_t>(step), cells_per_axis - 1);
    }
    return morton_code(place);
  }
};

// A range of records of a file.
struct Segment {
  std::uint64_t first = 0, count = 0;
};

template <typename Body>
void for_each_record(const RecordFile& file, Segment segment, const PlaceSort& sort, const Body& body) {
  for (std::uint64_t done = 0; done < segment.count; done += chunk) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(chunk, segment.count - done));
    for (const TileRecord& record : file.read(segment.first + done, count)) body(record);
    sort.moved(count);
  }
}

// Groups runs of cells with at most `most` records in total, or single cells with more; also returns the group of each
// cell.
std::vector<Segment> plan_parts(const std::array<std::uint64_t, cells>& counts, std::size_t most,
                                std::array<std::uint32_t, cells>& part_of_cell) {
  std::vector<Segment> parts;
  for (std::size_t c = 0; c < cells; ++c) {
    if (parts.empty() || (parts.back().count > 0 && parts.back().count + counts[c] > most))
      parts.push_back({parts.empty() ? 0 : parts.back().first + parts.back().count, 0});
    parts.back().count += counts[c];
    part_of_cell[c] = static_cast<std::uint32_t>(parts.size() - 1);
  }
  return parts;
}

// Copies a segment into `to`, each record to its group, preserving order.
void distribute(const RecordFile& from, Segment segment, const Cells& grid, const PlaceSort& sort,
                const std::array<std::uint32_t, cells>& part_of_cell, std::vector<Segment> parts, RecordFile& to) {
  const std::size_t room = std::max<std::size_t>(16, std::min(chunk, sort.most / parts.size()));
  std::vector<std::vector<TileRecord>> waiting(parts.size());
  const auto write_out = [&](std::size_t p) {
    to.write(parts[p].first, waiting[p]);
    parts[p].first += waiting[p].size();
    waiting[p].clear();
  };
  for_each_record(from, segment, sort, [&](const TileRecord& record) {
    const std::size_t p = part_of_cell[grid.cell(record)];
    waiting[p].push_back(record);
    if (waiting[p].size() == room) write_out(p);
  });
  for (std::size_t p = 0; p < parts.size(); ++p) write_out(p);
}

void visit(std::shared_ptr<const RecordFile> file, Segment segment, const PlaceSort& sort) {
  if (segment.count == 0) return;
  Cells grid;
  if (segment.count > sort.most)
    for_each_record(*file, segment, sort, [&](const TileRecord& record) { grid.enclose(record); });
  if (segment.count <= sort.most || !(grid.extent() > 0)) {  // fits in memory, or cannot be divided
    for (std::uint64_t done = 0; done < segment.count; done += sort.most) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(sort.most, segment.count - done));
      std::vector<TileRecord> group = file->read(segment.first + done, count);
      sort.moved(count);
      sort.take(group);
    }
    return;
  }
  std::array<std::uint64_t, cells> counts{};
  for_each_record(*file, segment, sort, [&](const TileRecord& record) { ++counts[grid.cell(record)]; });
  std::array<std::uint32_t, cells> part_of_cell{};
  const std::vector<Segment> parts = plan_parts(counts, sort.most, part_of_cell);
  const auto divided = std::make_shared<RecordFile>(file->path());
  distribute(*file, segment, grid, sort, part_of_cell, parts, *divided);
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

void sort_by_place(std::unique_ptr<RecordFile> file, const PlaceSort& sort) {
  file->flush();
  const std::uint64_t count = file->size();
  visit(std::shared_ptr<const RecordFile>(std::move(file)), {0, count}, sort);
}

}  // namespace insonify

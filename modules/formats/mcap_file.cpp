// SPDX-License-Identifier: BSD-3-Clause
#include "formats/mcap_file.hpp"

#include <algorithm>

#include "files/pending_file.hpp"
#include "formats/mcap_compression_internal.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr char mcap_magic[] = "\x89MCAP0\r\n";
constexpr std::string_view magic_bytes(mcap_magic, 8);
constexpr std::size_t chunk_size = 1 << 20;
enum McapRecord : std::uint8_t {
  mcap_header = 1,
  mcap_footer = 2,
  mcap_schema = 3,
  mcap_channel = 4,
  mcap_message = 5,
  mcap_chunk = 6,
  mcap_message_index = 7,
  mcap_chunk_index = 8,
  mcap_statistics = 11,
  mcap_metadata = 12,
  mcap_metadata_index = 13,
  mcap_summary_offset = 14,
  mcap_data_end = 15
};

std::string mcap_record(McapRecord kind, const std::string& content) {
  std::string bytes(1, static_cast<char>(kind));
  put_little(bytes, static_cast<std::uint64_t>(content.size()));
  return bytes + content;
}

void put_text(std::string& bytes, std::string_view text) {
  put_little(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

void put_pairs(std::string& bytes, const std::map<std::string, std::string>& map) {
  std::string pairs;
  for (const auto& [key, value] : map) put_text(pairs, key), put_text(pairs, value);
  put_text(bytes, pairs);
}

}  // namespace

McapFile::McapFile(const std::string& path, McapCompression compression)
    : pending_(std::make_shared<PendingFile>(path)),
      out_(pending_->temporary(), std::ios::binary),
      compression_(compression) {
  if (!has_compression(compression)) compressed(compression, "");
  std::string header;
  put_text(header, "ros2");
  put_text(header, "insonify");
  write(std::string(magic_bytes) + mcap_record(mcap_header, header));
}

void McapFile::write(std::string_view bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  written_ += bytes.size();
  crc_ = crc_32(bytes, crc_);
}

std::uint16_t McapFile::add_topic(const std::string& topic, const std::string& type, const std::string& text,
                                  const std::map<std::string, std::string>& metadata) {
  const auto number = static_cast<std::uint16_t>(topics_.size() + 1);
  std::string schema, channel;
  put_little(schema, number);
  put_text(schema, type);
  put_text(schema, "ros2msg");
  put_text(schema, text);
  put_little(channel, number);
  put_little(channel, number);
  put_text(channel, topic);
  put_text(channel, "cdr");
  put_pairs(channel, metadata);
  topics_.push_back({mcap_record(mcap_schema, schema), mcap_record(mcap_channel, channel)});
  return number;
}

void McapFile::add_metadata(const std::string& name, const std::map<std::string, std::string>& pairs) {
  std::string content;
  put_text(content, name);
  put_pairs(content, pairs);
  const std::string record = mcap_record(mcap_metadata, content);
  metadata_.push_back({name, written_, record.size()});
  write(record);
}

void McapFile::add(std::uint16_t topic, std::uint64_t time, std::string_view message) {
  if (records_.empty() && chunks_.empty())
    for (const Topic& each : topics_) records_ += each.schema + each.channel;
  first_ = index_.empty() ? time : std::min(first_, time);
  last_ = index_.empty() ? time : std::max(last_, time);
  index_[topic].emplace_back(time, records_.size());
  std::string content;
  put_little(content, topic);
  put_little(content, topics_[topic - 1u].messages++);
  put_little(content, time);
  put_little(content, time);
  content.append(message);
  records_ += mcap_record(mcap_message, content);
  if (records_.size() >= chunk_size) end_chunk();
}

void McapFile::end_chunk() {
  if (records_.empty()) return;
  const std::string packed = compressed(compression_, records_);
  Chunk chunk{first_, last_, written_, 0, 0, records_.size(), packed.size(), {}};
  std::string content;
  put_little(content, first_);
  put_little(content, last_);
  put_little(content, static_cast<std::uint64_t>(records_.size()));
  put_little(content, crc_32(records_));
  put_text(content, mcap_compression_name(compression_));
  put_little(content, static_cast<std::uint64_t>(packed.size()));
  write(mcap_record(mcap_chunk, content + packed));
  chunk.length = written_ - chunk.start;
  for (const auto& [topic, entries] : index_) {
    chunk.index_of[topic] = written_;
    std::string pairs, index;
    for (const auto& [time, offset] : entries) put_little(pairs, time), put_little(pairs, offset);
    put_little(index, topic);
    put_text(index, pairs);
    write(mcap_record(mcap_message_index, index));
  }
  chunk.index_length = written_ - chunk.start - chunk.length;
  chunks_.push_back(chunk);
  records_.clear();
  index_.clear();
}

std::string McapFile::metadata_indexes() const {
  std::string indexes;
  for (const Metadata& each : metadata_) {
    std::string content;
    put_little(content, each.start);
    put_little(content, each.length);
    put_text(content, each.name);
    indexes += mcap_record(mcap_metadata_index, content);
  }
  return indexes;
}

/// Returns all records between data and footer: groups of records, and the offsets of the groups.
std::string McapFile::summary() const {
  std::string schemas, channels, indexes, counts, statistics;
  std::uint64_t messages = 0, first = 0, last = 0;
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    schemas += topics_[i].schema;
    channels += topics_[i].channel;
    put_little(counts, static_cast<std::uint16_t>(i + 1));
    put_little(counts, std::uint64_t{topics_[i].messages});
    messages += topics_[i].messages;
  }
  for (const Chunk& chunk : chunks_) {
    first = &chunk == &chunks_.front() ? chunk.first : std::min(first, chunk.first);
    last = std::max(last, chunk.last);
    std::string content, offsets;
    for (const std::uint64_t number : {chunk.first, chunk.last, chunk.start, chunk.length}) put_little(content, number);
    for (const auto& [topic, offset] : chunk.index_of) put_little(offsets, topic), put_little(offsets, offset);
    put_text(content, offsets);
    put_little(content, chunk.index_length);
    put_text(content, mcap_compression_name(compression_));
    put_little(content, chunk.packed);
    put_little(content, chunk.size);
    indexes += mcap_record(mcap_chunk_index, content);
  }
  put_little(statistics, messages);
  put_little(statistics, static_cast<std::uint16_t>(topics_.size()));
  put_little(statistics, static_cast<std::uint32_t>(topics_.size()));
  put_little(statistics, std::uint32_t{0});  // attachments
  put_little(statistics, static_cast<std::uint32_t>(metadata_.size()));
  put_little(statistics, static_cast<std::uint32_t>(chunks_.size()));
  put_little(statistics, first);
  put_little(statistics, last);
  put_text(statistics, counts);

  std::string bytes, offsets;
  for (const auto& [kind, group] :
       {std::pair(mcap_schema, schemas), std::pair(mcap_channel, channels), std::pair(mcap_chunk_index, indexes),
        std::pair(mcap_metadata_index, metadata_indexes()),
        std::pair(mcap_statistics, mcap_record(mcap_statistics, statistics))}) {
    if (group.empty()) continue;
    std::string offset(1, static_cast<char>(kind));
    put_little(offset, written_ + bytes.size());
    put_little(offset, static_cast<std::uint64_t>(group.size()));
    bytes += group;
    offsets += mcap_record(mcap_summary_offset, offset);
  }
  const std::uint64_t offset_start = written_ + bytes.size();
  bytes += offsets;
  // The CRC of the summary counts the footer up to itself.
  bytes.push_back(static_cast<char>(mcap_footer));
  put_little(bytes, std::uint64_t{8 + 8 + 4});
  put_little(bytes, written_);
  put_little(bytes, offset_start);
  put_little(bytes, crc_32(bytes));
  return bytes;
}

void McapFile::finish() {
  end_chunk();
  std::string end;
  put_little(end, crc_);
  write(mcap_record(mcap_data_end, end));
  write(summary());
  write(magic_bytes);
  pending_->commit(out_);
}

}  // namespace insonify

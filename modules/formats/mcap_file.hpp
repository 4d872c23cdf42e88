// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

class PendingFile;

/// Compression of chunks: none, or one frame of LZ4 or of Zstandard.
enum class McapCompression : std::uint8_t { none, lz4, zstd };

/// Returns true if this build has the library of a compression.
bool has_compression(McapCompression compression);

/// Writes messages of ROS 2 as an MCAP file (mcap.dev, profile ros2). Chunks of about 1 MiB have a CRC and an index of
/// their messages. A summary holds schemas, channels, chunk indexes, statistics, and CRCs of data and summary. Messages
/// stream. The same messages give the same bytes.
class McapFile {
 public:
  /// Throws Error(file) if the file cannot be made, Error(argument) for a compression that this build lacks.
  explicit McapFile(const std::string& path, McapCompression compression = McapCompression::none);
  /// Writes a metadata record of the whole file, before the first message.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& pairs);
  /// Adds a topic with messages of `type` (package/msg/Name) in CDR; `text` is the definition of the type. Returns the
  /// number of the topic. All topics must be added before the first message.
  std::uint16_t add_topic(const std::string& topic, const std::string& type, const std::string& text,
                          const std::map<std::string, std::string>& metadata = {});
  /// Adds a message sent at `time` [ns since 1970].
  void add(std::uint16_t topic, std::uint64_t time, std::string_view message);
  /// Writes the summary. Throws Error(file) if not all could be written.
  void finish();

 private:
  struct Topic {
    std::string schema, channel;  ///< encoded records
    std::uint32_t messages = 0;
  };
  struct Chunk {
    std::uint64_t first = 0, last = 0, start = 0, length = 0, index_length = 0, size = 0, packed = 0;
    std::map<std::uint16_t, std::uint64_t> index_of;  ///< offset of each topic's message index
  };
  struct Metadata {
    std::string name;
    std::uint64_t start, length;
  };
  void write(std::string_view bytes);
  void end_chunk();
  std::string metadata_indexes() const;
  std::string summary() const;

  std::shared_ptr<PendingFile> pending_;
  std::ofstream out_;
  McapCompression compression_;
  std::uint64_t written_ = 0;
  std::uint32_t crc_ = 0;
  std::vector<Topic> topics_;
  std::vector<Chunk> chunks_;
  std::vector<Metadata> metadata_;
  std::string records_;                                                                  ///< records of the open chunk
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index_;  ///< times, offsets by topic
  std::uint64_t first_ = 0, last_ = 0;                                                   ///< first and last time there
};

}  // namespace insonify

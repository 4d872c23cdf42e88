#pragma once
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/pending_file.hpp"

namespace insonify {

/// Writes messages of ROS 2 as an MCAP file (mcap.dev, profile ros2): chunks of about 1 MiB, not compressed, each with its
/// CRC and an index of its messages; a summary with schemas, channels, chunk indexes and statistics, and CRCs of data and
/// summary. Messages stream. The same messages give the same bytes.
class McapFile {
 public:
  /// Throws Error(file) if the file cannot be made.
  explicit McapFile(const std::string& path);
  /// Adds a topic with messages of `type` (package/msg/Name) in CDR, whose definition is `text`; returns its number.
  /// All topics come before the first message.
  std::uint16_t add_topic(const std::string& topic, const std::string& type, const std::string& text,
                          const std::map<std::string, std::string>& metadata = {});
  /// Adds a message sent at `time` [ns since 1970].
  void add(std::uint16_t topic, std::uint64_t time, std::string_view message);
  /// Writes the summary. Throws Error(file) if not all could be written.
  void finish();

 private:
  struct Topic {
    std::string schema, channel;  ///< their records
    std::uint32_t messages = 0;
  };
  struct Chunk {
    std::uint64_t first = 0, last = 0, start = 0, length = 0, index_length = 0, size = 0;
    std::map<std::uint16_t, std::uint64_t> index_of;  ///< places of its message indexes
  };
  void write(std::string_view bytes);
  void end_chunk();
  std::string summary() const;

  PendingFile pending_;
  std::ofstream out_;
  std::uint64_t written_ = 0;
  std::uint32_t crc_ = 0;
  std::vector<Topic> topics_;
  std::vector<Chunk> chunks_;
  std::string records_;                                                                  ///< of the open chunk
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index_;  ///< of it: times and places
  std::uint64_t first_ = 0, last_ = 0;                                                   ///< times in it
};

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A decoder of MCAP and of ROS 2 messages in CDR, from their specifications: messages are read by the definitions that
// the file itself holds.
#include <algorithm>
#include <any>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "formats/file_cursor.hpp"
#include "returns/bottom_detection.hpp"

namespace insonify::decode {

inline std::uint32_t reference_crc(const std::string& bytes) {  // bit by bit
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

/// All numbers and texts of a message by name, as "image.data" or "transforms[1].header.frame_id"; numbers of a
/// sequence in one list.
struct RosMessage {
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;
  double one(const std::string& name) const { return numbers.at(name).at(0); }
};

struct RosField {
  std::string type, name;
  bool many;
  std::size_t fixed;  ///< length of a fixed array; else 0
};
using RosTypes = std::map<std::string, std::vector<RosField>>;

/// Returns the types of a definition: first that of the message, others behind lines of '='.
inline RosTypes ros_types(const std::string& name, const std::string& text) {
  RosTypes types;
  std::string current = name.substr(0, name.find('/')) + name.substr(name.rfind('/'));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("====")) {
      if (line.size() != 80) throw std::runtime_error("separator of another length");
      continue;
    }
    if (line.starts_with("MSG: ")) {
      current = line.substr(5);
      continue;
    }
    std::istringstream words(line);
    RosField field{};
    if (!(words >> field.type >> field.name) || field.name.find('=') != std::string::npos) continue;
    if (const std::size_t at = field.type.find('['); at != std::string::npos && !field.type.ends_with("[]")) {
      field.fixed = std::stoul(field.type.substr(at + 1));
      field.type.resize(at);
    }
    field.many = field.type.ends_with("[]");
    if (field.many) field.type.resize(field.type.size() - 2);
    types[current].push_back(field);
  }
  return types;
}

class CdrReader {
 public:
  CdrReader(const std::string& bytes, const RosTypes& types) : bytes_(bytes), cursor_(bytes), types_(types) {
    if (cursor_.text(4) != std::string("\0\1\0\0", 4)) throw std::runtime_error("not little-endian CDR");
  }
  RosMessage read(const std::string& type) {
    compound(type, "");
    if (!cursor_.done()) throw std::runtime_error("bytes left over");
    return std::move(message_);
  }

 private:
  void compound(const std::string& type, const std::string& prefix) {
    for (const RosField& field : types_.at(type)) {
      const std::string name = prefix + field.name;
      if (field.fixed > 0) {
        for (std::size_t i = 0; i < field.fixed; ++i) value(field.type, name);
        continue;
      }
      if (!field.many) {
        value(field.type, name);
        continue;
      }
      const std::uint64_t count = number("uint32");
      const bool plain = !types_.contains(field.type) && field.type != "string";
      if (plain) message_.numbers[name];
      for (std::uint64_t i = 0; i < count; ++i) value(field.type, plain ? name : name + "[" + std::to_string(i) + "]");
    }
  }
  void value(const std::string& type, const std::string& name) {
    if (type == "string") {
      const std::uint64_t size = number("uint32");
      message_.texts[name] = cursor_.text(size - 1);
      if (cursor_.text(1)[0] != 0) throw std::runtime_error("text without its end");
    } else if (types_.contains(type)) {
      compound(type, name + ".");
    } else if (type == "float64" || type == "float32") {
      align(type == "float64" ? 8 : 4);
      message_.numbers[name].push_back(type == "float64" ? cursor_.float64() : static_cast<double>(cursor_.float32()));
    } else if (type == "int32" || type == "int8") {
      const int size = type == "int32" ? 4 : 1;
      align(static_cast<std::size_t>(size));
      message_.numbers[name].push_back(static_cast<double>(cursor_.signed_little(size)));
    } else {
      message_.numbers[name].push_back(static_cast<double>(number(type)));
    }
  }
  std::uint64_t number(const std::string& type) {
    const int size = type == "uint32"                    ? 4
                     : type == "uint16"                  ? 2
                     : type == "uint8" || type == "bool" ? 1
                                                         : throw std::runtime_error(type);
    align(static_cast<std::size_t>(size));
    return cursor_.unsigned_little(size);
  }
  void align(std::size_t size) { cursor_.text((size - (cursor_.at() - 4) % size) % size); }

  const std::string& bytes_;
  Cursor cursor_;
  const RosTypes& types_;
  RosMessage message_;
};

struct McapMessage {
  std::string topic;
  std::uint64_t time;
  std::uint32_t sequence;
  RosMessage content;
};

struct McapContent {
  std::map<std::string, std::map<std::string, std::string>> metadata;  ///< one map per topic
  std::vector<McapMessage> messages;                                   ///< found by the indexes of the summary
  std::uint64_t chunks = 0;
  std::map<std::string, std::map<std::string, std::string>> records;  ///< metadata of the file, by names
  std::set<std::string> compressions;                                 ///< compressions of the chunks
};

/// Unpacks a compressed chunk from its compression, its bytes and their unpacked number.
using Unpack = std::function<std::string(const std::string&, const std::string&, std::uint64_t)>;

inline std::string mcap_text(Cursor& c) { return c.text(static_cast<std::size_t>(c.unsigned_little(4))); }

/// Reads a file from its end: footer, summary, chunk indexes, message indexes; checks all CRCs.
inline McapContent read_mcap(const std::string& bytes, const Unpack& unpack = {}) {
  const std::string magic("\x89MCAP0\r\n", 8);
  if (bytes.size() < 37 + 8 || bytes.substr(0, 8) != magic || bytes.substr(bytes.size() - 8) != magic)
    throw std::runtime_error("no magic bytes at both ends");
  const auto expect = [](Cursor& c, unsigned kind) {
    if (c.unsigned_little(1) != kind) throw std::runtime_error("another record than " + std::to_string(kind));
    return c.unsigned_little(8);
  };
  const std::size_t footer_at = bytes.size() - 8 - 29;
  Cursor footer(bytes, footer_at);
  expect(footer, 2);
  const std::uint64_t summary = footer.unsigned_little(8);
  footer.text(8);
  if (footer.unsigned_little(4) != reference_crc(bytes.substr(summary, footer_at + 25 - summary)))
    throw std::runtime_error("CRC of the summary");
  Cursor end(bytes, summary - 13);
  expect(end, 15);
  if (end.unsigned_little(4) != reference_crc(bytes.substr(0, summary - 13)))
    throw std::runtime_error("CRC of the data");

  McapContent content;
  std::map<std::uint64_t, std::pair<std::string, RosTypes>> schemas;
  std::map<std::uint64_t, std::pair<std::string, std::uint64_t>> channels;
  std::uint64_t counted = 0;
  for (Cursor c(bytes, summary); c.at() < footer_at;) {
    const std::uint64_t kind = c.unsigned_little(1), size = c.unsigned_little(8), next = c.at() + size;
    if (kind == 3) {
      const std::uint64_t id = c.unsigned_little(2);
      const std::string name = mcap_text(c);
      if (mcap_text(c) != "ros2msg") throw std::runtime_error("schema encoding");
      schemas[id] = {name, ros_types(name, mcap_text(c))};
    } else if (kind == 4) {
      const std::uint64_t id = c.unsigned_little(2), schema = c.unsigned_little(2);
      const std::string topic = mcap_text(c);
      if (mcap_text(c) != "cdr") throw std::runtime_error("message encoding");
      channels[id] = {topic, schema};
      const std::uint64_t end_of_map = c.unsigned_little(4) + c.at();
      while (c.at() < end_of_map) {
        const std::string key = mcap_text(c);
        content.metadata[topic][key] = mcap_text(c);
      }
    } else if (kind == 11) {
      counted = c.unsigned_little(8);
      c.text(2 + 4 + 4);
      if (c.unsigned_little(4) != content.records.size()) throw std::runtime_error("statistics count other metadata");
    } else if (kind == 13) {
      Cursor record(bytes, c.unsigned_little(8));
      const std::uint64_t length = c.unsigned_little(8);
      if (expect(record, 12) + 9 != length) throw std::runtime_error("metadata of another length");
      const std::string name = mcap_text(record);
      if (name != mcap_text(c)) throw std::runtime_error("metadata of another name");
      const std::uint64_t end_of_map = record.unsigned_little(4) + record.at();
      while (record.at() < end_of_map) {
        const std::string key = mcap_text(record);
        content.records[name][key] = mcap_text(record);
      }
    } else if (kind == 8) {
      ++content.chunks;
      c.text(16);
      const std::uint64_t chunk_at = c.unsigned_little(8);
      c.text(8);
      std::map<std::uint64_t, std::uint64_t> indexes;
      for (std::uint64_t n = c.unsigned_little(4) / 10; n > 0; --n) {
        const std::uint64_t channel = c.unsigned_little(2);
        indexes[channel] = c.unsigned_little(8);
      }
      Cursor chunk(bytes, chunk_at);
      expect(chunk, 6);
      chunk.text(16);
      const std::uint64_t plain = chunk.unsigned_little(8);
      const std::uint64_t crc = chunk.unsigned_little(4);
      const std::string compression = mcap_text(chunk);
      if (!compression.empty() && !unpack) throw std::runtime_error("compressed");
      std::string records = chunk.text(chunk.unsigned_little(8));
      const std::size_t packed = records.size();
      if (!compression.empty()) records = unpack(compression, records, plain);
      if (records.size() != plain) throw std::runtime_error("chunk of another size");
      c.text(8);
      if (mcap_text(c) != compression || c.unsigned_little(8) != packed || c.unsigned_little(8) != plain)
        throw std::runtime_error("chunk index says another compression");
      content.compressions.insert(compression);
      if (crc != reference_crc(records)) throw std::runtime_error("CRC of a chunk");
      for (const auto& [channel, offset] : indexes) {
        Cursor index(bytes, offset);
        expect(index, 7);
        if (index.unsigned_little(2) != channel) throw std::runtime_error("index of another channel");
        for (std::uint64_t n = index.unsigned_little(4) / 16; n > 0; --n) {
          const std::uint64_t time = index.unsigned_little(8);
          Cursor message(records, index.unsigned_little(8));
          const std::uint64_t length = expect(message, 5);
          if (message.unsigned_little(2) != channel) throw std::runtime_error("message of another channel");
          const auto sequence = static_cast<std::uint32_t>(message.unsigned_little(4));
          if (message.unsigned_little(8) != time) throw std::runtime_error("message of another time");
          message.text(8);
          const auto& [topic, schema] = channels.at(channel);
          const auto& [name, types] = schemas.at(schema);
          const std::string raw = message.text(length - 22);
          content.messages.push_back(
              {topic, time, sequence,
               CdrReader(raw, types).read(name.substr(0, name.find('/')) + name.substr(name.rfind('/')))});
        }
      }
    }
    c = Cursor(bytes, next);
  }
  if (counted != content.messages.size()) throw std::runtime_error("statistics count other messages");
  return content;
}

/// Returns soundings at places with levels, of beams from 0.
inline BottomSoundings soundings_at(const std::vector<Eigen::Vector3d>& offsets, const std::vector<float>& level_db) {
  BottomSoundings found;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    found.position.push_back(offsets[i]);
    found.level_db.push_back(level_db[i]);
    found.range.push_back(12.5 + static_cast<double>(i));
    found.deviation.push_back(0.25F);
    found.quality.push_back(1.5F);
    found.method.push_back(BottomMethod::phase);
    found.beam.push_back(static_cast<std::uint32_t>(i + 7));
    found.reject.push_back(static_cast<std::uint8_t>(2 * i));
  }
  return found;
}

}  // namespace insonify::decode

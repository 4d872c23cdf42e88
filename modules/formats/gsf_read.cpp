// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "core/error.hpp"
#include "formats/binary_input_internal.hpp"
#include "formats/gsf_fields_internal.hpp"
#include "formats/gsf_record.hpp"
#include "formats/record_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr std::uint32_t checksum_bit = 0x80000000u;
constexpr std::uint32_t most_record_bytes = std::uint32_t{1} << 24;  // far more than the 2^19 of the specification
constexpr std::uint8_t first_other_subrecord = 100;                  // scale factors, then those of sonars
constexpr std::uint8_t intensity_series = 21;                        // an array of several numbers for each beam
/// Kinds of records by their number.
constexpr std::array record_names = {"",
                                     "header",
                                     "swath",
                                     "profile",
                                     "processing parameters",
                                     "sensor parameters",
                                     "comment",
                                     "history",
                                     "navigation error",
                                     "summary",
                                     "single-beam ping",
                                     "position error",
                                     "attitude"};
/// Arrays of signed numbers; those of all others are unsigned.
constexpr std::array<std::uint8_t, 8> signed_arrays = {2, 3, 5, 6, 10, 17, 24, 26};

struct ArrayScale {
  std::uint8_t flags = 0;
  std::int32_t multiplier = 1, offset = 0;
};

double stored_number(RecordBytes& record, GsfType type) {
  switch (type) {
    case GsfType::u8:
      return static_cast<double>(record.big<std::uint8_t>());
    case GsfType::i16:
      return static_cast<double>(record.big<std::int16_t>());
    case GsfType::u16:
      return static_cast<double>(record.big<std::uint16_t>());
    case GsfType::i32:
      return static_cast<double>(record.big<std::int32_t>());
    default:
      return static_cast<double>(record.big<std::uint32_t>());
  }
}

/// Returns the fields of a table, in their units, up to and with `last`; texts and zeros are left out.
template <typename Record>
std::map<std::string, double> fields_in(RecordBytes& record, std::span<const GsfField<Record>> fields,
                                        const std::string& last = "") {
  std::map<std::string, double> values;
  for (const GsfField<Record>& field : fields) {
    if (field.type == GsfType::zeros || field.type == GsfType::text)
      record.take(static_cast<std::size_t>(field.steps));
    else if (field.value)
      values[field.name] = stored_number(record, field.type) / field.steps;
    if (field.name == last) break;
  }
  return values;
}

double time_in(const std::map<std::string, double>& fields, const std::string& name) {
  return fields.at(name) + fields.at(name + "_NS");
}

double signed_number(RecordBytes& record, std::size_t bytes) {
  if (bytes == 1) return static_cast<double>(record.big<std::int8_t>());
  return bytes == 2 ? static_cast<double>(record.big<std::int16_t>()) : static_cast<double>(record.big<std::int32_t>());
}
double unsigned_number(RecordBytes& record, std::size_t bytes) {
  if (bytes == 1) return static_cast<double>(record.big<std::uint8_t>());
  return bytes == 2 ? static_cast<double>(record.big<std::uint16_t>())
                    : static_cast<double>(record.big<std::uint32_t>());
}

/// Returns the two bits of each beam, four beams in a byte, the first in its highest bits.
std::vector<double> quality_flags_in(RecordBytes& part, std::size_t beams) {
  std::vector<double> values(std::min(beams, 4 * part.size()));
  const std::string_view bytes = part.take(part.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(static_cast<std::uint8_t>(bytes[i / 4]) >> (6 - 2 * (i % 4)) & 3);
  values.resize(beams);
  return values;
}

std::vector<double> scaled_array(RecordBytes& part, std::uint8_t id, std::size_t beams, const ArrayScale& scale) {
  const std::size_t bytes = part.size() / beams;
  if (bytes * beams != part.size() || (bytes != 1 && bytes != 2 && bytes != 4))
    fail(ErrorKind::content, part.where(), ": array ", int{id}, " has ", part.size(), " bytes for ", beams,
         " beams, must have 1, 2 or 4 for each");
  if ((scale.flags & 0x0f) != 0)
    fail(ErrorKind::content, part.where(), ": array ", int{id}, " is compressed; write the file without compression");
  if (scale.multiplier == 0) fail(ErrorKind::content, part.where(), ": array ", int{id}, " has the multiplier 0");
  const bool with_sign = std::find(signed_arrays.begin(), signed_arrays.end(), id) != signed_arrays.end();
  std::vector<double> values(beams);
  for (double& value : values)
    value = (with_sign ? signed_number : unsigned_number)(part, bytes) / scale.multiplier - scale.offset;
  return values;
}

/// Reads the records of a file; keeps what later pings need of earlier ones.
class GsfReader {
 public:
  explicit GsfReader(const std::string& path) : path_(path), file_(path) {}

  GsfRecord read() {
    for (std::size_t at = 0, number = 0; at < file_.size(); ++number) at = next(at, number);
    if (record_.pings.empty()) fail(ErrorKind::content, path_, ": has no swath");
    return std::move(record_);
  }

 private:
  /// Reads the record at this byte and returns where the next one begins.
  std::size_t next(std::size_t at, std::size_t number) {
    const std::string where = path_ + ": record " + std::to_string(number) + " at byte " + std::to_string(at);
    const std::string head = file_.part(at, 8, "record " + std::to_string(number));
    const auto size = big_at<std::uint32_t>(head, 0), id = big_at<std::uint32_t>(head, 4);
    const std::uint32_t kind = id & 0x3fffffu;
    if (number == 0 && (kind != 1 || size < 12 || size > most_record_bytes))
      fail(ErrorKind::content, path_, ": does not begin with the header of a GSF file");
    if (size > most_record_bytes)
      fail(ErrorKind::content, where, " has ", size, " bytes, must have at most ", most_record_bytes);
    const std::size_t sum_bytes = (id & checksum_bit) != 0 ? 4 : 0;
    const std::string data = file_.part(at + 8, sum_bytes + size, "record " + std::to_string(number));
    const std::string_view body = std::string_view(data).substr(sum_bytes);
    if (sum_bytes > 0) require_sum(body, big_at<std::uint32_t>(data, 0), where);
    RecordBytes record(body, where);
    take(kind, record);
    ++record_.records[kind < record_names.size() && kind > 0 ? record_names[kind] : "other"];
    return at + 8 + sum_bytes + size;
  }

  static void require_sum(std::string_view body, std::uint32_t stated, const std::string& where) {
    std::uint32_t sum = 0;
    for (const char byte : body) sum += static_cast<std::uint8_t>(byte);
    if (sum != stated)
      fail(ErrorKind::content, where, " has the checksum ", sum, ", states ", stated, "; the file is damaged");
  }

  void take(std::uint32_t kind, RecordBytes& record) {
    if (kind == 1) take_header(record);
    if (kind == 2) record_.pings.push_back(ping_in(record));
    if (kind == 3) take_profile(record);
    if (kind == 6) take_comment(record);
    if (kind == 12) take_attitudes(record);
  }

  void take_header(RecordBytes& record) {
    const std::string version = record.text(12);
    if (version.rfind("GSF-v", 0) != 0)
      fail(ErrorKind::content, path_, ": its header is '", version, "', must begin with GSF-v");
    const std::size_t digits = std::min(version.find_first_not_of('0', 5), version.size());
    record_.version = version.substr(digits);
    with_height_ = record_.version.rfind("1.", 0) != 0 && record_.version.rfind("2.", 0) != 0;
  }

  GsfRecordedPing ping_in(RecordBytes& record) {
    GsfRecordedPing ping;
    ping.header = fields_in(record, gsf_ping_fields(), with_height_ ? "" : "SPEED");
    if (ping.beams() == 0) fail(ErrorKind::content, record.where(), " is a swath without beams");
    while (record.left() > 4) {
      const auto head = record.big<std::uint32_t>();
      const auto id = static_cast<std::uint8_t>(head >> 24);
      RecordBytes part(record.take(head & 0xffffffu), record.where());
      if (id == first_other_subrecord)
        take_scales(part);
      else if (id > first_other_subrecord && ping.sensor == 0)
        ping.sensor = id;
      else if (id > 0 && id < first_other_subrecord && id != intensity_series)
        ping.arrays[GsfArrayId{id}] = array_in(part, id, ping.beams());
    }
    return ping;
  }

  std::vector<double> array_in(RecordBytes& part, std::uint8_t id, std::size_t beams) {
    if (GsfArrayId{id} == GsfArrayId::quality_flags) return quality_flags_in(part, beams);
    const bool unscaled = GsfArrayId{id} == GsfArrayId::beam_flags;
    return scaled_array(part, id, beams, unscaled ? ArrayScale{} : scales_[id]);
  }

  void take_scales(RecordBytes& part) {
    const auto count = part.big<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto id = part.big<std::uint8_t>();
      ArrayScale scale;
      scale.flags = part.big<std::uint8_t>();
      part.take(2);
      scale.multiplier = part.big<std::int32_t>(), scale.offset = part.big<std::int32_t>();
      scales_[id] = scale;
    }
  }

  void take_profile(RecordBytes& record) {
    const auto head = fields_in(record, gsf_profile_fields());
    RecordedProfile profile;
    profile.time = time_in(head, "APP_TIME");
    while (record.left() >= 8 && profile.depth.size() < static_cast<std::size_t>(head.at("NUM_POINTS"))) {
      const auto entry = fields_in(record, gsf_profile_entry_fields());
      profile.depth.push_back(entry.at("DEPTH")), profile.sound_speed.push_back(entry.at("SOUND_SPEED"));
    }
    record_.profiles.push_back(std::move(profile));
  }

  void take_comment(RecordBytes& record) {
    record.take(8);
    const auto length = record.big<std::uint32_t>();
    record_.comments.push_back(record.text(length));
  }

  void take_attitudes(RecordBytes& record) {
    const auto head = fields_in(record, gsf_attitude_fields());
    for (double i = 0; i < head.at("NUM_MEASUREMENTS"); ++i) {
      const auto entry = fields_in(record, gsf_attitude_entry_fields());
      RecordedAttitude attitude;
      attitude.time = time_in(head, "BASE_TIME") + entry.at("ATTITUDE_TIME");
      attitude.heading = radians(entry.at("HEADING")), attitude.pitch = radians(entry.at("PITCH"));
      attitude.roll = radians(entry.at("ROLL")), attitude.heave = entry.at("HEAVE");
      record_.attitudes.push_back(attitude);
    }
  }

  std::string path_;
  BinaryInput file_;
  GsfRecord record_;
  bool with_height_ = true;             ///< version 3: pings have heights above the ellipsoid
  std::array<ArrayScale, 256> scales_;  ///< scales of arrays by their number, as last stated
};

}  // namespace

GsfRecord read_gsf(const std::string& path) { return GsfReader(path).read(); }

}  // namespace insonify

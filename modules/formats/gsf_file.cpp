// SPDX-License-Identifier: BSD-3-Clause
#include "formats/gsf_file.hpp"

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "formats/gsf_fields_internal.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

// Records, and the subrecord of a ping with the scales of its arrays.
enum : std::uint32_t {
  header_record = 1,
  ping_record = 2,
  profile_record = 3,
  parameter_record = 4,
  comment_record = 6,
  history_record = 7,
  summary_record = 9,
  position_error_record = 11,
  attitude_record = 12
};
constexpr std::uint8_t scale_factors_id = 100;
constexpr std::size_t most_beams = 18000;  // beams of 29 bytes; a record has at most 2^19
constexpr double most_attitude_time = 60;  // largest span of a record [s]
constexpr std::streamoff summary_at = 20;  // offset behind the header

void require_time(double time) {
  if (!(time >= 0 && time < 4294967296.0))
    fail(ErrorKind::content, "GSF: time ", time, " s since 1970 must be within 1970 and 2106; give --start-utc");
}

void put_subrecord(std::string& bytes, std::uint8_t id, const std::string& data) {
  put_big(bytes, static_cast<std::uint32_t>(std::uint32_t{id} << 24 | static_cast<std::uint32_t>(data.size())));
  bytes += data;
}

std::string scale_factors() {
  std::string bytes;
  put_big(bytes, static_cast<std::uint32_t>(gsf_arrays().size()));
  for (const GsfArray& array : gsf_arrays()) {
    put_big(bytes, static_cast<std::uint32_t>(std::uint32_t{array.id} << 24 | std::uint32_t{array.size_flag} << 16));
    put_big(bytes, array.multiplier);
    put_big(bytes, array.offset);
  }
  return bytes;
}

std::string array_of(const GsfArray& array, const GsfPing& ping, const std::string& where) {
  std::string values;
  for (const GsfBeam& beam : ping.beams)
    put_gsf_number(values, array.type,
                   ((beam.detected ? array.value(beam) : array.none) + array.offset) * array.multiplier, array.name,
                   where);
  return values;
}

template <typename Record>
std::string fields_of(std::span<const GsfField<Record>> fields, const Record& record, const std::string& where) {
  std::string bytes;
  put_gsf_fields(bytes, fields, record, where);
  return bytes;
}

std::string parameters_of(const GsfSurvey& survey) {
  std::string bytes = fields_of(gsf_parameter_fields(), survey, "the parameters");
  for (const GsfParameter& parameter : gsf_parameters())
    put_gsf_text(bytes, GsfType::text16, 1, parameter.key + ("=" + parameter.value(survey.processing)));
  return bytes;
}

std::string profile_of(const GsfSurvey& survey) {
  std::string bytes = fields_of(gsf_profile_fields(), survey, "the profile");
  for (std::size_t i = 0; i < survey.profile.depth.size(); ++i)
    put_gsf_fields(bytes, gsf_profile_entry_fields(),
                   GsfProfileEntry{survey.profile.depth[i], survey.profile.sound_speed[i]}, "the profile");
  return bytes;
}

void count_ping(GsfSummary& summary, const GsfPing& ping) {
  const double longitude = std::remainder(ping.position.longitude, 2 * pi);
  const auto widen = [](bool first, double value, double& least, double& most) {
    least = first ? value : std::min(least, value);
    most = first ? value : std::max(most, value);
  };
  const bool first = summary.pings++ == 0;
  widen(first, ping.time, summary.begin, summary.end);
  widen(first, ping.position.latitude, summary.south, summary.north);
  widen(first, longitude, summary.west, summary.east);
  for (const GsfBeam& beam : ping.beams)
    if (beam.detected) widen(summary.soundings++ == 0, beam.depth, summary.least_depth, summary.greatest_depth);
}

}  // namespace

GsfFile::GsfFile(const std::string& path, const GsfSurvey& survey)
    : pending_(std::make_shared<PendingFile>(path)),
      out_(pending_->temporary(), std::ios::binary),
      sensor_(survey.sensor) {
  require_time(survey.time);
  record(header_record, std::string("GSF-v03.11\0\0", 12));
  record(summary_record, fields_of(gsf_summary_fields(), summary_, "the summary"));  // written again by finish()
  record(comment_record, fields_of(gsf_comment_fields(), survey, "the comment"));
  record(history_record, fields_of(gsf_history_fields(), survey, "the history"));
  record(parameter_record, parameters_of(survey));
  record(profile_record, profile_of(survey));
  if (survey.position_deviation)
    record(position_error_record, fields_of(gsf_position_error_fields(), survey, "the errors of positions"));
}

void GsfFile::record(std::uint32_t id, std::string data) {
  data.append((4 - data.size() % 4) % 4, '\0');
  std::string head;
  put_big(head, static_cast<std::uint32_t>(data.size()));
  put_big(head, id);
  out_ << head << data;
}

void GsfFile::put_attitudes() {
  if (attitudes_.empty()) return;
  const double begin = attitudes_.front().time;
  std::string data = fields_of(gsf_attitude_fields(), GsfAttitudeHead{begin, attitudes_.size()}, "the attitudes");
  for (GsfAttitude& attitude : attitudes_) {
    attitude.time -= begin;
    put_gsf_fields(data, gsf_attitude_entry_fields(), attitude, "the attitudes");
  }
  record(attitude_record, std::move(data));
  attitudes_.clear();
}

void GsfFile::add_profile(const SoundSpeedProfile& profile, const GeoPosition& position, double time) {
  GsfSurvey cast;
  cast.profile = profile, cast.position = position, cast.time = time;
  record(profile_record, profile_of(cast));
}

void GsfFile::add(const GsfPing& ping) {
  if (ping.beams.empty() || ping.beams.size() > most_beams)
    fail(ErrorKind::content, "GSF: ping ", ping.number, " has ", ping.beams.size(), " soundings, must be within 1 and ",
         most_beams);
  require_time(ping.time);
  if (!attitudes_.empty() && !(ping.time >= attitudes_.front().time &&
                               ping.time - attitudes_.front().time < most_attitude_time && attitudes_.size() < 50000))
    put_attitudes();
  const std::string where = "ping " + std::to_string(ping.number);
  std::string data = fields_of(gsf_ping_fields(), ping, where);
  if (!scaled_) put_subrecord(data, scale_factors_id, scale_factors());
  scaled_ = true;
  for (const GsfArray& array : gsf_arrays()) put_subrecord(data, array.id, array_of(array, ping, where));
  put_subrecord(data, gsf_beam_flags.id, array_of(gsf_beam_flags, ping, where));
  put_subrecord(data, static_cast<std::uint8_t>(sensor_), fields_of(gsf_sensor_fields(sensor_), ping, where));
  record(ping_record, std::move(data));
  attitudes_.push_back({ping.time, ping.pitch, ping.roll, ping.heave, ping.heading});
  count_ping(summary_, ping);
}

void GsfFile::finish() {
  put_attitudes();
  out_.seekp(summary_at);
  record(summary_record, fields_of(gsf_summary_fields(), summary_, "the summary"));
  pending_->commit(out_);
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "formats/gsf_fields_internal.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

/// Appends `value`, rounded. Throws Error(content) if a number of this type cannot hold it.
template <typename Number>
void put_rounded(std::string& bytes, double value, const char* name, const std::string& where) {
  const double rounded = std::nearbyint(value);
  if (!(rounded >= static_cast<double>(std::numeric_limits<Number>::lowest()) &&
        rounded <= static_cast<double>(std::numeric_limits<Number>::max())))
    fail(ErrorKind::content, "GSF: ", name, " of ", where, " is ", value, " in units of its field, must be within ",
         +std::numeric_limits<Number>::lowest(), " and ", +std::numeric_limits<Number>::max());
  put_big(bytes, static_cast<Number>(rounded));
}

const char* type_name(GsfType type) {
  switch (type) {
    case GsfType::u8:
      return "u8";
    case GsfType::i16:
      return "i16";
    case GsfType::u16:
      return "u16";
    case GsfType::i32:
      return "i32";
    case GsfType::u32:
      return "u32";
    case GsfType::text16:
      return "text16";
    case GsfType::text32:
      return "text32";
    default:
      return "text";
  }
}

std::string step_text(double steps, const std::string& unit) {
  if (unit.empty() || steps == 1) return steps == 1 ? unit : printed("1/%.0f", steps);
  return printed("1/%.0f ", steps) + unit;
}

template <typename Record>
void add_rows(std::vector<GsfFieldRow>& rows, const char* record, std::span<const GsfField<Record>> fields) {
  for (const GsfField<Record>& field : fields)
    if (field.value)
      rows.push_back({record, field.name, type_name(field.type), step_text(field.steps, field.unit), field.meaning});
    else if (field.text)
      rows.push_back({record, field.name,
                      field.type == GsfType::text ? printed("text of %.0f", field.steps) : type_name(field.type), "",
                      field.meaning});
}

void add_row(std::vector<GsfFieldRow>& rows, const GsfArray& array) {
  rows.push_back({"2, array " + std::to_string(array.id), array.name, type_name(array.type),
                  step_text(array.multiplier, array.unit), array.meaning});
}

}  // namespace

void put_gsf_number(std::string& bytes, GsfType type, double raw, const char* name, const std::string& where) {
  switch (type) {
    case GsfType::u8:
      return put_rounded<std::uint8_t>(bytes, raw, name, where);
    case GsfType::i16:
      return put_rounded<std::int16_t>(bytes, raw, name, where);
    case GsfType::u16:
      return put_rounded<std::uint16_t>(bytes, raw, name, where);
    case GsfType::i32:
      return put_rounded<std::int32_t>(bytes, raw, name, where);
    default:
      return put_rounded<std::uint32_t>(bytes, raw, name, where);
  }
}

void put_gsf_text(std::string& bytes, GsfType type, double size, const std::string& text) {
  if (type == GsfType::text16 || type == GsfType::text32) {
    const std::string kept = text.substr(0, 65534);
    if (type == GsfType::text16)
      put_big(bytes, static_cast<std::uint16_t>(kept.size() + 1));
    else
      put_big(bytes, static_cast<std::uint32_t>(kept.size() + 1));
    put_field(bytes, kept, kept.size() + 1);
  } else {
    put_field(bytes, text, static_cast<std::size_t>(size));
  }
}

std::vector<GsfFieldRow> gsf_field_rows() {
  std::vector<GsfFieldRow> rows{{"1 header", "VERSION", "text of 12", "", "GSF-v03.11"}};
  add_rows(rows, "9 summary", gsf_summary_fields());
  add_rows(rows, "6 comment", gsf_comment_fields());
  add_rows(rows, "7 history", gsf_history_fields());
  add_rows(rows, "4 parameters", gsf_parameter_fields());
  for (const GsfParameter& parameter : gsf_parameters())
    rows.push_back({"4 parameters", parameter.key, "text16", "", parameter.meaning});
  add_rows(rows, "3 profile", gsf_profile_fields());
  add_rows(rows, "3 profile, entry", gsf_profile_entry_fields());
  add_rows(rows, "11 position errors", gsf_position_error_fields());
  add_rows(rows, "2 ping", gsf_ping_fields());
  for (const GsfArray& array : gsf_arrays()) add_row(rows, array);
  add_row(rows, gsf_beam_flags);
  add_rows(rows, "2, sensor 114", gsf_sensor_fields(GsfSensor::seabat_ii));
  add_rows(rows, "2, sensor 149", gsf_sensor_fields(GsfSensor::em2040));
  add_rows(rows, "2, sensor 152", gsf_sensor_fields(GsfSensor::r2sonic_2024));
  add_rows(rows, "12 attitude", gsf_attitude_fields());
  add_rows(rows, "12 attitude, entry", gsf_attitude_entry_fields());
  return rows;
}

}  // namespace insonify

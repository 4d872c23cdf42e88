// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/text.hpp"
#include "formats/gsf_fields_internal.hpp"

namespace insonify {

/// A field that GsfFile writes, for the list in docs/reference/gsf.md.
struct GsfFieldRow {
  std::string record;  ///< record or subrecord
  std::string name;    ///< name in the specification
  std::string type;    ///< "u16", "text", ...
  std::string step;    ///< value of one count, e.g. "1/100 deg"
  std::string meaning;
};

inline std::string gsf_type_text(GsfType type) {
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

inline std::string gsf_step_text(double steps, const std::string& unit) {
  if (unit.empty() || steps == 1) return steps == 1 ? unit : printed("1/%.0f", steps);
  return printed("1/%.0f ", steps) + unit;
}

template <typename Record>
void add_gsf_rows(std::vector<GsfFieldRow>& rows, const char* record, std::span<const GsfField<Record>> fields) {
  for (const GsfField<Record>& field : fields)
    if (field.value)
      rows.push_back(
          {record, field.name, gsf_type_text(field.type), gsf_step_text(field.steps, field.unit), field.meaning});
    else if (field.text)
      rows.push_back({record, field.name,
                      field.type == GsfType::text ? printed("text of %.0f", field.steps) : gsf_type_text(field.type),
                      "", field.meaning});
}

inline void add_gsf_row(std::vector<GsfFieldRow>& rows, const GsfArray& array) {
  rows.push_back({"2, array " + std::to_string(array.id), array.name, gsf_type_text(array.type),
                  gsf_step_text(array.multiplier, array.unit), array.meaning});
}

/// Returns all fields of all records in the order of the file, except fields that are always 0.
inline std::vector<GsfFieldRow> gsf_field_rows() {
  std::vector<GsfFieldRow> rows{{"1 header", "VERSION", "text of 12", "", "GSF-v03.11"}};
  add_gsf_rows(rows, "9 summary", gsf_summary_fields());
  add_gsf_rows(rows, "6 comment", gsf_comment_fields());
  add_gsf_rows(rows, "7 history", gsf_history_fields());
  add_gsf_rows(rows, "4 parameters", gsf_parameter_fields());
  for (const GsfParameter& parameter : gsf_parameters())
    rows.push_back({"4 parameters", parameter.key, "text16", "", parameter.meaning});
  add_gsf_rows(rows, "3 profile", gsf_profile_fields());
  add_gsf_rows(rows, "3 profile, entry", gsf_profile_entry_fields());
  add_gsf_rows(rows, "11 position errors", gsf_position_error_fields());
  add_gsf_rows(rows, "2 ping", gsf_ping_fields());
  for (const GsfArray& array : gsf_arrays()) add_gsf_row(rows, array);
  add_gsf_row(rows, gsf_beam_flags);
  add_gsf_rows(rows, "2, sensor 114", gsf_sensor_fields(GsfSensor::seabat_ii));
  add_gsf_rows(rows, "2, sensor 149", gsf_sensor_fields(GsfSensor::em2040));
  add_gsf_rows(rows, "2, sensor 152", gsf_sensor_fields(GsfSensor::r2sonic_2024));
  add_gsf_rows(rows, "12 attitude", gsf_attitude_fields());
  add_gsf_rows(rows, "12 attitude, entry", gsf_attitude_entry_fields());
  return rows;
}

}  // namespace insonify

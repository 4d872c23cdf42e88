// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "core/units.hpp"
#include "formats/gsf_file.hpp"

// Private to formats: the fields of GSF's records. Each is one row of a table; the table serves to write and to
// document them.
namespace insonify {

/// The form of a field in a file, highest byte first. text16 and text32 begin with their length, which counts the 0 at
/// the end; text and zeros have as many bytes as the row says.
enum class GsfType { u8, i16, u16, i32, u32, text, text16, text32, zeros };

/// A field of a record: raw = value times steps, rounded.
template <typename Record>
struct GsfField {
  const char* name;
  GsfType type;
  double steps;      ///< raw counts per unit; text and zeros: number of bytes
  const char* unit;  ///< "": a number
  const char* meaning;
  double (*value)(const Record& record) = nullptr;
  std::string (*text)(const Record& record) = nullptr;
};

/// An array of one number per beam: raw = (value + offset) times multiplier, rounded.
struct GsfArray {
  std::uint8_t id, size_flag;  ///< number and size of the field: 0 the usual, 0x20 two bytes, 0x40 four
  GsfType type;
  std::int32_t multiplier, offset;
  const char* name;
  const char* unit;
  const char* meaning;
  double (*value)(const GsfBeam& beam);
  double none = 0;  ///< value for a beam without a sounding
};

/// A processing parameter, written as KEY=VALUE.
struct GsfParameter {
  const char* key;
  const char* meaning;
  std::string (*value)(const GsfProcessing& processing);
};

/// An entry of the sound-speed profile.
struct GsfProfileEntry {
  double depth = 0, sound_speed = 0;
};

/// The beginning of a record of attitudes: the time of the first attitude, and the number of attitudes.
struct GsfAttitudeHead {
  double time = 0;
  std::size_t count = 0;
};

std::span<const GsfField<GsfPing>> gsf_ping_fields();
std::span<const GsfArray> gsf_arrays();
/// The array of flags. The first bit marks a beam that is not usable.
extern const GsfArray gsf_beam_flags;
std::span<const GsfField<GsfPing>> gsf_sensor_fields(GsfSensor sensor);
std::span<const GsfField<GsfSurvey>> gsf_profile_fields();
std::span<const GsfField<GsfProfileEntry>> gsf_profile_entry_fields();
std::span<const GsfField<GsfSurvey>> gsf_parameter_fields();
std::span<const GsfParameter> gsf_parameters();
std::span<const GsfField<GsfSurvey>> gsf_comment_fields();
std::span<const GsfField<GsfSurvey>> gsf_history_fields();
std::span<const GsfField<GsfSurvey>> gsf_position_error_fields();
std::span<const GsfField<GsfAttitudeHead>> gsf_attitude_fields();
/// Returns the fields of one attitude. Its time counts from the first attitude of the record.
std::span<const GsfField<GsfAttitude>> gsf_attitude_entry_fields();
std::span<const GsfField<GsfSummary>> gsf_summary_fields();

/// Appends a raw number. Throws Error(content) that names the field and `where` if the type cannot hold it.
void put_gsf_number(std::string& bytes, GsfType type, double raw, const char* name, const std::string& where);
/// Appends a text, or as many zeros as the field has.
void put_gsf_text(std::string& bytes, GsfType type, double size, const std::string& text);

/// Appends the fields of a record. Errors as put_gsf_number.
template <typename Record>
void put_gsf_fields(std::string& bytes, std::span<const GsfField<Record>> fields, const Record& record,
                    const std::string& where) {
  for (const GsfField<Record>& field : fields)
    if (field.value)
      put_gsf_number(bytes, field.type, field.value(record) * field.steps, field.name, where);
    else
      put_gsf_text(bytes, field.type, field.steps, field.text ? field.text(record) : "");
}

/// Returns an angle in degrees within [0, 360), also after rounding to `steps` steps per degree.
double gsf_compass(double angle, double steps);

/// Return the whole seconds and the fraction of a time. The fraction never rounds up to a second.
inline double gsf_seconds(double time) { return std::floor(time); }
inline double gsf_fraction(double time) { return std::min(0.999999999, time - std::floor(time)); }

/// Returns a longitude in degrees, within -180 and 180.
inline double gsf_longitude(double longitude) { return degrees(std::remainder(longitude, 2 * pi)); }

}  // namespace insonify

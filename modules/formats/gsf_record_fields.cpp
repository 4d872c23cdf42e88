// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"
#include "core/text.hpp"
#include "formats/gsf_fields_internal.hpp"

namespace insonify {
namespace {

using enum GsfType;
using Survey = GsfSurvey;
using Summary = GsfSummary;
using Processing = GsfProcessing;

// Formats a number like GSF's parameters in metres and degrees: a sign, two decimals, at least six characters.
std::string parameter_number(double value) { return printed("%+06.2f", value + 0.0); }

std::string parameter_vector(const Eigen::Vector3d& v) {
  return parameter_number(v.x()) + ',' + parameter_number(v.y()) + ',' + parameter_number(v.z());
}

std::string yes(const Processing&) { return "YES"; }
std::string one(const Processing&) { return "1"; }
std::string none(const Processing&) { return parameter_number(0); }
std::string no_vector(const Processing&) { return parameter_vector({0, 0, 0}); }

std::string mounting_angle(const Processing& p, double GsfMounting::*angle) {
  return p.mounting ? parameter_number(degrees((*p.mounting).*angle)) : "UNKNWN";
}

const char* const offset_to_apply = "nothing is left to apply";

const GsfParameter parameters[] = {
    {"REFERENCE TIME", "1970/001 00:00:00: times count from there",
     [](const Processing&) { return std::string("1970/001 00:00:00"); }},
    {"PLATFORM_TYPE", "AUV if the ship's origin is below the water level at the first ping, else SURFACE_SHIP",
     [](const Processing& p) { return std::string(p.submersible ? "AUV" : "SURFACE_SHIP"); }},
    {"FULL_RAW_DATA", "FALSE: angles are those of compensated beams",
     [](const Processing&) { return std::string("FALSE"); }},
    {"ROLL_COMPENSATED", "YES: in depth, across, along, angle and azimuth", yes},
    {"PITCH_COMPENSATED", "YES: in depth, across, along, angle and azimuth", yes},
    {"HEAVE_COMPENSATED", "YES: by the depth of the head at each ping", yes},
    {"TIDE_COMPENSATED", "YES if the run says where the water level is, else NO",
     [](const Processing& p) { return std::string(p.tide_compensated ? "YES" : "NO"); }},
    {"NUMBER_OF_RECEIVERS", "1", one},
    {"NUMBER_OF_TRANSMITTERS", "1", one},
    {"DEPTH_CALCULATION", "CORRECTED: with the sound speeds of the profile",
     [](const Processing&) { return std::string("CORRECTED"); }},
    {"RAY_TRACING", "YES: depth, across and along follow the rays through the profile", yes},
    {"UTC_OFFSET", "+00", [](const Processing&) { return std::string("+00"); }},
    {"ROLL_REFERENCE", "ROTATED_PITCH_AXIS: about the ship's own x axis",
     [](const Processing&) { return std::string("ROTATED_PITCH_AXIS"); }},
    {"DRAFT_TO_APPLY", offset_to_apply, none},
    {"PITCH_TO_APPLY", offset_to_apply, none},
    {"ROLL_TO_APPLY", offset_to_apply, none},
    {"GYRO_TO_APPLY", offset_to_apply, none},
    {"POSITION_OFFSET_TO_APPLY", offset_to_apply, no_vector},
    {"ANTENNA_OFFSET_TO_APPLY", offset_to_apply, no_vector},
    {"TRANSDUCER_OFFSET_TO_APPLY", offset_to_apply, no_vector},
    {"APPLIED_DRAFT", "m: depth of the head below the water level at the first ping; of each ping DEPTH_CORRECTOR",
     [](const Processing& p) { return parameter_number(p.draft); }},
    {"APPLIED_PITCH_BIAS", "no bias", none},
    {"APPLIED_ROLL_BIAS", "no bias", none},
    {"APPLIED_GYRO_BIAS", "no bias", none},
    {"APPLIED_POSITION_OFFSET", "m: 0, positions are those of the head", no_vector},
    {"APPLIED_TRANSDUCER_OFFSET",
     "m: the head from the ship's origin: ahead, to starboard, down; UNKNWN if the run does not say",
     [](const Processing& p) { return p.mounting ? parameter_vector(p.mounting->offset) : "UNKNWN,UNKNWN,UNKNWN"; }},
    {"APPLIED_TRANSDUCER_PITCH_OFFSET", "deg: of the head from one whose swath is straight down, positive bow up",
     [](const Processing& p) { return mounting_angle(p, &GsfMounting::pitch); }},
    {"APPLIED_TRANSDUCER_ROLL_OFFSET", "deg: of the head, positive starboard down",
     [](const Processing& p) { return mounting_angle(p, &GsfMounting::roll); }},
    {"APPLIED_TRANSDUCER_HEADING_OFFSET", "deg: of the head, positive clockwise",
     [](const Processing& p) { return mounting_angle(p, &GsfMounting::heading); }},
    {"GEOID", "WGS-84", [](const Processing&) { return std::string("WGS-84"); }},
    {"TIDAL_DATUM", "name of the datum z = 0; UNKNOWN if the run does not say",
     [](const Processing& p) { return p.tidal_datum; }}};

const GsfField<Survey> parameter_fields[] = {
    {"TIME", u32, 1, "s", "of the first ping, UTC since 1970", [](const Survey& s) { return gsf_seconds(s.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"NUM_PARAMS", u16, 1, "", "number of the texts KEY=VALUE that follow, each a text16",
     [](const Survey&) { return static_cast<double>(std::size(parameters)); }}};

const GsfField<Survey> profile_fields[] = {
    {"OBS_TIME", u32, 1, "s", "of the first ping that it holds for, UTC since 1970",
     [](const Survey& s) { return gsf_seconds(s.time); }},
    {"OBS_TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"APP_TIME", u32, 1, "s", "as OBS_TIME", [](const Survey& s) { return gsf_seconds(s.time); }},
    {"APP_TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"LONGITUDE", i32, 1e7, "deg", "of that ping", [](const Survey& s) { return gsf_longitude(s.position.longitude); }},
    {"LATITUDE", i32, 1e7, "deg", "of that ping", [](const Survey& s) { return degrees(s.position.latitude); }},
    {"NUM_POINTS", u32, 1, "", "number of the pairs that follow",
     [](const Survey& s) { return static_cast<double>(s.profile.depth.size()); }}};

const GsfField<GsfProfileEntry> profile_entry_fields[] = {
    {"DEPTH", u32, 100, "m", "below the water level; the first and last sound speed go on to 0 and 12 000 m",
     [](const GsfProfileEntry& e) { return std::max(0.0, e.depth); }},
    {"SOUND_SPEED", u32, 100, "m/s", "there, linear between entries",
     [](const GsfProfileEntry& e) { return e.sound_speed; }}};

const GsfField<Survey> comment_fields[] = {
    {"TIME", u32, 1, "s", "of the first ping, UTC since 1970", [](const Survey& s) { return gsf_seconds(s.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"COMMENT_TEXT", text32, 1, "", "sonar, and the version of insonify that simulated it", nullptr,
     [](const Survey& s) { return s.comment; }}};

const GsfField<Survey> history_fields[] = {
    {"TIME", u32, 1, "s", "of the first ping, UTC since 1970", [](const Survey& s) { return gsf_seconds(s.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"MACHINE_TEXT", text16, 1, "", "empty: the same run gives the same bytes anywhere", nullptr,
     [](const Survey&) { return std::string(); }},
    {"OPERATOR_TEXT", text16, 1, "", "empty", nullptr, [](const Survey&) { return std::string(); }},
    {"COMMAND_TEXT", text16, 1, "", "of the export, without paths", nullptr,
     [](const Survey& s) { return s.history_command; }},
    {"COMMENT_TEXT", text16, 1, "", "what was done, and by which version of insonify", nullptr,
     [](const Survey& s) { return s.history_comment; }}};

const GsfField<Survey> position_error_fields[] = {
    {"TIME", u32, 1, "s", "of the first ping, UTC since 1970", [](const Survey& s) { return gsf_seconds(s.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Survey& s) { return gsf_fraction(s.time); }},
    {"RECORD_ID", u32, 1, "", "2: of pings", [](const Survey&) { return 2.0; }},
    {"HORIZONTAL_ERROR", i32, 1000, "m", "rms of the positions: sqrt(2) times position_m of nav_noise",
     [](const Survey& s) { return std::sqrt(2.0) * s.position_deviation.value_or(0); }},
    {"VERTICAL_ERROR", i32, 1000, "m", "rms of the heights: position_m of nav_noise",
     [](const Survey& s) { return s.position_deviation.value_or(0); }},
    {"SEP_UNCERTAINTY, SPARE", zeros, 4, "", ""},
    {"POSITION_TYPE_SIZE", u16, 1, "", "4", [](const Survey&) { return 4.0; }},
    {"POSITION_TYPE", text, 4, "", "UNKN", nullptr, [](const Survey&) { return std::string("UNKN"); }}};

const GsfField<GsfAttitudeHead> attitude_fields[] = {
    {"BASE_TIME", u32, 1, "s", "of the first entry, UTC since 1970",
     [](const GsfAttitudeHead& a) { return gsf_seconds(a.time); }},
    {"BASE_TIME_NS", u32, 1e9, "s", "its fraction", [](const GsfAttitudeHead& a) { return gsf_fraction(a.time); }},
    {"NUM_MEASUREMENTS", u16, 1, "", "entries that follow, one for each ping, of a minute at most",
     [](const GsfAttitudeHead& a) { return static_cast<double>(a.count); }}};

const GsfField<GsfAttitude> attitude_entry_fields[] = {
    {"ATTITUDE_TIME", u16, 1000, "s", "after BASE_TIME", [](const GsfAttitude& a) { return a.time; }},
    {"PITCH", i16, 100, "deg", "as of the ping", [](const GsfAttitude& a) { return degrees(a.pitch); }},
    {"ROLL", i16, 100, "deg", "as of the ping", [](const GsfAttitude& a) { return degrees(a.roll); }},
    {"HEAVE", i16, 100, "m", "as of the ping", [](const GsfAttitude& a) { return a.heave; }},
    {"HEADING", u16, 100, "deg", "as of the ping", [](const GsfAttitude& a) { return gsf_compass(a.heading, 100); }}};

const GsfField<Summary> summary_fields[] = {
    {"BEGIN_TIME", u32, 1, "s", "of the first ping, UTC since 1970",
     [](const Summary& s) { return gsf_seconds(s.begin); }},
    {"BEGIN_TIME_NS", u32, 1e9, "s", "its fraction", [](const Summary& s) { return gsf_fraction(s.begin); }},
    {"END_TIME", u32, 1, "s", "of the last ping", [](const Summary& s) { return gsf_seconds(s.end); }},
    {"END_TIME_NS", u32, 1e9, "s", "its fraction", [](const Summary& s) { return gsf_fraction(s.end); }},
    {"MIN_LATITUDE", i32, 1e7, "deg", "southernmost of the heads", [](const Summary& s) { return degrees(s.south); }},
    {"MIN_LONGITUDE", i32, 1e7, "deg", "westernmost of the heads", [](const Summary& s) { return degrees(s.west); }},
    {"MAX_LATITUDE", i32, 1e7, "deg", "northernmost of the heads", [](const Summary& s) { return degrees(s.north); }},
    {"MAX_LONGITUDE", i32, 1e7, "deg", "easternmost of the heads", [](const Summary& s) { return degrees(s.east); }},
    {"MIN_DEPTH", i32, 100, "m", "least DEPTH of a sounding", [](const Summary& s) { return s.least_depth; }},
    {"MAX_DEPTH", i32, 100, "m", "greatest DEPTH of a sounding", [](const Summary& s) { return s.greatest_depth; }}};

}  // namespace

std::span<const GsfParameter> gsf_parameters() { return parameters; }
std::span<const GsfField<GsfSurvey>> gsf_parameter_fields() { return parameter_fields; }
std::span<const GsfField<GsfSurvey>> gsf_profile_fields() { return profile_fields; }
std::span<const GsfField<GsfProfileEntry>> gsf_profile_entry_fields() { return profile_entry_fields; }
std::span<const GsfField<GsfSurvey>> gsf_comment_fields() { return comment_fields; }
std::span<const GsfField<GsfSurvey>> gsf_history_fields() { return history_fields; }
std::span<const GsfField<GsfSurvey>> gsf_position_error_fields() { return position_error_fields; }
std::span<const GsfField<GsfAttitudeHead>> gsf_attitude_fields() { return attitude_fields; }
std::span<const GsfField<GsfAttitude>> gsf_attitude_entry_fields() { return attitude_entry_fields; }
std::span<const GsfField<GsfSummary>> gsf_summary_fields() { return summary_fields; }

}  // namespace insonify

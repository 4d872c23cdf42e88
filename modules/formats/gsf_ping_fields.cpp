// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "formats/gsf_fields_internal.hpp"

namespace insonify {
namespace {

using enum GsfType;
using Swath = GsfPing;

constexpr double confidence_95 = 1.959963985;
constexpr double knots_per_m_s = 3600.0 / 1852;

/// Returns true if a correction fits into the centimetres of TIDE_CORRECTOR. Larger ones go to GPS_TIDE_CORRECTOR.
bool is_small_tide(double tide) { return std::abs(tide) < 327; }

/// Returns the middle beam. The GSF library takes an EM 2040 whose centre is before it for the starboard of two heads.
double middle_beam(const GsfPing& p) { return static_cast<double>(p.beams.size() / 2); }

double detections(const GsfPing& p) {
  return static_cast<double>(std::count_if(p.beams.begin(), p.beams.end(), [](const auto& b) { return b.detected; }));
}

double low_16_bits(std::uint32_t number) { return number & 0xffffU; }

/// Returns the absorption [dB/km], at most `most`.
double absorption_db_per_km(const GsfPing& p, double most) { return std::min(most, 1000 * p.absorption_db_per_m); }

const GsfField<Swath> ping_fields[] = {
    {"TIME", u32, 1, "s", "of transmission, UTC since 1970", [](const Swath& p) { return gsf_seconds(p.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Swath& p) { return gsf_fraction(p.time); }},
    {"LONGITUDE", i32, 1e7, "deg", "of the head on WGS 84, positive east",
     [](const Swath& p) { return gsf_longitude(p.position.longitude); }},
    {"LATITUDE", i32, 1e7, "deg", "of the head on WGS 84, positive north",
     [](const Swath& p) { return degrees(p.position.latitude); }},
    {"NUM_BEAMS", u16, 1, "", "entries of every array, from port to starboard",
     [](const Swath& p) { return static_cast<double>(p.beams.size()); }},
    {"CENTER_BEAM", u16, 1, "", "the middle one, from 0: half of NUM_BEAMS", middle_beam},
    {"PING_FLAGS", zeros, 2, "", ""},
    {"RESERVED", zeros, 2, "", ""},
    {"TIDE_CORRECTOR", i16, 100, "m",
     "what was added to depths below the water level for those below z = 0: the negative height of the water level",
     [](const Swath& p) { return is_small_tide(p.tide) ? p.tide : 0; }},
    {"DEPTH_CORRECTOR", i32, 100, "m", "depth of the head below the water level, positive down, part of every depth",
     [](const Swath& p) { return p.head_depth; }},
    {"HEADING", u16, 100, "deg", "of the ship, clockwise from north, 0 to 359.99",
     [](const Swath& p) { return gsf_compass(p.heading, 100); }},
    {"PITCH", i16, 100, "deg", "of the ship, positive bow up", [](const Swath& p) { return degrees(p.pitch); }},
    {"ROLL", i16, 100, "deg", "of the ship about its own x axis, positive starboard down",
     [](const Swath& p) { return degrees(p.roll); }},
    {"HEAVE", i16, 100, "m", "0: DEPTH_CORRECTOR is the whole depth of the head at the ping",
     [](const Swath& p) { return p.heave; }},
    {"COURSE", u16, 100, "deg",
     "of the ship over ground, clockwise from north, 0 to 359.99; of one at rest its heading",
     [](const Swath& p) { return gsf_compass(p.course, 100); }},
    {"SPEED", u16, 100, "kn", "of the ship over ground", [](const Swath& p) { return p.speed * knots_per_m_s; }},
    {"HEIGHT", i32, 1000, "m", "of the head above the ellipsoid", [](const Swath& p) { return p.position.height; }},
    {"SEPARATION", i32, 1000, "m", "height of z = 0 above the ellipsoid at the head, positive up",
     [](const Swath& p) { return p.separation; }},
    {"GPS_TIDE_CORRECTOR", i32, 1000, "m", "in place of TIDE_CORRECTOR from 327 m on",
     [](const Swath& p) { return is_small_tide(p.tide) ? 0 : p.tide; }},
    {"SPARE", zeros, 2, "", ""}};

const GsfArray arrays[] = {
    {1, 0x40, u32, 10000, 10000, "DEPTH", "m", "below z = 0, positive down; above it negative, by the offset",
     [](const GsfBeam& b) { return b.depth; }},
    {2, 0x40, i32, 10000, 0, "ACROSS_TRACK", "m", "from the head, level and athwart the ship, positive to starboard",
     [](const GsfBeam& b) { return b.across; }},
    {3, 0x40, i32, 10000, 0, "ALONG_TRACK", "m", "from the head, level and along the ship, positive ahead",
     [](const GsfBeam& b) { return b.along; }},
    {4, 0x40, u32, 100000000, 0, "TRAVEL_TIME", "s", "there and back", [](const GsfBeam& b) { return b.travel_time; }},
    {5, 0, i16, 180, 0, "BEAM_ANGLE", "deg",
     "of the beam from straight down at the head, 0 to 180, whatever the attitude",
     [](const GsfBeam& b) { return degrees(b.angle); }},
    {6, 0x20, i16, 100, 0, "MEAN_CAL_AMPLITUDE", "dB", "level of the echo's strongest sample [dB re 1 uPa]",
     [](const GsfBeam& b) { return std::clamp(b.level_db, -327.0, 327.0); }},
    {9, 0, u8, 50, 0, "QUALITY_FACTOR", "", "log10(range / its standard deviation), at most 5.1",
     [](const GsfBeam& b) { return std::clamp(b.quality, 0.0, 5.1); }},
    {18, 0, u16, 180, 0, "BEAM_ANGLE_FORWARD", "deg",
     "azimuth of the beam counter-clockwise from starboard, 0 to 359.99: ahead is 90, port 180, astern 270",
     [](const GsfBeam& b) { return gsf_compass(b.azimuth, 180); }},
    {19, 0, u16, 10000, 0, "VERTICAL_ERROR", "m",
     "of the sounding, at 95 % (1.96 standard deviations): its TVU if the mission states its instruments, else by its "
     "range alone",
     [](const GsfBeam& b) { return std::min(6.5, confidence_95 * b.vertical_deviation); }},
    {20, 0, u16, 10000, 0, "HORIZONTAL_ERROR", "m",
     "of the sounding, at 95 %: its THU if the mission states its instruments, else by its range alone",
     [](const GsfBeam& b) { return std::min(6.5, confidence_95 * b.horizontal_deviation); }},
    {23, 0, u8, 1, 0, "DETECTION_INFO", "", "0: centre of gravity of the echo, 1: zero of the phase, 132: no sounding",
     [](const GsfBeam& b) { return b.by_phase ? 1.0 : 0.0; }, 132}};

const GsfField<Swath> seabat_ii_fields[] = {
    {"PING_NUMBER", u16, 1, "", "its lowest 16 bits", [](const Swath& p) { return low_16_bits(p.number); }},
    {"SURFACE_VELOCITY", u16, 10, "m/s", "sound speed at the head",
     [](const Swath& p) { return p.surface_sound_speed; }},
    {"MODE", zeros, 2, "", ""},
    {"SONAR_RANGE", u16, 1, "m", "longest range of the gate", [](const Swath& p) { return p.range; }},
    {"TRANSMIT_POWER, RECEIVE_GAIN", zeros, 4, "", ""},
    {"FORE_AFT_BW", u8, 10, "deg", "-3 dB width of the beams along the ship, at most 25.5",
     [](const Swath& p) { return std::min(25.5, degrees(p.beam_width_along)); }},
    {"ATHWART_BW", u8, 10, "deg", "-3 dB width of the beams across the ship, at most 25.5",
     [](const Swath& p) { return std::min(25.5, degrees(p.beam_width_across)); }},
    {"SPARE", zeros, 4, "", ""}};

const GsfField<Swath> em2040_fields[] = {
    {"MODEL_NUMBER", u16, 1, "", "2040", [](const Swath&) { return 2040.0; }},
    {"PING_COUNTER", u16, 1, "", "number of the ping, its lowest 16 bits",
     [](const Swath& p) { return low_16_bits(p.number); }},
    {"SERIAL_NUMBER", zeros, 2, "", ""},
    {"SURFACE_VELOCITY", u16, 10, "m/s", "sound speed at the head",
     [](const Swath& p) { return p.surface_sound_speed; }},
    {"TRANSDUCER_DEPTH", i32, 20000, "m", "as DEPTH_CORRECTOR", [](const Swath& p) { return p.head_depth; }},
    {"VALID_DETECTIONS", u16, 1, "", "beams with a sounding", detections},
    {"SAMPLING_FREQUENCY", u32, 1, "Hz", "of the samples of a beam, whole",
     [](const Swath& p) { return std::floor(p.sample_rate); }},
    {"SAMPLING_FREQUENCY_FRACTION", u32, 4e9, "Hz", "its fraction",
     [](const Swath& p) { return p.sample_rate - std::floor(p.sample_rate); }},
    {"DOPPLER_CORRECTION_SCALE", zeros, 4, "", ""},
    {"VEHICLE_DEPTH", i32, 1000, "m", "of the ship's origin below the water level; 0 if it is not below",
     [](const Swath& p) { return std::max(0.0, p.ship_depth); }},
    {"SPARE_1", zeros, 16, "", ""},
    {"TRANSMIT_SECTORS", u16, 1, "", "1", [](const Swath&) { return 1.0; }},
    {"TILT_ANGLE, FOCUS_RANGE, SIGNAL_LENGTH, TRANSMIT_DELAY", zeros, 12, "", ""},
    {"CENTER_FREQUENCY", u32, 1000, "Hz", "of the sector", [](const Swath& p) { return p.centre_frequency; }},
    {"MEAN_ABSORPTION", u16, 100, "dB/km", "of the sector, at most 655",
     [](const Swath& p) { return absorption_db_per_km(p, 655); }},
    {"WAVEFORM_ID, SECTOR_NUMBER", zeros, 2, "", ""},
    {"SIGNAL_BANDWIDTH", u32, 1000, "Hz", "of the sector", [](const Swath& p) { return p.bandwidth; }},
    {"SPARE, SPARE_2", zeros, 32, "", ""},
    {"RUN_TIME_MODEL_NUMBER", u16, 1, "", "2040", [](const Swath&) { return 2040.0; }},
    {"RUN_TIME_SECONDS", u32, 1, "s", "as TIME", [](const Swath& p) { return gsf_seconds(p.time); }},
    {"RUN_TIME_NANOSECONDS", u32, 1e9, "s", "as TIME_NS", [](const Swath& p) { return gsf_fraction(p.time); }},
    {"RUN_TIME_PING_COUNTER", u16, 1, "", "as PING_COUNTER", [](const Swath& p) { return low_16_bits(p.number); }},
    {"serial number to maximum depth", zeros, 12, "", ""},
    {"RUN_TIME_ABSORPTION", u16, 100, "dB/km", "as MEAN_ABSORPTION",
     [](const Swath& p) { return absorption_db_per_km(p, 655); }},
    {"RUN_TIME_PULSE_LENGTH", zeros, 2, "", ""},
    {"RUN_TIME_TRANSMIT_BEAM_WIDTH", u16, 10, "deg", "-3 dB width of the beams along the ship",
     [](const Swath& p) { return degrees(p.beam_width_along); }},
    {"RUN_TIME_POWER_REDUCTION", zeros, 1, "", ""},
    {"RUN_TIME_RECEIVE_BEAM_WIDTH", u8, 10, "deg", "-3 dB width of the beams across the ship, at most 25.5",
     [](const Swath& p) { return std::min(25.5, degrees(p.beam_width_across)); }},
    {"receive bandwidth to the spare bytes of the status", zeros, 54, "", ""}};

const GsfField<Swath> r2sonic_fields[] = {
    {"MODEL_NUMBER", text, 12, "", "2024", nullptr, [](const Swath&) { return std::string("2024"); }},
    {"SERIAL_NUMBER", zeros, 12, "", ""},
    {"TIME", u32, 1, "s", "as of the ping", [](const Swath& p) { return gsf_seconds(p.time); }},
    {"TIME_NS", u32, 1e9, "s", "its fraction", [](const Swath& p) { return gsf_fraction(p.time); }},
    {"PING_NUMBER", u32, 1, "", "from 0", [](const Swath& p) { return static_cast<double>(p.number); }},
    {"PING_PERIOD", u32, 1e6, "s", "since the ping before; 0 of the first, and from 4294 s on",
     [](const Swath& p) { return p.period >= 0 && p.period < 4294 ? p.period : 0; }},
    {"SOUND_SPEED", u32, 100, "m/s", "at the head", [](const Swath& p) { return p.surface_sound_speed; }},
    {"FREQUENCY", u32, 1000, "Hz", "centre of the pulse", [](const Swath& p) { return p.centre_frequency; }},
    {"TX_POWER", u32, 100, "dB", "source level [dB re 1 uPa at 1 m]",
     [](const Swath& p) { return std::max(0.0, p.source_level_db); }},
    {"TX_PULSE_WIDTH", zeros, 4, "", ""},
    {"BEAMWIDTH_VERT", u32, 1e6, "deg",
     "-3 dB width of the beams along the ship, in degrees as the GSF library reads it",
     [](const Swath& p) { return degrees(p.beam_width_along); }},
    {"BEAMWIDTH_HORIZ", u32, 1e6, "deg",
     "-3 dB width of the beams across the ship, in degrees as the GSF library reads it",
     [](const Swath& p) { return degrees(p.beam_width_across); }},
    {"TX_STEERING_VERT, TX_STEERING_HORIZ, TX_MISC_INFO", zeros, 12, "", ""},
    {"RX_BANDWIDTH", u32, 1e4, "Hz", "of the pulse, at most 429 kHz",
     [](const Swath& p) { return std::min(429e3, p.bandwidth); }},
    {"RX_SAMPLE_RATE", u32, 1000, "Hz", "of the samples of a beam", [](const Swath& p) { return p.sample_rate; }},
    {"RX_RANGE", u32, 1e5, "s", "there and back to the longest range of the gate",
     [](const Swath& p) { return p.surface_sound_speed > 0 ? 2 * p.range / p.surface_sound_speed : 0; }},
    {"RX_GAIN, RX_SPREADING", zeros, 8, "", ""},
    {"RX_ABSORPTION", u32, 1000, "dB/km", "one way", [](const Swath& p) { return absorption_db_per_km(p, 4e6); }},
    {"RX_MOUNT_TILT, RX_MISC_INFO, RESERVED", zeros, 10, "", ""},
    {"NUM_BEAMS", u16, 1, "", "as of the ping", [](const Swath& p) { return static_cast<double>(p.beams.size()); }},
    {"A0_MORE_INFO to SPARE", zeros, 92, "", ""}};

}  // namespace

const GsfArray gsf_beam_flags = {
    16,
    0,
    u8,
    1,
    0,
    "BEAM_FLAGS",
    "",
    "0: a sounding, 9: a rejected one (edited by a filter), 1: none; a size of its own, no scale factor",
    [](const GsfBeam& b) { return b.rejected ? 9.0 : 0.0; },
    1};

std::span<const GsfField<GsfPing>> gsf_ping_fields() { return ping_fields; }
std::span<const GsfArray> gsf_arrays() { return arrays; }

std::span<const GsfField<GsfPing>> gsf_sensor_fields(GsfSensor sensor) {
  if (sensor == GsfSensor::em2040) return em2040_fields;
  if (sensor == GsfSensor::r2sonic_2024) return r2sonic_fields;
  return seabat_ii_fields;
}

GsfSensor gsf_sensor_of(const std::string& sonar) {
  if (sonar == "em2040") return GsfSensor::em2040;
  if (sonar == "r2sonic-2024") return GsfSensor::r2sonic_2024;
  return GsfSensor::seabat_ii;
}

double gsf_compass(double angle, double steps) {
  const double turn = std::fmod(std::fmod(degrees(angle), 360) + 360, 360);
  return std::fmod(std::nearbyint(turn * steps), 360 * steps) / steps;
}

}  // namespace insonify

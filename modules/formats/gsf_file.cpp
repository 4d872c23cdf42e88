#include "formats/gsf_file.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "formats/packed_bytes_internal.hpp"

namespace insonify {
namespace {

// Records, and subrecords of a ping.
enum : std::uint32_t { header_record = 1, ping_record = 2, profile_record = 3, parameter_record = 4 };
constexpr std::uint8_t beam_flags_id = 16, scale_factors_id = 100, seabat_ii_id = 114;
constexpr std::size_t most_beams = 18000;  // of 28 bytes: a record has at most 2^19
constexpr double confidence_95 = 1.959963985;
constexpr double knots_per_m_s = 3600.0 / 1852;

enum class GsfType { u8, i16, u16, i32, u32 };

/// An array of one number per beam: raw = (value + offset) times multiplier, rounded.
struct GsfArray {
  std::uint8_t id, size_flag;  ///< of the field: 0 the usual, 0x40 four bytes
  GsfType type;
  std::int32_t multiplier, offset;
  const char* name;
  double (*value)(const GsfBeam& beam);
};

const GsfArray gsf_arrays[] = {
    {1, 0x40, GsfType::u32, 10000, 10000, "depth below z = 0", [](const GsfBeam& b) { return b.depth; }},
    {2, 0x40, GsfType::i32, 10000, 0, "across", [](const GsfBeam& b) { return b.across; }},
    {3, 0x40, GsfType::i32, 10000, 0, "along", [](const GsfBeam& b) { return b.along; }},
    {4, 0x40, GsfType::u32, 100000000, 0, "travel_time", [](const GsfBeam& b) { return b.travel_time; }},
    {5, 0, GsfType::i16, 100, 0, "angle", [](const GsfBeam& b) { return degrees(b.angle); }},
    {18, 0, GsfType::i16, 100, 0, "azimuth",
     [](const GsfBeam& b) { return degrees(std::remainder(b.azimuth, 2 * pi)); }},
    {7, 0, GsfType::u8, 1, 0, "level_db", [](const GsfBeam& b) { return std::clamp(b.level_db, 0.0, 255.0); }},
    {9, 0, GsfType::u8, 50, 0, "quality", [](const GsfBeam& b) { return std::clamp(b.quality, 0.0, 5.1); }},
    {19, 0, GsfType::u16, 10000, 0, "vertical_deviation",
     [](const GsfBeam& b) { return std::min(6.5, confidence_95 * b.vertical_deviation); }},
    {20, 0, GsfType::u16, 10000, 0, "horizontal_deviation",
     [](const GsfBeam& b) { return std::min(6.5, confidence_95 * b.horizontal_deviation); }}};

/// Rounds `value` to a number of the field; Error(content) if it has no room there.
template <typename Number>
Number gsf_number(double value, const GsfPing& ping, const char* name) {
  const double rounded = std::nearbyint(value);
  if (!(rounded >= static_cast<double>(std::numeric_limits<Number>::lowest()) &&
        rounded <= static_cast<double>(std::numeric_limits<Number>::max())))
    fail(ErrorKind::content, "GSF: ", name, " of ping ", ping.number, " is ", value,
         " in units of its field, must be within ", +std::numeric_limits<Number>::lowest(), " and ",
         +std::numeric_limits<Number>::max());
  return static_cast<Number>(rounded);
}

void put_gsf(std::string& bytes, GsfType type, double raw, const GsfPing& ping, const char* name) {
  switch (type) {
    case GsfType::u8:
      put_big(bytes, gsf_number<std::uint8_t>(raw, ping, name));
      break;
    case GsfType::i16:
      put_big(bytes, gsf_number<std::int16_t>(raw, ping, name));
      break;
    case GsfType::u16:
      put_big(bytes, gsf_number<std::uint16_t>(raw, ping, name));
      break;
    case GsfType::i32:
      put_big(bytes, gsf_number<std::int32_t>(raw, ping, name));
      break;
    case GsfType::u32:
      put_big(bytes, gsf_number<std::uint32_t>(raw, ping, name));
      break;
  }
}

void put_time(std::string& bytes, double time) {
  const double whole = std::floor(time);
  if (!(whole >= 0 && whole < 4294967296.0))
    fail(ErrorKind::content, "GSF: time ", time, " s since 1970 must be within 1970 and 2106; give --start-utc");
  put_big(bytes, static_cast<std::uint32_t>(whole));
  put_big(bytes, static_cast<std::uint32_t>(std::min(999999999.0, std::nearbyint((time - whole) * 1e9))));
}

void put_place(std::string& bytes, const GeoPlace& place) {
  put_big(bytes, static_cast<std::int32_t>(std::nearbyint(degrees(std::remainder(place.longitude, 2 * pi)) * 1e7)));
  put_big(bytes, static_cast<std::int32_t>(std::nearbyint(degrees(place.latitude) * 1e7)));
}

/// The 56 bytes that begin a ping.
std::string ping_header(const GsfPing& p) {
  const auto turn = [](double angle) { return std::fmod(std::fmod(angle, 2 * pi) + 2 * pi, 2 * pi); };
  const auto hundredths = [](double angle) { return std::nearbyint(degrees(angle) * 100); };
  std::string bytes;
  put_time(bytes, p.time);
  put_place(bytes, p.place);
  put_big(bytes, static_cast<std::uint16_t>(p.beams.size()));
  put_big(bytes, static_cast<std::uint16_t>(p.beams.size() / 2));
  put_big(bytes, std::uint32_t{0});  // flags, reserved
  put_big(bytes, std::int16_t{0});   // tide
  put_big(bytes, std::int32_t{0});   // depth corrector
  put_big(bytes, gsf_number<std::uint16_t>(std::fmod(hundredths(turn(p.heading)), 36000), p, "heading"));
  put_big(bytes, gsf_number<std::int16_t>(hundredths(p.pitch), p, "pitch"));
  put_big(bytes, gsf_number<std::int16_t>(hundredths(p.roll), p, "roll"));
  put_big(bytes, gsf_number<std::int16_t>(p.heave * 100, p, "heave"));
  put_big(bytes, gsf_number<std::uint16_t>(std::fmod(hundredths(turn(p.course)), 36000), p, "course"));
  put_big(bytes, gsf_number<std::uint16_t>(p.speed * knots_per_m_s * 100, p, "speed"));
  bytes.append(4 * 3 + 2, '\0');  // height, separation and tide of a satellite receiver; spare
  return bytes;
}

void put_subrecord(std::string& bytes, std::uint8_t id, const std::string& data) {
  put_big(bytes, static_cast<std::uint32_t>(std::uint32_t{id} << 24 | static_cast<std::uint32_t>(data.size())));
  bytes += data;
}

std::string scale_factors() {
  std::string bytes;
  put_big(bytes, static_cast<std::uint32_t>(std::size(gsf_arrays)));
  for (const GsfArray& array : gsf_arrays) {
    put_big(bytes, static_cast<std::uint32_t>(std::uint32_t{array.id} << 24 | std::uint32_t{array.size_flag} << 16));
    put_big(bytes, array.multiplier);
    put_big(bytes, array.offset);
  }
  return bytes;
}

std::string seabat_ii(const GsfPing& p) {
  std::string bytes;
  put_big(bytes, p.number);
  put_big(bytes, gsf_number<std::uint16_t>(p.surface_sound_speed * 10, p, "surface_sound_speed"));
  put_big(bytes, std::uint16_t{0});  // mode
  put_big(bytes, gsf_number<std::uint16_t>(p.range, p, "range"));
  put_big(bytes, std::uint32_t{0});  // power, gain
  put_big(bytes, gsf_number<std::uint8_t>(std::min(255.0, degrees(p.beam_width_along) * 10), p, "beam_width_along"));
  put_big(bytes, gsf_number<std::uint8_t>(std::min(255.0, degrees(p.beam_width_across) * 10), p, "beam_width_across"));
  return bytes.append(4, '\0');
}

}  // namespace

GsfFile::GsfFile(const std::string& path, const SoundSpeedProfile& profile, const GeoPlace& place,
                 double reference_time, const std::vector<std::string>& parameters)
    : pending_(path), out_(pending_.temporary(), std::ios::binary) {
  record(header_record, std::string("GSF-v03.11\0\0", 12));

  std::string text;
  put_time(text, reference_time);
  put_big(text, static_cast<std::uint16_t>(parameters.size()));
  for (const std::string& parameter : parameters) {
    put_big(text, static_cast<std::uint16_t>(parameter.size() + 1));
    text.append(parameter).push_back('\0');
  }
  record(parameter_record, std::move(text));

  std::string water;
  put_time(water, reference_time);  // observed
  put_time(water, reference_time);  // applied
  put_place(water, place);
  put_big(water, static_cast<std::uint32_t>(profile.depth.size()));
  for (std::size_t i = 0; i < profile.depth.size(); ++i) {
    put_big(water, static_cast<std::uint32_t>(std::nearbyint(std::max(0.0, profile.depth[i]) * 100)));
    put_big(water, static_cast<std::uint32_t>(std::nearbyint(profile.sound_speed[i] * 100)));
  }
  record(profile_record, std::move(water));
}

void GsfFile::record(std::uint32_t id, std::string data) {
  data.append((4 - data.size() % 4) % 4, '\0');
  std::string head;
  put_big(head, static_cast<std::uint32_t>(data.size()));
  put_big(head, id);
  out_ << head << data;
}

void GsfFile::add(const GsfPing& ping) {
  if (ping.beams.empty() || ping.beams.size() > most_beams)
    fail(ErrorKind::content, "GSF: ping ", ping.number, " has ", ping.beams.size(), " soundings, must be within 1 and ",
         most_beams);
  std::string data = ping_header(ping);
  if (!scaled_) put_subrecord(data, scale_factors_id, scale_factors());
  scaled_ = true;
  for (const GsfArray& array : gsf_arrays) {
    std::string values;
    for (const GsfBeam& beam : ping.beams)
      put_gsf(values, array.type, ((beam.detected ? array.value(beam) : 0) + array.offset) * array.multiplier, ping,
              array.name);
    put_subrecord(data, array.id, values);
  }
  std::string flags;
  for (const GsfBeam& beam : ping.beams) flags.push_back(beam.detected ? '\0' : '\1');
  put_subrecord(data, beam_flags_id, flags);
  put_subrecord(data, seabat_ii_id, seabat_ii(ping));
  record(ping_record, std::move(data));
}

void GsfFile::finish() { pending_.commit(out_); }

}  // namespace insonify

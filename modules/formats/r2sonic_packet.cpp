// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "formats/r2sonic_record.hpp"
#include "formats/record_bytes_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t packet_head = 12, section_head = 4;
constexpr std::size_t more_info_bytes = 24;

/// Returns the next float, which must be finite.
double stored_float(RecordBytes& section) {
  const auto value = section.big<float>();
  if (!std::isfinite(value)) fail(ErrorKind::content, section.where(), " holds a number that is not finite");
  return static_cast<double>(value);
}

/// Returns the header of the packet, and by `points` how many soundings it has.
R2SonicPacket r2sonic_header(RecordBytes section, std::size_t& points) {
  R2SonicPacket p;
  p.model = section.text(12), p.serial_number = section.text(12);
  p.time = section.big<std::uint32_t>(), p.time += 1e-9 * section.big<std::uint32_t>();
  p.number = section.big<std::uint32_t>();
  for (double R2SonicPacket::*member :
       {&R2SonicPacket::period, &R2SonicPacket::sound_speed, &R2SonicPacket::frequency, &R2SonicPacket::source_level_db,
        &R2SonicPacket::pulse_width, &R2SonicPacket::beam_width_along, &R2SonicPacket::beam_width_across})
    p.*member = stored_float(section);
  section.take(12);  // two steering angles, temperature and offset of the transmitter
  for (double R2SonicPacket::*member :
       {&R2SonicPacket::bandwidth, &R2SonicPacket::sample_rate, &R2SonicPacket::range, &R2SonicPacket::gain,
        &R2SonicPacket::spreading, &R2SonicPacket::absorption_db_per_km, &R2SonicPacket::tilt})
    p.*member = stored_float(section);
  section.take(6);
  points = section.big<std::uint16_t>();
  if (points == 0) fail(ErrorKind::content, section.where(), " has no point");
  return p;
}

/// Returns `points` numbers of this type times the scale before them.
std::vector<double> scaled_numbers(RecordBytes& section, std::size_t points) {
  const double scale = stored_float(section);
  std::vector<double> values(points);
  for (double& value : values) value = section.big<std::uint16_t>() * scale;
  return values;
}

std::vector<double> equal_angles(RecordBytes& section, std::size_t points) {
  const double first = stored_float(section), last = stored_float(section);
  std::vector<double> angles(points, first);
  for (std::size_t n = 1; n < points; ++n)
    angles[n] = first + static_cast<double>(n) * (last - first) / static_cast<double>(points - 1);
  return angles;
}

std::vector<double> stepped_angles(RecordBytes& section, std::size_t points) {
  const double first = stored_float(section), scale = stored_float(section);
  section.take(more_info_bytes);
  std::uint32_t steps = 0;
  std::vector<double> angles(points);
  for (double& angle : angles) steps += section.big<std::uint16_t>(), angle = first + steps * scale;
  return angles;
}

R2SonicGates line_gates(RecordBytes& section) {
  R2SonicGates gates;
  gates.earliest = stored_float(section), gates.latest = stored_float(section), gates.slope = stored_float(section);
  return gates;
}

R2SonicGates gates_of_points(RecordBytes& section, std::size_t points) {
  const double scale = stored_float(section);
  R2SonicGates gates;
  for (std::vector<double>* of : {&gates.earliest_of_points, &gates.latest_of_points})
    for (std::size_t n = 0; n < points; ++n) of->push_back(section.big<std::uint8_t>() * scale);
  return gates;
}

/// Returns the four bits of each point; the first of two is in the higher half of a byte.
std::vector<std::uint8_t> flags_in(RecordBytes& section, std::size_t points) {
  const std::string_view bytes = section.take((points + 1) / 2);
  std::vector<std::uint8_t> flags(points);
  for (std::size_t n = 0; n < points; ++n)
    flags[n] = static_cast<std::uint8_t>(static_cast<std::uint8_t>(bytes[n / 2]) >> (n % 2 == 0 ? 4 : 0) & 15);
  return flags;
}

void take_section(const std::string& name, RecordBytes section, std::size_t points, R2SonicPacket& p) {
  if (name == "R0") p.travel_time = scaled_numbers(section, points);
  if (name == "A0") p.angle = equal_angles(section, points);
  if (name == "A2") p.angle = stepped_angles(section, points);
  if (name == "I1") p.intensity = scaled_numbers(section, points);
  if (name == "G0") p.gates = line_gates(section);
  if (name == "G1") p.gates = gates_of_points(section, points);
  if (name == "Q0") p.flags = flags_in(section, points);
}

}  // namespace

R2SonicPacket read_r2sonic_packet(const std::string& bytes, const std::string& where) {
  RecordBytes packet(bytes, where);
  if (packet.take(4) != "BTH0") fail(ErrorKind::content, where, " does not begin with BTH0");
  const auto size = packet.big<std::uint32_t>();
  if (size < packet_head || size > bytes.size())
    fail(ErrorKind::content, where, ": its BTH0 packet has ", size, " bytes, must have at least ", packet_head,
         " and at most ", bytes.size());
  packet.take(4);
  R2SonicPacket result;
  std::size_t points = 0;
  for (std::size_t at = packet_head; at + section_head <= size;) {
    packet.go_to(at);
    const std::string name(packet.take(2));
    const std::size_t section_bytes = packet.big<std::uint16_t>();
    if (section_bytes < section_head || section_bytes > size - at)
      fail(ErrorKind::content, where, ": the section at byte ", at, " has ", section_bytes, " bytes, must have ",
           section_head, " to ", size - at);
    RecordBytes section(packet.take(section_bytes - section_head), where + ": section at byte " + std::to_string(at));
    if (name == "H0")
      result = r2sonic_header(section, points);
    else if (points > 0)
      take_section(name, section, points, result);
    at += section_bytes;
  }
  if (points == 0 || result.travel_time.empty() || result.angle.empty())
    fail(ErrorKind::content, where, ": its BTH0 packet must hold the sections H0, R0, and A0 or A2");
  return result;
}

}  // namespace insonify

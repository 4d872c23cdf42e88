// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "formats/swath_record.hpp"

namespace insonify {

/// Gates of a bathymetry packet, between which a sonar looks for the bottom, as two-way travel times [s].
struct R2SonicGates {
  double earliest = 0, latest = 0, slope = 0;  ///< section G0: of lines, whose slope is in [rad]; 0: not recorded
  std::vector<double> earliest_of_points{}, latest_of_points{};  ///< section G1; empty: not recorded
};

/// One bathymetry packet of an R2Sonic echo sounder as it is stored: numbers times their scales.
struct R2SonicPacket {
  std::string model, serial_number;
  double time = 0;  ///< UTC, seconds since 1970
  std::uint32_t number = 0;
  double period = 0, sound_speed = 0, frequency = 0;                   ///< [s, m/s, Hz]
  double source_level_db = 0, pulse_width = 0;                         ///< [dB re 1 uPa at 1 m, s]
  double beam_width_along = 0, beam_width_across = 0;                  ///< widths of the projector's beam [rad]
  double bandwidth = 0, sample_rate = 0, range = 0;                    ///< [Hz, Hz, m]
  double gain = 0, spreading = 0, absorption_db_per_km = 0, tilt = 0;  ///< [as stored, dB per decade, dB/km, rad]
  std::vector<double> travel_time{};                                   ///< two-way travel times of the points [s]
  std::vector<double> angle{};        ///< angles from the centre line of the array [rad], positive to starboard
  std::vector<double> intensity{};    ///< [uPa]; empty: not recorded
  std::vector<std::uint8_t> flags{};  ///< bits of each point, r2sonic_by_phase and others; empty: not recorded
  R2SonicGates gates{};
};

/// Bits of R2SonicPacket::flags.
inline constexpr std::uint8_t r2sonic_by_phase = 8, r2sonic_by_amplitude = 4, r2sonic_passed = 3;

/// Reads the packet 'BTH0' at the beginning of `bytes`, sections H0, R0, A0 or A2, I1, G0 or G1, and Q0 (R2Sonic,
/// Sonic 2024/2022 operation manual); other sections are skipped. `where` names the packet in errors. Throws
/// Error(content) for anything else, a section that is too short, or a packet without H0, R0, and A0 or A2.
R2SonicPacket read_r2sonic_packet(const std::string& bytes, const std::string& where);

/// Reads an XTF file (Triton, X41) of bathymetry packets of an R2Sonic (type 65) and attitudes (type 3). The packets
/// hold travel times and angles, and no positions of soundings: these follow along straight rays from attitude and
/// heave of the packet's header (E211). Throws Error(file) if the file cannot be read, Error(content) if it is no XTF,
/// damaged, or without such a packet.
SwathRecord read_r2sonic_xtf(const std::string& path);

/// Returns true if a file is an XTF that describes channels of bathymetry and none of a side-scan.
bool is_bathymetry_xtf(const std::string& path);

}  // namespace insonify

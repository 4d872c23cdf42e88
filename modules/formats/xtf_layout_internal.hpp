// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

// Private to formats: offsets of XTF's fields, from the specification X41 (Triton Imaging, 2016), tables C, D, F, H, I.
namespace insonify {

constexpr std::uint8_t xtf_file_format = 123;
constexpr std::uint16_t xtf_magic = 0xFACE;
constexpr std::size_t xtf_header_bytes = 1024, xtf_channel_bytes = 128, xtf_ping_bytes = 256, xtf_trace_bytes = 64;
constexpr std::size_t xtf_note_bytes = 256, xtf_packet_step = 64, xtf_packet_head = 14;
constexpr std::uint8_t xtf_sonar_packet = 0, xtf_notes_packet = 1;
constexpr std::size_t xtf_channels_in_header = 6;
constexpr std::uint16_t xtf_degrees = 3, xtf_tvg_flag = 4;
constexpr double xtf_knot = 1852.0 / 3600;  // [m/s]

/// Offsets in the file's header, which has a multiple of 1024 bytes.
enum XtfHeaderOffset : std::size_t {
  xtf_format_at = 0,
  xtf_system_at = 1,
  xtf_program_at = 2,
  xtf_version_at = 10,
  xtf_sonar_at = 18,
  xtf_note_at = 36,
  xtf_file_name_at = 100,
  xtf_nav_units_at = 164,
  xtf_sonar_channels_at = 166,
  xtf_bathymetry_channels_at = 168,
  xtf_snippet_channels_at = 170,
  xtf_forward_channels_at = 171,
  xtf_echo_channels_at = 172,
  xtf_interferometry_channels_at = 174,
  xtf_channels_at = 256
};

/// Offsets in the description of a channel in the file's header, 128 bytes.
enum XtfChannelOffset : std::size_t {
  xtf_side_at = 0,
  xtf_sub_channel_at = 1,
  xtf_correction_at = 2,
  xtf_unipolar_at = 4,
  xtf_sample_bytes_at = 6,
  xtf_old_samples_at = 8,
  xtf_channel_name_at = 12,
  xtf_volts_at = 28,
  xtf_channel_frequency_at = 32,
  xtf_beam_angle_at = 36,
  xtf_tilt_at = 40,
  xtf_beam_width_at = 44,
  xtf_sample_format_at = 74
};

/// Offsets in a packet. From the year on they are those of pings (256 bytes) and annotations.
enum XtfPacketOffset : std::size_t {
  xtf_magic_at = 0,
  xtf_packet_type_at = 2,
  xtf_traces_at = 4,
  xtf_packet_bytes_at = 10,
  xtf_year_at = 14,
  xtf_month_at = 16,
  xtf_day_at = 17,
  xtf_hour_at = 18,
  xtf_minute_at = 19,
  xtf_second_at = 20,
  xtf_hundredth_at = 21,
  xtf_day_of_year_at = 22,
  xtf_ping_number_at = 28,
  xtf_sound_speed_at = 32,
  xtf_note_text_at = 56,
  xtf_computed_speed_at = 72,
  xtf_ship_speed_at = 120,
  xtf_ship_gyro_at = 124,
  xtf_ship_y_at = 128,
  xtf_ship_x_at = 136,
  xtf_fix_hour_at = 148,
  xtf_sensor_speed_at = 152,
  xtf_sensor_y_at = 160,
  xtf_sensor_x_at = 168,
  xtf_depth_at = 192,
  xtf_altitude_at = 196,
  xtf_pitch_at = 204,
  xtf_roll_at = 208,
  xtf_heading_at = 212,
  xtf_heave_at = 216,
  xtf_yaw_at = 220,
  xtf_attitude_tag_at = 224,
  xtf_fix_milliseconds_at = 232,
  xtf_clock_hour_at = 236
};

/// Offsets in the header of a channel in a ping's packet, 64 bytes before its samples.
enum XtfTraceOffset : std::size_t {
  xtf_trace_channel_at = 0,
  xtf_slant_range_at = 4,
  xtf_ground_range_at = 8,
  xtf_delay_at = 12,
  xtf_duration_at = 16,
  xtf_period_at = 20,
  xtf_flags_at = 24,
  xtf_trace_frequency_at = 26,
  xtf_samples_at = 42,
  xtf_weight_at = 58
};

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "formats/binary_input_internal.hpp"

// Private to formats: what readers of XTF have in common.
namespace insonify {

/// Numbers of channels that the header of a file describes, and its size.
struct XtfOutline {
  std::size_t sonars = 0, bathymetries = 0;
  std::size_t bytes = 0;  ///< 1024 bytes, and as many again while not all channels fit in
};

/// Reads the outline of a file. Throws Error(content) if the file is no XTF.
XtfOutline read_xtf_outline(BinaryInput& file, const std::string& path);

/// Calls `take` for each packet from this byte of the file on, with its bytes, which are at least those of its head,
/// and with words that name it in errors. Throws Error(content) for bytes that begin no packet, and at the end of a
/// file within one.
void each_xtf_packet(BinaryInput& file, const std::string& path, std::size_t begin,
                     const std::function<void(std::string_view packet, const std::string& where)>& take);

/// Returns the time of a packet with a header of a ping [s, UTC since 1970]; 0 if it has no date. Throws Error(content)
/// for a date that is none.
double xtf_time_of(std::string_view packet, const std::string& where);

/// Return a number of a packet; a float that is not finite is 0.
double xtf_real_at(std::string_view bytes, std::size_t at);
inline std::uint8_t xtf_byte_at(std::string_view bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

/// Returns a sound speed [m/s] as stored, whole or half of it; 0 if it is unknown.
double xtf_sound_speed_of(std::string_view packet);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "formats/swath_record.hpp"

namespace insonify {

/// Numbers of the arrays of GSF that readers of soundings use.
enum class GsfArrayId : std::uint8_t {
  depth = 1,
  across = 2,
  along = 3,
  travel_time = 4,
  beam_angle = 5,
  calibrated_amplitude = 6,
  relative_amplitude = 7,
  nominal_depth = 14,
  quality_flags = 15,
  beam_flags = 16,
  forward_angle = 18,
  vertical_error = 19,
  horizontal_error = 20,
  sonar_vertical_error = 27,
  sonar_horizontal_error = 28
};

/// A ping of a GSF file as it is stored: raw numbers divided by their scale, in the units of the format.
struct GsfRecordedPing {
  std::map<std::string, double> header{};  ///< fields by the names of docs/reference/gsf.md, in their units
  std::map<GsfArrayId, std::vector<double>>
      arrays{};    ///< numbers are those of the format, also others than GsfArrayId names
  int sensor = 0;  ///< number of the sonar's subrecord; 0: none

  /// Returns an array with an entry for each beam; null if the ping has none of this number.
  const std::vector<double>* array(GsfArrayId id) const;
  /// Returns the number of beams.
  std::size_t beams() const { return static_cast<std::size_t>(header.at("NUM_BEAMS")); }
};

/// A GSF file: swaths, profiles, attitudes, and numbers of all records.
struct GsfRecord {
  std::string version;  ///< "3.06"
  std::vector<GsfRecordedPing> pings{};
  std::vector<RecordedProfile> profiles{};
  std::vector<RecordedAttitude> attitudes{};
  std::vector<std::string> comments{};
  std::map<std::string, std::size_t> records{};  ///< numbers of records by their kind, those that are skipped too
};

/// Reads a file in the Generic Sensor Format, versions 2 and 3 (Leidos 2024): swaths with all arrays of one number for
/// each beam, profiles, attitudes and comments. Records and subrecords of other kinds are skipped. An array is (raw /
/// multiplier) - offset, of 1, 2 or 4 bytes for each beam. Throws Error(file) if the file cannot be read,
/// Error(content) if it is no GSF, is truncated or damaged, or holds compressed arrays or no swath.
GsfRecord read_gsf(const std::string& path);

/// Returns the swaths of a GSF file. A beam has a sounding unless depth, across and along are all 0; it is rejected if
/// the lowest bit of its flags is set. Errors at 95 % become standard deviations (divided by 1.96); 0 is not stated.
SwathRecord swath_of(const GsfRecord& record);

}  // namespace insonify

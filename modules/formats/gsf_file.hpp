#pragma once
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "acoustics/sound_speed_profile.hpp"
#include "core/geodesy.hpp"
#include "core/pending_file.hpp"

namespace insonify {

/// A sounding of a swath, in axes of the vessel at its head.
struct GsfBeam {
  bool detected = false;   ///< else the beam is flagged as unusable, and all others are 0
  double depth = 0;        ///< below the waterline [m], positive down, from -10 km on
  double across = 0;       ///< [m], positive to starboard
  double along = 0;        ///< [m], positive ahead
  double travel_time = 0;  ///< there and back [s]
  double angle = 0;        ///< of the beam from straight down [rad], >= 0
  double azimuth = 0;      ///< of the beam, counter-clockwise from starboard [rad]: port is pi
  double level_db = 0;     ///< dB re 1 uPa
  double quality = 0;      ///< log10(range / its standard deviation)
  double vertical_deviation = 0, horizontal_deviation = 0;  ///< standard deviations [m]
};

/// One ping of a swath, beams from port to starboard: an entry for each sounding, of which a beam may have several, and
/// one for each beam without any.
struct GsfPing {
  double time = 0;                          ///< UTC, seconds since 1970
  GeoPlace place{};                         ///< of the head
  double heading = 0, roll = 0, pitch = 0;  ///< [rad]: clockwise from north, starboard down, bow up
  double course = 0, speed = 0;             ///< over ground [rad, m/s]
  double heave = 0;                         ///< [m], up
  std::uint16_t number = 0;
  double surface_sound_speed = 0;                      ///< [m/s]
  double range = 0;                                    ///< of the gate [m]
  double beam_width_along = 0, beam_width_across = 0;  ///< [rad]
  std::vector<GsfBeam> beams{};
};

/// Writes bathymetry in the Generic Sensor Format 3.11 (Leidos 2024): header, processing parameters, sound-speed
/// profile, then pings with the subrecord of a SeaBat 2 (id 114), one after the other. Depth (with an
/// offset of 10 km, so that heights are negative depths), across and along to 0.1 mm, times to 10 ns, angles to 0.01 degrees, positions to 1e-7 degrees; errors as 95 % (1.96 deviations).
/// The same pings give the same bytes.
class GsfFile {
 public:
  /// Throws Error(file) if the file cannot be made. `reference_time` is that of the profile [s since 1970].
  GsfFile(const std::string& path, const SoundSpeedProfile& profile, const GeoPlace& place, double reference_time,
          const std::vector<std::string>& parameters);
  /// Throws Error(content) for a ping without beams or of more bytes than a record may have (2^19), with a number that its field cannot hold, or a
  /// time before 1970 or after 2106; the message names the ping and the quantity.
  void add(const GsfPing& ping);
  /// Throws Error(file) if not all could be written.
  void finish();

 private:
  void record(std::uint32_t id, std::string data);

  PendingFile pending_;
  std::ofstream out_;
  bool scaled_ = false;  ///< whether a ping has had the scale factors
};

}  // namespace insonify

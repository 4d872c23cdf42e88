// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "acoustics/sound_speed_profile.hpp"
#include "returns/ping.hpp"
#include "sonar/pulse.hpp"

namespace insonify {

/// The method that found the range of a sounding: from the centre of gravity of its echo, or from the zero of the phase
/// between the halves of the array.
enum class BottomMethod : std::uint8_t { amplitude = 1, phase = 2 };

/// Why a sounding is rejected, as bits of BottomSoundings::reject.
enum RejectReason : std::uint8_t {
  reject_side_lobe = 1,     ///< it may be a side lobe of an echo that other beams receive at its range
  reject_skirt = 2,         ///< it is the skirt of the main lobe of a louder neighbouring beam
  reject_faint = 4,         ///< its level is far below that of the bottom around it
  reject_lone = 8,          ///< no neighbour confirms it, and it is above neither side lobes nor noise
  reject_grating_lobe = 16  ///< its frequencies differ from the pulse's: a grating lobe received it from beyond the fan
};

/// Soundings of the bottom as a structure of arrays, by beams and, in a beam, by falling energy.
struct BottomSoundings {
  std::vector<Eigen::Vector3d> position;  ///< world [m]: along the beam's axis, bent by the profile
  std::vector<double> range;              ///< c t / 2 with the sound speed at the head [m]
  std::vector<float> deviation;           ///< predicted standard deviation of range [m]
  std::vector<float> quality;             ///< log10(range / deviation)
  std::vector<float> level_db;            ///< level of the echo's strongest sample [dB re 1 uPa]
  std::vector<BottomMethod> method;
  std::vector<std::uint32_t> beam;
  std::vector<std::uint8_t> reject;  ///< 0: kept; else bits of RejectReason

  /// Returns the number of soundings.
  std::size_t size() const { return range.size(); }
};

/// Removes the soundings i for which keep[i] is 0.
void keep_soundings(BottomSoundings& soundings, const std::vector<char>& keep);

/// Options of detect_bottom.
struct BottomOptions {
  double sound_speed = 1500;       ///< sound speed at the head [m/s]
  double centre_frequency = 0;     ///< [Hz], with phase
  double range_resolution = 0;     ///< intensity width of the pulse [m]; 0: a bin
  double absorption_db_per_m = 0;  ///< absorption, compensated before centres of gravity
  double false_alarm_rate = 1e-3;  ///< probability that noise alone gives a sounding in a beam, within 0 and 1
  /// Least level of the receiver's noise in a beam [dB re 1 uPa], e.g. thermal_floor_db. It counts in beams whose
  /// samples hold less than a quarter of it, e.g. where noise is not simulated.
  double noise_floor_db = -std::numeric_limits<double>::infinity();
  double tolerance = 0;             ///< error of the synthesis, relative L2: this fraction of a bin's mean is no echo
  double side_lobe_margin_db = 25;  ///< samples this far below the strongest beam near their range are side lobes (E19)
  int per_beam = 1;                 ///< largest number of soundings per beam
  double least_energy_db = -20;     ///< least energy of a further sounding relative to the first of its beam [dB]
  bool phase = true;                ///< use Ping::split_phase if there is one
  std::optional<SoundSpeedProfile> profile{};  ///< bends the rays to the soundings; absent: straight rays
  double head_depth = 0;                       ///< depth of the head in the profile [m]
  int threads = 0;                             ///< 0: all cores; the result does not depend on it
};

/// Returns the level of the water's thermal noise (E18) in a beam of the fan [dB re 1 uPa]. The elements are half a
/// wavelength apart along a line whose -3 dB width is the beam's: 10 log10(2 * 0.886 / width) below
/// thermal_noise_level_db(pulse), and for the rows of a planar array that of their width. Within 2 dB for the presets
/// of several beams. Throws Error for an invalid pulse.
double thermal_floor_db(const Pulse& pulse, const BeamFan& fan);

/// Returns the soundings of a ping as a bathymetric echo sounder finds them. The function uses the ping alone, neither
/// scene nor echoes.
///
///   1. The noise of each beam follows from the smallest quarter of its intensities, or from the floor. The echo is
///   where the range-compensated energy over the length of a beam's footprint is greatest. It must contain a sample
///   that noise exceeds in only one of 1 / rate beams (E78). Samples that may be side lobes of an echo up to half an
///   array's length nearer or farther are left out (E19). An echo from a grating lobe gives way to the next (E133).
///   2. dr/du of the bottom is the median of the slopes between the ranges of seven neighbouring beams.
///   3. Amplitude: the centre of gravity of the intensity above noise within three standard deviations, with its error
///   (E94).
///   4. Phase: a line is fitted to the phase between the halves of the array within the main lobe. The line crosses
///   zero at the beam's axis; the residuals of the fit give its error. For an echo of few samples the slope follows
///   from dr/du and the other beams (E95).
///   5. The method with the smaller predicted error gives the sounding.
///
/// A beam without a sample above noise has no sounding. An echo that fills more than three quarters of the gate counts
/// as noise. The cost is a few passes over the ping. Throws Error for a rate outside (0, 1), per_beam < 1, an invalid
/// profile, a phase without centre frequency or with another size than the ping, or a ping that holds an expected
/// level.
BottomSoundings detect_bottom(const Ping& ping, const BottomOptions& options);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "acoustics/sound_speed_profile.hpp"
#include "returns/ping.hpp"

namespace insonify {

/// How a sounding was found: by the centre of gravity of its echo, or where the phase between the halves of the array
/// crosses zero.
enum class BottomMethod : std::uint8_t { amplitude = 1, phase = 2 };

/// Why a sounding is rejected, as bits of BottomSoundings::reject.
enum RejectReason : std::uint8_t {
  reject_side_lobe = 1,     ///< side lobes of what other beams hear at its range may explain it
  reject_skirt = 2,         ///< the main lobe of a louder beam beside it explains it
  reject_faint = 4,         ///< far below the bottom about it
  reject_lone = 8,          ///< no sounding beside it confirms it, and it stands out of neither side lobes nor noise
  reject_grating_lobe = 16  ///< of frequencies beside the pulse's: a grating lobe brings it in from beyond the fan
};

/// Soundings of the bottom as a structure of arrays, by beams and, in a beam, by falling energy.
struct BottomSoundings {
  std::vector<Eigen::Vector3d> position;  ///< world [m]: along the beam's axis, bent by the profile
  std::vector<double> range;              ///< c t / 2 with the sound speed at the head [m]
  std::vector<float> deviation;           ///< predicted standard deviation of range [m]
  std::vector<float> quality;             ///< log10(range / deviation)
  std::vector<float> level_db;            ///< of the strongest sample of the echo [dB re 1 uPa]
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
  double sound_speed = 1500;        ///< at the head [m/s]
  double centre_frequency = 0;      ///< [Hz], with phase
  double range_resolution = 0;      ///< intensity width of the pulse [m]; 0: a bin
  double absorption_db_per_m = 0;   ///< compensated before centres of gravity are taken
  double false_alarm_rate = 1e-3;   ///< probability that noise alone gives a sounding in a beam, within 0 and 1
  double side_lobe_margin_db = 25;  ///< samples so far below the strongest beam about their range are side lobes (E19)
  int per_beam = 1;                 ///< so many soundings at most
  double least_energy_db = -20;     ///< of a further sounding, against the first one of its beam
  bool phase = true;                ///< use Ping::split_phase if there is one
  std::optional<SoundSpeedProfile> profile{};  ///< bends the rays to the soundings; absent: straight rays
  double head_depth = 0;                       ///< [m], of the head in the profile
  int threads = 0;                             ///< 0: all cores; the result does not depend on it
};

/// Returns the soundings of a ping as a bathymetric echo sounder finds them, from the ping alone: neither scene nor
/// echoes are known to it.
///
///   1. noise of each beam from the smallest quarter of its intensities; the echo is where range-compensated energy within
///      the length of a beam's footprint is greatest, and holds a sample that noise exceeds in one of 1 / rate beams
///      (E78);
///      samples that side lobes of an echo up to half an array's length nearer or farther may explain are left out
///      (E19),
///      and what a grating lobe brings in gives way to the next echo (E133)
///   2. dr/du of the bottom: median of the slopes between the ranges of seven neighbouring beams
///   3. amplitude: centre of gravity of the intensity above noise within three standard deviations, with the error (E94)
///   4. phase: line fitted to the phase between the halves of the array within the main lobe, which crosses zero at the
///      beam's axis, with the error of the fit's own residuals; of an echo of few samples with the slope that dr/du and
///      the
///      other beams give it (E95)
///   5. the method with the smaller predicted error
///
/// Beams without a sample above noise have none; an echo that fills more than three quarters of the gate counts as
/// noise. Cost: some reads of the ping. Throws Error for a rate outside (0, 1), per_beam < 1, an invalid profile, a
/// phase without centre frequency or of another extent, or an expected level.
BottomSoundings detect_bottom(const Ping& ping, const BottomOptions& options);

}  // namespace insonify

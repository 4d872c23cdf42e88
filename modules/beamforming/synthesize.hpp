// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/echo_stream.hpp"
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Method of synthesis. `incoherent` gives the expected level without speckle (synthesize_intensity). All other methods
/// give the complex pressure.
enum class SynthesisMethod { gridded, direct, spectrum, element_exact, true_delays, incoherent };

/// Options of all synthesizers.
struct SynthesisOptions {
  double tolerance = 1e-4;  ///< relative L2 error of the image; pulses are cut below half this fraction of their peak
  int threads = 0;          ///< 0: all cores; the result does not depend on it

  bool operator==(const SynthesisOptions&) const = default;
};

/// Returns the complex baseband pressure per beam and range bin, beams x bins [Pa]: of a line or planar array; direct,
/// element_exact and incoherent also of a curved one (E205), whose echoes have v. Beams of one elevation form a row.
/// `method` synthesizes each row from echoes that are weighted by the row's response to their elevation:
///
///   one row, no column     1, because direct_echoes has applied the elevation pattern
///   a column (E56)         its response B_z(v - v_b), v_b = sin(elevation_b), so that a beam of the planar array is
///                          B(u, v) = B_y(u - u_b) B_z(v - v_b), u_b = cos(elevation_b) sin(azimuth_b)
///   several rows, no column    the elevation pattern (E14) about the row's own elevation
///
/// `gridded` grids a planar array with Gaussian pulses in time, u and v at once (E13).
///
/// See with_patterns for the patterns that direct_echoes must have applied.
///
/// All methods but `direct` omit an echo from a row if the row's response is below tolerance / (10 sqrt(rows)) of the
/// response of the row nearest to the echo. Over all rows this costs at most a tenth of the tolerance (relative L2
/// norm).
///
///   element_exact   makes no narrow-band far-field assumption: true delays per element, focused beams (element_series,
///                   beam_from_elements, E61, E62); tolerance within [1e-12, 0.1]
///   true_delays     gives the same image at about the cost of gridding (TrueDelayEngine, E68); tolerance within
///                   [1e-5, 0.1]
///   incoherent      gives the root of the expected intensity (E65) as a real pressure. Levels and detections apply to
///                   it; its phases have no meaning, and such images add by their squares.
///
/// The cost is that of the method for each row. The result does not depend on options.threads. Throws Error as the
/// methods do, and for a head with several rows or a column unless echoes.v has one entry per echo. Use a Synthesizer
/// for many images of one head.
ComplexGrid synthesize(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options = {});

/// Returns the same for echoes that `stream` makes chunk by chunk. If head and method are not `streamed`, the call
/// makes and stores all echoes first.
ComplexGrid synthesize(const EchoStream& stream, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options = {});
/// Returns whether `method` forms the pressure of `head` without storing all echoes. `gridded` and `true_delays` do so
/// for one row of beams, and `gridded` also for a planar array with Gaussian pulses.
bool streamed(const SonarHead& head, SynthesisMethod method);

// Synthesizers for heads with one row of beams and no column; they throw Error for others.

/// Returns the complex baseband pressure per beam and range bin, beams x bins [Pa] (E12):
///
///   P(b, n) = sum_i A_i B_b(u_i) G_i(2 r_n / c - delay_i)
///
/// as a plain sum over echoes in double with uncut pulses: the reference for all other methods. G_i is the envelope of
/// the echo with its absorption and, if echoes.doppler is given, its Doppler shift (E8, E54). Cost: echoes x beams x
/// (elements + bins). Throws Error for an invalid head or medium, or a NaN in an echo.
ComplexGrid synthesize_direct(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                              const SynthesisOptions& options = {});

/// Returns the same by gridding (E13, E60), with a relative L2 error below `tolerance`, within [1e-13, 1): a
/// GriddedEngine constructed for one image. No wrap-around in range; bits do not depend on the number of threads.
ComplexGrid synthesize_gridded(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options = {});

/// Returns the same by the method of the thesis (E12 in the frequency domain, its eq. 21 and 27 corrected): the
/// spectrum of each beam is summed over echoes, frequency by frequency, and one FFT (FFTW, double) gives the series.
/// The method shares no code with the closed form of the pulse and serves as a cross-check. The window extends beyond
/// the last echo by the length of the pulse. Sweeps are sampled at 64 times their bandwidth and transformed by FFT,
/// accurate to 3e-3 / (B T) of the peak. Absorption filters the spectrum of a sweep and is constant beyond its band
/// (E54 states the difference). The method needs memory for beams x frequencies. Throws Error as synthesize_direct
/// does.
ComplexGrid synthesize_spectrum(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const SynthesisOptions& options = {});

}  // namespace insonify

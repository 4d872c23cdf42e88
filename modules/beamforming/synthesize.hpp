#pragma once
#include "acoustics/echoes.hpp"
#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

/// Which of the synthesizers below forms the beams.
/// `incoherent` gives the expected level instead, without speckle (synthesize_intensity).
enum class SynthesisMethod { gridded, direct, spectrum, element_exact, true_delays, incoherent };

struct SynthesisOptions {
  double tolerance = 1e-4;  ///< of the image; a pulse is cut where its envelope falls below half this part of its peak
  int threads = 0;          ///< 0: all cores; the result does not depend on it
};

/// Complex baseband pressure per beam and range bin, beams x bins [Pa], of any head. Beams of one elevation are a row,
/// and each row is synthesized by `method` from echoes weighted by what the row makes of their elevation:
///
///   one row, no column     not at all: direct_echoes applied the elevation pattern
///   a column (E56)         its response B_z(v - v_b), v_b = sin(elevation_b), so that a beam of the planar array is
///                          B(u, v) = B_y(u - u_b) B_z(v - v_b), u_b = cos(elevation_b) sin(azimuth_b)
///   several rows, no column    the elevation pattern (E14) about the row's own elevation
///
/// See with_patterns for what direct_echoes must have applied. All but `direct` leave an echo out of a row
/// whose response to it is below tolerance / (10 sqrt(rows)) of that of the row nearest to it: over all rows it loses at
/// most a tenth of the tolerance (relative L2 norm) of what a row hears of it; `direct` leaves none out.
/// `element_exact` leaves the narrow-band far field: true delays per element, focused beams (element_series,
/// beam_from_elements, E61, E62); its tolerance is within [1e-12, 0.1].
/// `true_delays` gives the same at about the cost of gridding (WidebandSynthesizer, E67); its tolerance is within
/// [1e-5, 0.1].
/// `incoherent` gives the root of the expected intensity (E65) as a real pressure: levels and detections read it as any
/// other, but such images add up by their squares, and phases mean nothing.
/// Cost: that of the method for every row. The result does not depend on options.threads.
/// Throws Error as the methods do, and if there are several rows or a column, but not one echoes.v per echo.
ComplexGrid synthesize(const Echoes& echoes, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                       const SynthesisOptions& options = {});

// The synthesizers of heads with one row of beams and no column; they throw Error for others.

/// Complex baseband pressure per beam and range bin, beams x bins [Pa] (E12):
///
///   P(b, n) = sum_i A_i B_b(u_i) G_i(2 r_n / c - delay_i)
///
/// as a plain double sum over echoes with the whole pulse, never cut: the referee of every other method. G_i is the
/// echo's envelope with its loss and, where echoes.doppler is given, its Doppler shift (E8, E54).
/// Cost: echoes x beams x (elements + bins). Throws Error for an invalid head or medium, or a NaN in an echo.
ComplexGrid synthesize_direct(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                              const SynthesisOptions& options = {});

/// The same by gridding (E13, E60), to a relative L2 error below `tolerance`, within [1e-13, 1): a PingSynthesizer made for
/// this one image. No wrap-around in range; bits do not depend on the thread count.
ComplexGrid synthesize_gridded(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options = {});

/// The thesis' way (E12 in the frequency domain, its eq. 21 and 27 corrected): the spectrum of each beam, summed
/// over echoes frequency by frequency, then one FFT (FFTW, double). Kept as a cross-check that shares no code with
/// the pulse's closed form; needs a window longer than the last echo, which it guards by the pulse's length. Sweeps
/// are sampled at 64 times their bandwidth and turned by FFT: good to 3e-3 / (B T) of the peak, and absorption is a
/// filter on their spectrum, constant beyond the band (E54 states what that differs). These, and echoes with Doppler
/// shifts, hold beams x frequencies in memory.
ComplexGrid synthesize_spectrum(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const SynthesisOptions& options = {});

}  // namespace insonify

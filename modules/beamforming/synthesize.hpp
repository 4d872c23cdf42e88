#pragma once
#include "acoustics/echoes.hpp"
#include "acoustics/water.hpp"
#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

struct SynthesisOptions {
  double tolerance = 1e-4;  ///< of the image; a pulse is cut where its envelope falls below half this part of its peak
  int threads = 0;          ///< 0: all cores; the result does not depend on it
};

/// Complex baseband pressure per beam and range bin, beams x bins [Pa] (E12):
///
///   P(b, n) = sum_i A_i B_b(u_i) G_i(2 r_n / c - delay_i)
///
/// as a plain double sum over echoes with the whole pulse, never cut: the referee of every other method.
/// Cost: echoes x beams x (elements + bins). Throws Error for an invalid head or medium, or a NaN in an echo.
ComplexGrid synthesize_direct(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                              const SynthesisOptions& options = {});

/// The same by stamping (E13): each echo adds its pulse, cut at `tolerance`, to the time series of every element;
/// beams are sums over elements. Time is cut into tiles; each tile is filled in one order by one thread, so bits do
/// not depend on the thread count. Relative L2 error below `tolerance`. No wrap-around in range.
/// Cost: echoes x elements x pulse samples + beams x elements x bins.
ComplexGrid synthesize_stamped(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                               const SynthesisOptions& options = {});

/// The thesis' way (E12 in the frequency domain, its eq. 21 and 27 corrected): the spectrum of each beam, summed
/// over echoes frequency by frequency, then one FFT (FFTW, double). Kept as a cross-check that shares no code with
/// the pulse's closed form; needs a window longer than the last echo, which it guards by the pulse's length.
ComplexGrid synthesize_spectrum(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const SynthesisOptions& options = {});

}  // namespace insonify

#pragma once
#include "acoustics/echo_stream.hpp"
#include "beamforming/synthesize.hpp"
#include "core/grid.hpp"
#include "sonar/sonar_head.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// A line array read as two halves, whose beams see the same echo with a phase between them (E92).
struct SplitAperture {
  SonarHead head;            ///< with the array of one half about its own middle
  double half_baseline = 0;  ///< from the middle of the whole array to that of a half [m]
};

/// Splits the array of `head` into a port and a starboard half; of an odd number of elements the middle one belongs to
/// neither. Each half has the shading of the whole, resampled to its length. Throws Error(argument) naming `who` for a
/// planar array, several rows of beams, or fewer than eight elements.
SplitAperture split_aperture(const SonarHead& head, const char* who);

/// Half of a split aperture.
enum class ApertureSide { port, starboard };

/// Returns the image of one half, beams x bins [Pa], as synthesize_gridded of an array at its own place: echoes arrive with
/// the phase exp(-+i k b u), as their delays give it (E61), and beams are steered with exp(+-i k b u_b), b the half
/// baseline, above for port (E92). Narrow band, far field.
ComplexGrid half_pressure(const EchoStream& stream, const SplitAperture& split, ApertureSide side, const Medium& medium,
                          const SynthesisOptions& options);
/// The same of stored echoes.
ComplexGrid half_pressure(const Echoes& echoes, const SplitAperture& split, ApertureSide side, const Medium& medium,
                          const SynthesisOptions& options);

/// Returns `head` with the elements of the other half silent: synthesize_noise gives the noise of this half, of the same
/// elements as that of the whole array.
SonarHead with_one_half(const SonarHead& head, const SplitAperture& split, ApertureSide side);

/// Phase between the halves [rad], beams x bins: arg(starboard conj(port)) = 2 k b (u - u_b) of an echo from u, b the half
/// baseline, positive towards port; 0 where there is nothing (E92).
Grid<float> phase_between(const ComplexGrid& port, const ComplexGrid& starboard);

}  // namespace insonify

#pragma once
#include <complex>
#include <cstdint>

#include "acoustics/direct_echoes.hpp"

namespace insonify {

/// Amplitude xi of a patch: bound to its id and the seed, the same on every path to the patch.
std::complex<double> surface_amplitude(const EchoOptions& options, double coherent_fraction, std::uint64_t id);

}  // namespace insonify

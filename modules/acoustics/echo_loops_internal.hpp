// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Multiplies gains by Gaussian lobes 2^(-2 (off / width)^2) of angles off an axis, whole turns apart alike (E14, E57).
void apply_lobe(const double* angle, std::size_t count, double axis, double width, double* gain);

/// Arrays into which echoes are written; amplitudes are real and imaginary parts interleaved.
struct EchoPositions {
  double *delay, *u, *v, *amplitude;
};

/// Direct echoes of patches at range, azimuth and elevation (E7): delay 2 r / c, direction cosines, and amplitude xi
/// gain / r^2 with the phase of `cycles_per_m` r.
struct EchoPatches {
  const double *range, *azimuth, *elevation, *gain, *xi_re, *xi_im;
};
void direct_echoes(const EchoPatches& patches, std::size_t count, double cycles_per_m, double sound_speed,
                   EchoPositions echoes);

/// A head in motion, in its own axes at transmission.
struct MovingHead {
  double velocity[3], axis[3];  ///< [m/s]; unit vector of its turn, or 0
  double turns_per_s, sound_speed, centre_frequency;
};
/// Turns echoes of patches at range, azimuth and elevation into those of a moving head (E44); sets their Doppler
/// shifts.
void move_echoes(const double* range, const double* azimuth, const double* elevation, std::size_t count,
                 const MovingHead& head, EchoPositions echoes, double* doppler);

}  // namespace insonify::kernels

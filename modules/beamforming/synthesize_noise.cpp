// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "beamforming/numerics/receive_filter_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sonar/element_kernels_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t rows_at_once = 128;  // rows of beams per pass, which bounds the memory for element series
constexpr std::size_t tile_bins = 64;

/// The time series of all elements over one tile of bins: tile_bins x elements, real and imaginary parts [Pa].
struct ElementTile {
  Grid<double> re, im;

  explicit ElementTile(std::size_t elements)
      : re(Grid<double>::Zero(tile_bins, elements)), im(Grid<double>::Zero(tile_bins, elements)) {}
};

/// Shading and steering phasors of all beams and elements, to form beams from tiles of element series.
class BeamSums {
 public:
  BeamSums(const SonarHead& head, double wavelength) {
    const std::vector<Eigen::Vector3d> axes = beam_axes(head.fan);
    const auto array = receive_array(head);
    const std::size_t n = head.array.elements();
    re_.resize(axes.size(), n);
    im_.resize(axes.size(), n);
    for (std::size_t b = 0; b < axes.size(); ++b)
      for (std::size_t m = 0; m < n; ++m) {
        const double phase = -array->steering_phase(m, axes[b], wavelength);
        const double w = head.array.shading[m] / static_cast<double>(n);
        re_(b, m) = w * std::cos(phase);
        im_(b, m) = w * std::sin(phase);
      }
  }

  /// Computes pressure(b, n) for some beams, those of one row, and the bins [first, last) of one tile: the sum over
  /// elements (E10).
  void form_beams(const ElementTile& series, std::size_t first, std::size_t last, std::span<const std::size_t> beams,
                  ComplexGrid& pressure) const {
    // Transpose to one row per element, so the sums run along time.
    const Grid<double> re = series.re.transpose(), im = series.im.transpose();
    double beam_re[tile_bins], beam_im[tile_bins];
    for (const std::size_t b : beams) {
      kernels::sum_elements(re_.row(b).data(), im_.row(b).data(), re_.cols(), re.data(), im.data(), tile_bins,
                            last - first, beam_re, beam_im);
      for (std::size_t n = first; n < last; ++n) pressure(b, n) = {beam_re[n - first], beam_im[n - first]};
    }
  }

 private:
  Grid<double> re_, im_;  // beams x elements
};

/// White noise of unit power per element, as received by the line array of each row of beams.
///
/// Without a column each row has elements of its own. With a column, the noise of element m of a row is formed from
/// that of the column's elements k, steered to the row:
///
///   y(row, m) = (1 / Nz) sum_k w_k exp(-2 pi i (d/lambda) (k - (Nz-1)/2) sin(elevation_row)) xi(m, k)
///
/// so the noise of rows is correlated as far as the column's beams overlap (E56). xi is counted by (ping, k columns +
/// m, bin), which for one row without column is the counting of a line array.
class RowNoise {
 public:
  RowNoise(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, const NoiseOptions& options)
      : columns_(head.array.elements()), options_(options) {
    if (!head.column) return;
    const std::size_t elements = head.column->elements();
    column_.resize(rows.size(), elements);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t k = 0; k < elements; ++k) {
        const double step = -2 * pi * head.column->spacing / wavelength * std::sin(rows[r].elevation);
        column_(r, k) = std::polar(1.0, step * element_position(k, elements)) * head.column->shading[k] /
                        static_cast<double>(elements);
      }
  }

  /// Returns the noise of element m for rows [first, last), rows x bins, on bins [begin, begin + bins).
  ComplexGrid white(std::size_t m, std::size_t first, std::size_t last, std::uint64_t begin, std::size_t bins) const {
    // Independent elements: those of the rows themselves, or those of the column.
    const std::size_t first_layer = column_.size() ? 0 : first;
    const std::size_t layers = column_.size() ? static_cast<std::size_t>(column_.cols()) : last - first;
    ComplexGrid xi(layers, bins);
    std::vector<double> re(bins), im(bins);
    for (std::size_t k = 0; k < layers; ++k) {
      random_complex_normals(options_.seed, RandomStage::noise,
                             {static_cast<std::uint64_t>(options_.ping), (first_layer + k) * columns_ + m, begin}, bins,
                             re.data(), im.data());
      for (std::size_t n = 0; n < bins; ++n) xi(k, n) = {re[n], im[n]};
    }
    if (!column_.size()) return xi;
    return column_.middleRows(first, last - first).matrix() * xi.matrix();  // (E56)
  }

 private:
  ComplexGrid column_;  // rows x elements of the column; empty without a column
  std::size_t columns_;
  NoiseOptions options_;
};

}  // namespace

ComplexGrid synthesize_noise(const SonarHead& head, const Medium& medium, double element_level_db,
                             const NoiseOptions& options) {
  require_valid(head, "synthesize_noise");
  require_valid(medium, "synthesize_noise");
  if (!std::isfinite(element_level_db))
    fail(ErrorKind::argument, "synthesize_noise: element_level_db = ", element_level_db, " dB, must be finite");
  const ReceiveFilter filter(head.pulse, 2 * head.gate.bin_size / medium.sound_speed);
  const double scale = std::numbers::sqrt2 * micropascal * amplitude_from_db(element_level_db);
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const BeamSums beams(head, wavelength);
  const std::vector<FanRow> rows = fan_rows(head.fan);
  const RowNoise noise(head, wavelength, rows, options);
  const std::size_t bins = head.gate.bins(), elements = head.array.elements();
  ComplexGrid pressure(head.fan.beams(), bins);

  parallel_for((bins + tile_bins - 1) / tile_bins, options.threads, [&](std::size_t tile) {
    const std::size_t first = tile * tile_bins, last = std::min(first + tile_bins, bins);
    for (std::size_t row = 0; row < rows.size(); row += rows_at_once) {
      const std::size_t end_row = std::min(row + rows_at_once, rows.size());
      std::vector<ElementTile> series(end_row - row, ElementTile(elements));
      for (std::size_t m = 0; m < elements; ++m) {
        // White noise on this tile and the filter length around it, then the filter.
        const ComplexGrid white = noise.white(m, row, end_row, first, last - first + filter.size() - 1);
        for (std::size_t r = 0; r < series.size(); ++r) {
          for (std::size_t n = 0; n < last - first; ++n) {
            const std::complex<double> x = filter.of(&white(r, n));  // (E41)
            series[r].re(n, m) = scale * x.real();
            series[r].im(n, m) = scale * x.imag();
          }
        }
      }
      for (std::size_t r = 0; r < series.size(); ++r)
        beams.form_beams(series[r], first, last, rows[row + r].beams, pressure);
    }
  });
  return pressure;
}

}  // namespace insonify

#include <cmath>
#include <complex>

#include "beamforming/row_noise_internal.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {

RowNoise::RowNoise(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows,
                   const NoiseOptions& options)
    : columns_(head.array.elements()), options_(options) {
  if (!head.column) return;
  const std::size_t elements = head.column->elements();
  column_.resize(rows.size(), elements);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t k = 0; k < elements; ++k) {
      const double step = -2 * pi * head.column->spacing / wavelength * std::sin(rows[r].elevation);
      column_(r, k) =
          std::polar(1.0, step * element_place(k, elements)) * head.column->shading[k] / static_cast<double>(elements);
    }
}

ComplexGrid RowNoise::white(std::size_t m, std::size_t first, std::size_t last, std::uint64_t begin,
                            std::size_t bins) const {
  // Independent elements: those of the rows themselves, or those of the column.
  const std::size_t first_layer = column_.size() ? 0 : first;
  const std::size_t layers = column_.size() ? static_cast<std::size_t>(column_.cols()) : last - first;
  ComplexGrid xi(layers, bins);
  for (std::size_t k = 0; k < layers; ++k)
    for (std::size_t n = 0; n < bins; ++n)
      xi(k, n) = random_complex_normal(
          options_.seed, RandomStage::noise,
          {static_cast<std::uint64_t>(options_.ping), (first_layer + k) * columns_ + m, begin + n});
  if (!column_.size()) return xi;
  return column_.middleRows(first, last - first).matrix() * xi.matrix();  // (E56)
}

}  // namespace insonify

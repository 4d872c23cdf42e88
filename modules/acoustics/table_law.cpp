// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "acoustics/surface_laws.hpp"
#include "acoustics/tabulated_surface_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Where a number stands between ascending ones: index of the left one, and how far beyond it; held at the ends.
std::pair<std::size_t, double> position_in(const std::vector<double>& ascending, double x) {
  if (x <= ascending.front() || ascending.size() == 1) return {0, 0};
  if (x >= ascending.back()) return {ascending.size() - 2, 1};
  const auto right = std::upper_bound(ascending.begin(), ascending.end(), x);
  return {static_cast<std::size_t>(right - ascending.begin()) - 1, (x - right[-1]) / (right[0] - right[-1])};
}

/// Cross-section per area over cos^2 of incidence, the coefficient of a Lambert surface that is as strong there.
class StrengthTable {
 public:
  StrengthTable(const TableLaw& law, double frequency) : incidence_(law.incidence), level_(law.incidence.size()) {
    std::vector<double> logs;
    for (const double f : law.frequency) logs.push_back(std::log(f));
    const auto [row, share] = logs.empty() ? std::pair<std::size_t, double>{} : position_in(logs, std::log(frequency));
    const std::size_t n = incidence_.size(), next = logs.size() > 1 ? n : 0;
    for (std::size_t i = 0; i < n; ++i)
      level_[i] = (1 - share) * law.sigma_db[row * n + i] + share * law.sigma_db[row * n + next + i] -
                  20 * std::log10(std::cos(incidence_[i]));
  }
  double operator()(double cosine) const {
    const auto [i, share] = position_in(incidence_, std::acos(std::min(1.0, cosine)));
    return power_from_db((1 - share) * level_[i] + share * level_[i + 1]);
  }

 private:
  std::vector<double> incidence_, level_;
};

class TableSurface final : public SurfaceScattering {
 public:
  TableSurface(const TableLaw& law, double frequency)
      : mu_(StrengthTable(law, frequency)), half_vector_(law.half_vector) {}
  double cross_section(const PathAngles& path) const override {
    const double ci = path.cos_in, co = path.cos_out;
    if (!(ci > 0 && co > 0)) return 0;
    if (!half_vector_) return ci * co * std::sqrt(mu_(ci) * mu_(co));  // (E144)
    const double cos_t = half_vector(path).cos_t;
    return cos_t * cos_t * mu_(cos_t);
  }
  double back(double cosine) const override { return cosine * mu_(cosine); }

 private:
  CosineTable mu_;
  bool half_vector_;
};

}  // namespace

std::shared_ptr<const SurfaceScattering> surface_of(const TableLaw& law, double frequency, double sound_speed) {
  require_valid(SurfaceLaw(law), frequency, sound_speed, "surface_of");
  return std::make_shared<const TableSurface>(law, frequency);
}

}  // namespace insonify

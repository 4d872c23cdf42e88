#include "returns/coverage.hpp"

#include <algorithm>
#include <utility>

namespace insonify {

std::vector<CoveredSurfel> coverage_of(const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
                                       const Medium& medium, const InsonificationOptions& options) {
  std::vector<CoveredSurfel> covered;
  for (const InsonifiedSurfel& s : insonified_surfels(scene, scatterers, head, medium, options))
    covered.push_back({scene.id[s.surfel], 1, scene.origin + scene.point[s.surfel].cast<double>(), s.grazing_angle,
                       s.range, s.intensity});
  std::sort(covered.begin(), covered.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return covered;
}

void add(CoveredSurfel& to, const CoveredSurfel& more) {
  // (E97)
  to.pings += more.pings;
  to.grazing_angle = std::max(to.grazing_angle, more.grazing_angle);
  to.range = std::min(to.range, more.range);
  to.intensity += more.intensity;
}

void add(std::vector<CoveredSurfel>& to, const std::vector<CoveredSurfel>& more) {
  std::vector<CoveredSurfel> sum;
  sum.reserve(to.size() + more.size());
  auto a = to.begin();
  for (const CoveredSurfel& b : more) {
    for (; a != to.end() && a->id < b.id; ++a) sum.push_back(*a);
    if (a != to.end() && a->id == b.id)
      add(sum.emplace_back(*a++), b);
    else
      sum.push_back(b);
  }
  sum.insert(sum.end(), a, to.end());
  to = std::move(sum);
}

}  // namespace insonify

#pragma once
#include <memory>

#include "acoustics/echoes.hpp"
#include "beamforming/sonar_head.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

class WidebandSynthesizer {
 public:
  WidebandSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options = {});
  ~WidebandSynthesizer();
  WidebandSynthesizer(WidebandSynthesizer&&) noexcept;
  WidebandSynthesizer& operator=(WidebandSynthesizer&&) noexcept;

  /// beams x bins [Pa].
  ComplexGrid pressure(const Echoes& echoes) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace insonify

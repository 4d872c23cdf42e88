#pragma once
#include <string>
#include <vector>

#include "simulate/simulate_ping.hpp"

namespace insonify {

/// Forms beams of one kind of echo after another and adds them up; for SynthesisMethod::incoherent, by their squares.
class LayerSum {
 public:
  LayerSum(const SonarHead& head, const Medium& medium, const SimulationOptions& options);

  /// Synthesizes `echoes` and adds them; kept as a layer called `name` if the options ask for it.
  void add(const std::string& name, const Echoes& echoes);
  /// Adds what the elements hear without any echo; for SynthesisMethod::incoherent, its expected intensity.
  void add_noise(const Environment& environment);

  /// Gives `result` its ping (the sum in single precision, with its layers), its report of layers, and the sum of the
  /// element series of all echoes if the options ask for it. Afterwards there is nothing left to add to.
  void finish(const Pose& world_from_head, SimulatedPing& result);

 private:
  void add_pressure(const std::string& name, std::size_t echoes, const ComplexGrid& pressure);

  const SonarHead& head_;
  const Medium& medium_;
  const SimulationOptions& options_;
  bool incoherent_;
  ComplexGrid sum_;
  std::vector<Layer> layers_;
  std::vector<LayerReport> report_;
  ElementSeries elements_;
};

}  // namespace insonify

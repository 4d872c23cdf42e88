// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/split_aperture.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulated_ping.hpp"
#include "simulate/synthesizer_table_internal.hpp"

namespace insonify {

/// Returns the ping of an image, with its water and motion.
Ping ping_of(const ResolvedPing& ping, const RangeGate& gate, ComplexGridF image);

/// Forms beams of one kind of echo after another and adds them up; images of expected power, by their squares.
class LayerSum {
 public:
  /// Keeps references to both arguments, which must outlive it.
  LayerSum(const ResolvedPing& ping, SynthesizerTable& synthesizers);

  /// Synthesizes `echoes` and adds the image; keeps it as a layer called `name` if the options ask for it.
  void add(const std::string& name, const Echoes& echoes);
  /// Adds the image of a stream likewise. Its echoes need not be stored for a head and method that are `streamed`.
  void add(const std::string& name, const EchoStream& stream);
  /// Adds the noise of all elements; in an image of expected power, its expected intensity.
  void add_noise();

  /// Moves into `result` the ping (the sum in single precision, with its layers), the report of layers, and the sum of
  /// the element series of all echoes if the options ask for it.
  void finish(SimulatedPing& result);

 private:
  void add_pressure(const std::string& name, std::size_t echoes, ComplexGrid pressure);
  /// Forms the beams of the whole array, or of one half of it.
  std::shared_ptr<const Synthesizer> whole() const;
  std::shared_ptr<const Synthesizer> half(ApertureSide side) const;
  SonarHead half_head(ApertureSide side) const { return half_aperture(ping_.head, side, "PingSimulator"); }
  /// Adds image(side) of either half of a split aperture, if its phase is asked for.
  template <typename Image>
  void add_halves(const Image& image);
  template <typename EchoesOrStream>
  void add_image(const std::string& name, const EchoesOrStream& echoes);

  const ResolvedPing& ping_;
  SynthesizerTable& synthesizers_;
  bool incoherent_;
  ComplexGrid sum_;
  ComplexGrid port_, starboard_;  // the sums of the halves
  std::vector<Layer> layers_;
  std::vector<LayerReport> report_;
  ElementSeries elements_;
};

}  // namespace insonify

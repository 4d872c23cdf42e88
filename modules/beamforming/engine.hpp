// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "acoustics/echo_stream.hpp"
#include "beamforming/synthesize.hpp"

namespace insonify {

/// The image that an engine computes.
enum class ImageModel {
  narrow_band,    ///< far field, one pattern for all frequencies of the pulse (E12)
  true_delays,    ///< delays from each echo to each element, beams focused at each range (E61, E62)
  expected_power  ///< root of the expected intensity, without speckle (E65)
};

/// Forms images of one head, medium and tolerance. Several threads may call `pressure` at once.
class ImageEngine {
 public:
  virtual ~ImageEngine() = default;
  /// Returns the image, beams x bins [Pa]. Throws Error for echoes that are not finite.
  virtual ComplexGrid pressure(const Echoes& echoes) const = 0;
  /// Returns the same for echoes that `stream` makes chunk by chunk; an engine that does not stream stores all first.
  virtual ComplexGrid pressure(const EchoStream& stream) const { return pressure(all_echoes(stream)); }
};

/// A method of synthesis: one row of a table from which command line, plan, checks and accuracy take what they need.
struct Engine {
  SynthesisMethod method;
  std::string_view word;    ///< name in options, files and tables
  std::string_view says;    ///< help
  ImageModel model;         ///< image that the engine approximates
  SynthesisMethod referee;  ///< slower engine of the same model; the engine itself if there is none
  double least_tolerance, most_tolerance;
  bool replaceable;                      ///< true: the plan may take an engine of true delays instead
  bool receives_all_rows;                ///< true: no echo is omitted from a row of beams that hardly receives it
  bool (*suits)(const SonarHead&);       ///< returns true if the engine can form the beams of the head's array
  bool (*whole_head)(const SonarHead&);  ///< returns true if one object forms all rows of the head, else one a row
  bool (*streams)(const SonarHead&);     ///< returns true if echoes of a stream need not be stored
  /// Constructs the engine for a head, medium and options.
  std::unique_ptr<const ImageEngine> (*make)(const SonarHead&, const Medium&, const SynthesisOptions&);
};

/// Returns all engines; of one model the fastest comes first.
std::span<const Engine> engines();
/// Returns the row of a method.
const Engine& engine_of(SynthesisMethod method);
/// Returns the fastest engine of a model that keeps the tolerance, else the referee of the model.
const Engine& engine_for(ImageModel model, double tolerance);
/// Returns the engine of a model that has no referee.
const Engine& referee_for(ImageModel model);

/// Returns true if images of the method are expected levels, which add up by their squares.
inline bool gives_power(SynthesisMethod method) { return engine_of(method).model == ImageModel::expected_power; }
/// Returns true if beams of the method receive each frequency of the pulse by its own pattern.
inline bool receives_whole_band(SynthesisMethod method) { return engine_of(method).model == ImageModel::true_delays; }

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <memory>
#include <optional>

#include "sonar/receive_array.hpp"
#include "sonar/response_table.hpp"

namespace insonify {

/// Intensity responses of the beams of a head in its plane: from a table where their pattern depends on u - u_beam
/// alone, else summed over the elements (E205).
class BeamResponses {
 public:
  /// Throws Error for an invalid array or a wavelength [m] that is not > 0.
  BeamResponses(const SonarHead& head, double wavelength) : wavelength_(wavelength), array_(receive_array(head)) {
    if (array_->line()) table_.emplace(head.array, wavelength);
  }
  /// Returns the response of the beam at the direction cosines u_beam, v_beam to an echo from u, v.
  double intensity(double u, double v, double u_beam, double v_beam) const {
    if (table_) return table_->intensity(u - u_beam);
    return std::norm(array_->response(ahead(u, v), ahead(u_beam, v_beam), wavelength_));
  }
  /// Returns ResponseTable::reach; without a table the widest offset.
  double reach(double floor) const { return table_ ? table_->reach(floor) : 2; }
  /// Returns ResponseTable::responds_to; without a table true.
  bool responds_to(double nearest, double farthest, double reach) const {
    return !table_ || table_->responds_to(nearest, farthest, reach);
  }
  /// Returns the width of a lobe in u.
  double lobe() const { return wavelength_ / array_->length(); }

 private:
  double wavelength_;
  std::unique_ptr<const ReceiveArray> array_;
  std::optional<ResponseTable> table_;
};

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

std::vector<Eigen::Vector3d> places_on(const LineArray& array) {
  std::vector<Eigen::Vector3d> places;
  for (std::size_t m = 0; m < array.elements(); ++m)
    places.emplace_back(0, array.spacing * element_position(m, array.elements()), 0);
  return places;
}

class Line : public ReceiveArray {
 public:
  explicit Line(const SonarHead& head) : ReceiveArray(head, places_on(head.array)), line_(head.array) {}

  void require_valid(const SonarHead& head, const char* who) const override {
    if (head.fan.row_width > 0)
      fail(ErrorKind::argument, who, ": fan.row_width = ", degrees(head.fan.row_width),
           " deg, must be 0 for a head without column");
  }
  const LineArray* line() const override { return &line_; }
  double length() const override { return line_.spacing * static_cast<double>(line_.elements()); }
  double steering_phase(std::size_t m, const Eigen::Vector3d& beam, double wavelength) const override {
    return 2 * pi * line_.spacing / wavelength * element_position(m, line_.elements()) * beam.y();
  }
  std::complex<double> response(const Eigen::Vector3d& from, const Eigen::Vector3d& beam,
                                double wavelength) const override {
    return array_response(line_, wavelength, from.y(), beam.y());
  }
  double beam_width(double wavelength) const override { return array_beam_width(line_, wavelength); }
  bool has_further_lobes(const BeamFan& fan, double wavelength) const override {
    double most = 0;
    for (const Eigen::Vector3d& axis : beam_axes(fan)) most = std::max(most, std::abs(axis.y()));
    return wavelength / line_.spacing < 1 + most;
  }
  double directivity_index_db(double wavelength) const override {
    return insonify::directivity_index_db(line_, wavelength);
  }

 private:
  LineArray line_;
};

class Plane final : public Line {
 public:
  explicit Plane(const SonarHead& head) : Line(head), column_(*head.column) {}

  void require_valid(const SonarHead& head, const char* who) const override {
    require_column(who);
    if (!(head.fan.row_width > 0))
      fail(ErrorKind::argument, who, ": fan.row_width = 0, must be the width of the column's beam");
    if (column_.elements() > (std::size_t{1} << 28) / head.array.elements())
      fail(ErrorKind::argument, who, ": ", head.array.elements(), " columns of ", column_.elements(),
           " elements, must be at most 2^28 in all; ask for wider beams");
  }
  bool has_further_lobes(const BeamFan& fan, double wavelength) const override {
    double most = 0;
    for (const Eigen::Vector3d& axis : beam_axes(fan)) most = std::max(most, std::abs(axis.z()));
    return Line::has_further_lobes(fan, wavelength) || wavelength / column_.spacing < 1 + most;
  }
  double directivity_index_db(double wavelength) const override {
    insonify::require_valid(*line(), "directivity_index_db");
    require_column("directivity_index_db");
    const std::vector<double> across = lag_products(*line()), up = lag_products(column_);
    double sum = 0;
    for (std::size_t p = 0; p < across.size(); ++p)
      for (std::size_t q = 0; q < up.size(); ++q) {
        const double distance = std::hypot(static_cast<double>(p) * spacing_, static_cast<double>(q) * column_.spacing);
        const double x = 2 * pi * distance / wavelength;
        sum += across[p] * up[q] * (x > 0 ? std::sin(x) / x : 1);
      }
    return -db_from_power(sum);  // (E56)
  }

 private:
  void require_column(const char* who) const try { insonify::require_valid(column_, who); } catch (const Error& error) {
    fail(error.kind(), error.what(), " (column)");
  }

  LineArray column_;
};

}  // namespace

std::unique_ptr<const ReceiveArray> line_or_plane(const SonarHead& head) {
  if (head.column) return std::make_unique<Plane>(head);
  return std::make_unique<Line>(head);
}

}  // namespace insonify

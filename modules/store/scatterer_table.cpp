#include "store/scatterer_table.hpp"

#include <cmath>

#include "core/units.hpp"
#include "store/csv_rows_internal.hpp"

namespace insonify {
namespace {

const CsvColumns columns = {"range_m", "azimuth_rad", "elevation_rad", "sigma_m2", "xi_re", "xi_im"};
enum Column { range_m, azimuth_rad, elevation_rad, sigma_m2, xi_re, xi_im };
using Row = std::span<const double>;

void require_valid(const Row& row, const FilePlace& place) {
  if (!(row[range_m] > 0)) place.fail_here("range_m = ", row[range_m], " m, must be > 0");
  if (!(row[sigma_m2] >= 0)) place.fail_here("sigma_m2 = ", row[sigma_m2], " m^2, must be >= 0");
  if (!(std::abs(row[azimuth_rad]) <= pi))
    place.fail_here("azimuth_rad = ", row[azimuth_rad], " rad, must be within -pi and pi (is it in degrees?)");
  if (!(std::abs(row[elevation_rad]) <= pi / 2))
    place.fail_here("elevation_rad = ", row[elevation_rad], " rad, must be within -pi/2 and pi/2 (is it in degrees?)");
}

void append(ScattererTable& table, const Row& row) {
  Scatterers& s = table.scatterers;
  const std::size_t place = s.size();
  s.range.push_back(row[range_m]);
  s.azimuth.push_back(row[azimuth_rad]);
  s.elevation.push_back(row[elevation_rad]);
  s.cos_incidence.push_back(1);
  s.projected_area.push_back(0);  // sigma is given instead
  s.material.push_back(0);
  s.id.push_back(place);
  s.surfel.push_back(static_cast<std::uint32_t>(place));
  table.sigma.push_back(row[sigma_m2]);
  table.xi.emplace_back(row[xi_re], row[xi_im]);
}

}  // namespace

ScattererTable load_scatterer_table(const std::string& path) {
  ScattererTable table;
  read_csv(path, {&columns, 1}, [&](std::size_t) {
    return [&](Row row, const FilePlace& place) {
      require_valid(row, place);
      append(table, row);
    };
  });
  return table;
}

}  // namespace insonify

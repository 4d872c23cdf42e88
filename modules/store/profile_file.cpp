#include "store/profile_file.hpp"

#include <array>

#include "acoustics/water.hpp"
#include "store/csv_rows_internal.hpp"

namespace insonify {
namespace {

using Row = std::span<const double>;

const std::array<CsvColumns, 2> layouts = {CsvColumns{"depth_m", "sound_speed"},
                                           CsvColumns{"depth_m", "temperature_c", "salinity_psu"}};

// Sound speed of a row with temperature and salinity.
double speed_of_water(const Row& row, const FilePlace& place) {
  const double depth = row[0], temperature_c = row[1], salinity_psu = row[2];
  if (!(depth >= 0)) place.fail_here("depth_m = ", depth, " m, must be >= 0 (it is positive down)");
  if (!(temperature_c >= -4 && temperature_c <= 100))
    place.fail_here("temperature_c = ", temperature_c, " deg C, must be within -4 and 100");
  if (!(salinity_psu >= 0 && salinity_psu <= 400))
    place.fail_here("salinity_psu = ", salinity_psu, " psu, must be within 0 and 400");
  Water water;
  water.depth = depth;
  water.temperature_c = temperature_c;
  water.salinity_psu = salinity_psu;
  return sound_speed(water);
}

void append(SoundSpeedProfile& profile, double depth, double speed, bool given, const FilePlace& place) {
  if (!profile.depth.empty() && !(depth > profile.depth.back()))
    place.fail_here("depth_m = ", depth, " m, must be deeper than the previous line, ", profile.depth.back(), " m");
  if (!(speed >= 1300 && speed <= 1700))
    place.fail_here(given ? "sound_speed = " : "sound speed of temperature_c and salinity_psu = ", speed,
                    " m/s, must be within 1300 and 1700 m/s");
  profile.depth.push_back(depth);
  profile.sound_speed.push_back(speed);
}

}  // namespace

SoundSpeedProfile load_sound_speed_profile(const std::string& path) {
  SoundSpeedProfile profile;
  read_csv(path, layouts, [&](std::size_t layout) {
    const bool given = layout == 0;
    return [&profile, given](Row row, const FilePlace& place) {
      append(profile, row[0], given ? row[1] : speed_of_water(row, place), given, place);
    };
  });
  if (profile.depth.empty()) fail(ErrorKind::content, path, ": has a header only, must have at least one entry");
  return profile;
}

}  // namespace insonify

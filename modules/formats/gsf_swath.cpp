// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include "core/units.hpp"
#include "formats/gsf_record.hpp"

namespace insonify {
namespace {

constexpr double deviations_at_95 = 1.959963985;
constexpr double unknown_corrector = 99.99;  // [m], what GSF writes for one that is not known
constexpr double unknown_angle = 99;         // [deg], of pitch and roll, and of heave in metres

/// Names of the sonars whose subrecords have the numbers from 102 on.
constexpr std::array gsf_sonar_names = {"SeaBeam",
                                        "EM 12",
                                        "EM 100",
                                        "EM 950",
                                        "EM 121A",
                                        "EM 121",
                                        "SASS",
                                        "SeaMap",
                                        "SeaBat",
                                        "EM 1000",
                                        "SeaBeam type III",
                                        "SeaBeam with amplitudes",
                                        "SeaBat II",
                                        "SeaBat 8101",
                                        "SeaBeam 2112",
                                        "ELAC MKII",
                                        "EM 3000",
                                        "EM 1002",
                                        "EM 300",
                                        "SASS, compressed",
                                        "Reson 8101",
                                        "Reson 8111",
                                        "Reson 8124",
                                        "Reson 8125",
                                        "Reson 8150",
                                        "Reson 8160",
                                        "EM 120",
                                        "EM 3002",
                                        "EM 3000D",
                                        "EM 3002D",
                                        "EM 121A SIS",
                                        "EM 710",
                                        "EM 302",
                                        "EM 122",
                                        "GeoSwath Plus",
                                        "Klein 5410",
                                        "Reson 7125",
                                        "EM 2000",
                                        "EM 300 raw",
                                        "EM 1002 raw",
                                        "EM 2000 raw",
                                        "EM 3000 raw",
                                        "EM 120 raw",
                                        "EM 3002 raw",
                                        "EM 3000D raw",
                                        "EM 3002D raw",
                                        "EM 121A SIS raw",
                                        "EM 2040",
                                        "Delta T",
                                        "R2Sonic 2022",
                                        "R2Sonic 2024",
                                        "R2Sonic 2020",
                                        "",
                                        "Reson T series",
                                        "KMALL",
                                        "ME70BO"};

std::string gsf_sonar_name(int sensor) {
  const int at = sensor - 102;
  const bool named =
      at >= 0 && at < static_cast<int>(gsf_sonar_names.size()) && *gsf_sonar_names[static_cast<std::size_t>(at)];
  return named ? gsf_sonar_names[static_cast<std::size_t>(at)] : "sonar " + std::to_string(sensor) + " of GSF";
}

/// Returns 0 for what GSF marks as unknown.
double gsf_known(double value, double unknown) { return value >= unknown - 1e-6 ? 0 : value; }

double gsf_entry(const std::vector<double>* values, std::size_t beam) {
  return values ? (*values)[beam] : not_recorded;
}

/// Returns the standard deviation of an error at 95 %; errors that are 0 are not stated.
double gsf_deviation(const std::vector<double>* values, std::size_t beam) {
  const double error = gsf_entry(values, beam);
  return error > 0 ? error / deviations_at_95 : not_recorded;
}

/// The arrays of a ping that make a sounding.
struct SoundingArrays {
  explicit SoundingArrays(const GsfRecordedPing& ping)
      : depth(ping.array(GsfArrayId::depth)),
        across(ping.array(GsfArrayId::across)),
        along(ping.array(GsfArrayId::along)),
        time(ping.array(GsfArrayId::travel_time)),
        level(ping.array(GsfArrayId::calibrated_amplitude)),
        vertical(ping.array(GsfArrayId::vertical_error)),
        horizontal(ping.array(GsfArrayId::horizontal_error)),
        flags(ping.array(GsfArrayId::beam_flags)) {
    if (!depth) depth = ping.array(GsfArrayId::nominal_depth);
    if (!level) level = ping.array(GsfArrayId::relative_amplitude);
  }
  const std::vector<double>*depth, *across, *along, *time, *level, *vertical, *horizontal, *flags;
};

SwathSounding gsf_sounding(const SoundingArrays& arrays, std::size_t beam, double head_depth) {
  SwathSounding sounding;
  sounding.beam = beam;
  sounding.depth = gsf_entry(arrays.depth, beam);
  sounding.across = arrays.across ? gsf_entry(arrays.across, beam) : 0;
  sounding.along = arrays.along ? gsf_entry(arrays.along, beam) : 0;
  sounding.travel_time = gsf_entry(arrays.time, beam), sounding.level_db = gsf_entry(arrays.level, beam);
  sounding.vertical_deviation = gsf_deviation(arrays.vertical, beam);
  sounding.horizontal_deviation = gsf_deviation(arrays.horizontal, beam);
  sounding.rejected = arrays.flags && (static_cast<int>(gsf_entry(arrays.flags, beam)) & 1) != 0;
  sounding.angle = swath_angle(sounding, head_depth);
  return sounding;
}

SwathPing gsf_swath_ping(const GsfRecordedPing& from, std::size_t number) {
  const auto& head = from.header;
  SwathPing ping;
  ping.number = static_cast<std::uint32_t>(number);
  ping.time = head.at("TIME") + head.at("TIME_NS");
  const auto height = head.find("HEIGHT");
  ping.position = {radians(head.at("LATITUDE")), radians(head.at("LONGITUDE")),
                   height == head.end() ? 0 : gsf_known(height->second, 9999)};
  ping.heading = radians(head.at("HEADING"));
  ping.pitch = radians(gsf_known(head.at("PITCH"), unknown_angle));
  ping.roll = radians(gsf_known(head.at("ROLL"), unknown_angle));
  ping.heave = gsf_known(head.at("HEAVE"), unknown_angle);
  const auto height_of_tide = head.find("GPS_TIDE_CORRECTOR");
  ping.head_depth = gsf_known(head.at("DEPTH_CORRECTOR"), unknown_corrector);
  if (ping.head_depth != 0)
    ping.head_depth += gsf_known(head.at("TIDE_CORRECTOR"), unknown_corrector) +
                       (height_of_tide == head.end() ? 0 : gsf_known(height_of_tide->second, unknown_corrector));
  ping.beams = from.beams();
  const SoundingArrays arrays(from);
  for (std::size_t b = 0; arrays.depth && b < ping.beams; ++b) {
    const SwathSounding sounding = gsf_sounding(arrays, b, ping.head_depth);
    if (sounding.depth != 0 || sounding.across != 0 || sounding.along != 0) ping.soundings.push_back(sounding);
  }
  return ping;
}

}  // namespace

const std::vector<double>* GsfRecordedPing::array(GsfArrayId id) const {
  const auto found = arrays.find(id);
  return found == arrays.end() ? nullptr : &found->second;
}

SwathRecord swath_of(const GsfRecord& record) {
  SwathRecord swath;
  swath.format = "GSF " + record.version, swath.total_deviations = true;
  swath.sonar = gsf_sonar_name(record.pings.front().sensor);
  for (const GsfRecordedPing& ping : record.pings) {
    swath.pings.push_back(gsf_swath_ping(ping, swath.pings.size()));
    if (ping.array(GsfArrayId::calibrated_amplitude))
      swath.unit = "dB re 1 uPa";
    else if (ping.array(GsfArrayId::relative_amplitude) && swath.unit.empty())
      swath.unit = "dB re unknown";
  }
  swath.profiles = record.profiles, swath.attitudes = record.attitudes, swath.records = record.records;
  return swath;
}

}  // namespace insonify

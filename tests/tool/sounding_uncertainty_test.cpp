// SPDX-License-Identifier: BSD-3-Clause
// Uncertainties of soundings against the spread of soundings that a perturbed vehicle makes.
#include "tool/export/sounding_uncertainty.hpp"

#include "core/pose.hpp"
#include "formats/gsf_record.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify::tool;

namespace {

/// A vehicle under way with a head that looks straight down from below its origin, and one of the head's beams.
struct PerturbedSwath {
  InstrumentDeviations deviations{0.2, 0.1, radians(0.3), radians(0.05), 0.02, 1.5, 0.8};
  double range_deviation = 0.05, azimuth = radians(-50), time = 0.05, sound_speed = 1490;  // time: there and back [s]
  double yaw = radians(30), bow_down = radians(-3), roll = radians(4);
  Eigen::Vector3d lever{1.5, -0.5, -1}, position{10, -20, 0.5}, velocity{3, 1, 0}, turn_rate{0, 0, 0.05};

  /// Returns where a sounding is believed, by errors in units of their deviations: position, height, heading, pitch,
  /// roll, latency, sound speed, sound speed at the head, range.
  Eigen::Vector3d sounding(const std::array<double, 10>& e) const {
    const double late = e[6] * deviations.latency;
    const Eigen::Vector3d at =
        position + velocity * late +
        Eigen::Vector3d(e[0] * deviations.position, e[1] * deviations.position, e[2] * deviations.height);
    const Pose vehicle =
        pose_from_yaw_pitch_roll(at, yaw + turn_rate.z() * late + e[3] * deviations.heading,
                                 bow_down + e[4] * deviations.attitude, roll + e[5] * deviations.attitude);
    // Delays steer a line array to a sine in proportion to the sound speed that is believed at the head.
    const double turned = std::asin(std::sin(azimuth) * (1 + e[8] * deviations.surface_sound_speed / sound_speed));
    const Eigen::Vector3d ray = vehicle.linear() * Eigen::Vector3d(0, std::sin(turned), -std::cos(turned));
    // Snell: the sine of the angle from the vertical goes with the sound speed that is believed below the head.
    const double believed = sound_speed + e[7] * deviations.sound_speed;
    const double sine = ray.head<2>().norm() * believed / sound_speed;
    const Eigen::Vector2d outward = ray.head<2>().normalized();
    const double length = 0.5 * believed * time + e[9] * range_deviation;
    return vehicle * lever +
           length * Eigen::Vector3d(sine * outward.x(), sine * outward.y(), -std::sqrt(1 - sine * sine));
  }

  SoundingGeometry geometry() const {
    const Eigen::Vector3d at = sounding({});
    const Pose vehicle = pose_from_yaw_pitch_roll(position, yaw, bow_down, roll);
    const Eigen::Vector3d ahead(std::cos(yaw), std::sin(yaw), 0), starboard(std::sin(yaw), -std::cos(yaw), 0);
    const auto level = [&](const Eigen::Vector3d& v) {
      return Eigen::Vector3d(v.dot(ahead), v.dot(starboard), -v.z());
    };
    SoundingGeometry geometry;
    geometry.from_head = level(at - vehicle * lever), geometry.from_vehicle = level(at - position);
    geometry.velocity = level(velocity + turn_rate.cross(at - position));
    geometry.range_deviation = range_deviation, geometry.steering = -azimuth, geometry.sound_speed = sound_speed;
    return geometry;
  }
};

struct PerturbedSpread {
  double vertical = 0;  ///< standard deviation [m]
  double within = 0;    ///< share within the predicted THU
};

/// Draws soundings of which `only` one source errs, or all of them (-1).
PerturbedSpread spread_of(const PerturbedSwath& swath, double thu, int draws) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d exact = swath.sounding({});
  double squares = 0, within = 0;
  for (int i = 0; i < draws; ++i) {
    std::array<double, 10> errors{};
    for (double& error : errors) error = normal(random);
    const Eigen::Vector3d off = swath.sounding(errors) - exact;
    squares += off.z() * off.z(), within += off.head<2>().norm() <= thu ? 1 : 0;
  }
  return {std::sqrt(squares / draws), within / draws};
}

/// Sets all deviations but one to 0.
PerturbedSwath with_one_source(std::size_t source) {
  PerturbedSwath swath;
  const InstrumentDeviations all = swath.deviations;
  InstrumentDeviations one;
  for (const auto& [at, member] :
       {std::pair<std::size_t, double InstrumentDeviations::*>(1, &InstrumentDeviations::attitude),
        {2, &InstrumentDeviations::heading},
        {3, &InstrumentDeviations::position},
        {4, &InstrumentDeviations::height},
        {5, &InstrumentDeviations::latency},
        {6, &InstrumentDeviations::sound_speed},
        {7, &InstrumentDeviations::surface_sound_speed}})
    if (at == source) one.*member = all.*member;
  swath.deviations = one;
  if (source != 0) swath.range_deviation = 0;
  return swath;
}

}  // namespace

// E214: of 40 000 draws the deviation is known to 0.35 %, and a share of 0.95 to 0.0011; four of each are allowed.
TEST(SoundingUncertainty, is_the_spread_of_a_perturbed_vehicle) {
  const int draws = 40000;
  for (const double azimuth : {-60.0, -20.0, 0.0, 45.0}) {
    PerturbedSwath swath;
    swath.azimuth = radians(azimuth);
    const SoundingUncertainty predicted = uncertainty_of(swath.geometry(), swath.deviations);
    const PerturbedSpread spread = spread_of(swath, predicted.thu, draws);
    EXPECT_NEAR(predicted.vertical / spread.vertical, 1, 4 / std::sqrt(2.0 * draws)) << azimuth;
    EXPECT_NEAR(spread.within, 0.95, 4 * std::sqrt(0.95 * 0.05 / draws)) << azimuth;
    EXPECT_NEAR(predicted.tvu, 1.96 * predicted.vertical, 1e-4);
  }
}

TEST(SoundingUncertainty, has_each_source_in_its_own_term) {
  for (std::size_t source = 0; source < uncertainty_terms.size(); ++source) {
    const PerturbedSwath swath = with_one_source(source);
    const SoundingUncertainty predicted = uncertainty_of(swath.geometry(), swath.deviations);
    const PerturbedSpread spread = spread_of(swath, predicted.thu, 40000);
    EXPECT_NEAR(predicted.vertical, spread.vertical, 1e-4 + 4 * spread.vertical / std::sqrt(80000.0))
        << uncertainty_terms[source];
    if (predicted.thu > 1e-3) {
      EXPECT_NEAR(spread.within, 0.95, 0.005) << uncertainty_terms[source];
    }
    for (std::size_t other = 0; other < uncertainty_terms.size(); ++other)
      EXPECT_EQ(predicted.terms[other].norm() > 0, other == source)
          << uncertainty_terms[source] << ", " << uncertainty_terms[other];
  }
}

// The radius that holds 95 % against the integral over the plane of a normal distribution of deviations 1 and s.
TEST(SoundingUncertainty, thu_holds_95_percent_of_any_ellipse) {
  for (const double smaller : {1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    InstrumentDeviations none;
    SoundingGeometry sounding;
    sounding.from_head = sounding.from_vehicle = {0, 0, 1}, sounding.sound_speed = 1500;
    none.latency = 1, none.position = smaller;
    sounding.velocity = {std::sqrt(1 - smaller * smaller), 0, 0};
    const double radius = uncertainty_of(sounding, none).thu;
    double share = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) {  // over x, of the share of y within the circle
      const double x = radius * (2 * (i + 0.5) / steps - 1);
      share += 2 * radius / steps * std::exp(-x * x / 2) / std::sqrt(2 * pi) *
               std::erf(std::sqrt(radius * radius - x * x) / (smaller * std::numbers::sqrt2));
    }
    EXPECT_NEAR(share, 0.95, 6e-4) << smaller;  // that of 0.2 % of the radius
  }
}

namespace {

/// The survey of a level bed at z = -10, 80 pings, with navigation that errs anew at each ping.
class UncertainRun : public ToolTest {
 protected:
  void survey(const std::string& more) const {
    write("bed.obj", "v -24 -24 -10\nv 24 -24 -10\nv 24 24 -10\nv -24 24 -10\nf 1 2 3\nf 1 3 4\n");
    write("m.toml",
          "schema = 1\n[survey]\nscene = \"bed.obj\"\nstart_utc = \"2026-05-01T08:30:00Z\"\nanchor = { latitude_deg = "
          "54, longitude_deg = 8, heading_deg = 40 }\n[trajectory]\nwaypoints_m = [[-2, 0, 0], [2, 0, 0]]\nspeed_m_s = "
          "1\n" +
              more +
              "[[head]]\nsonar = \"em2040\"\nname = \"swath\"\nset = [\"sonar.beams=8\", "
              "\"sonar.field_of_view_deg=90\"]\nrange = \"6:20\"\nrate_hz = 20\n[ping]\nsplit = true\nnoise = true\n");
    succeed("survey m.toml -q -o run");
    succeed("merge run -q");
    succeed("export run --to gsf -q -o run.gsf");
    succeed("export run --to csv -q -o run.csv");
  }
};

}  // namespace

// Navigation errs with the deviations that the mission states, and depths scatter about the bed as GSF and CSV predict:
// of 80 pings the deviation of each beam is known to 8 %, four of which are allowed.
TEST_F(UncertainRun, depths_scatter_as_predicted) {
  survey("nav_noise = { position_m = 0.05, attitude_deg = 0.4, correlation_s = 0.005 }\n");
  const SwathRecord record = read_swath(path("run.gsf"));
  std::map<std::size_t, std::vector<double>> normalised;
  for (const SwathPing& ping : record.pings)
    for (const SwathSounding& sounding : ping.soundings)
      normalised[sounding.beam].push_back((sounding.depth - 10) / sounding.vertical_deviation);
  ASSERT_EQ(normalised.size(), 8U);
  for (const auto& [beam, values] : normalised) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(values.size())), 1, 4 / std::sqrt(2.0 * 80)) << beam;
  }
}

TEST_F(UncertainRun, gsf_and_csv_state_the_same_and_info_the_order) {
  survey("[instruments]\nheight_m = 0.05\nposition_m = 0.4\nattitude_deg = 0.02\n");
  std::istringstream csv(read("run.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_THAT(line,
              HasSubstr(",northing_m,tvu_m,thu_m,detection_vertical_m,detection_horizontal_m,attitude_vertical_m"));
  const auto tvu_column =
      static_cast<std::size_t>(std::count(line.begin(), line.begin() + line.find(",tvu_m"), ',')) + 1;
  std::vector<double> tvu_of_csv, tvu_of_gsf;
  while (std::getline(csv, line)) {
    std::istringstream words(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), tvu_column + 2 + 16);
    tvu_of_csv.push_back(std::stod(cells[tvu_column]));
    EXPECT_GT(tvu_of_csv.back(), 1.96 * 0.05 - 1e-4);
    EXPECT_EQ(cells[tvu_column + 2 + 2 * 4], "0.05000");  // of the height
  }
  for (const GsfRecordedPing& ping : read_gsf(path("run.gsf")).pings)
    for (const double tvu : *ping.array(GsfArrayId::vertical_error))
      if (tvu > 0) tvu_of_gsf.push_back(tvu);
  std::ranges::sort(tvu_of_csv), std::ranges::sort(tvu_of_gsf);
  EXPECT_THAT(tvu_of_gsf, testing::Pointwise(testing::DoubleNear(6e-5), tvu_of_csv));  // 0.1 mm and 0.01 mm
  const nlohmann::json info = json_of("info run.gsf");
  EXPECT_EQ(info["iho_orders"]["exclusive"], 1);  // 1.96 * 0.05 and 2.45 * 0.4 are below 0.17 and 1 m
  EXPECT_EQ(info["iho_order"], "exclusive");
}

// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/sonar_spec.hpp"

#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

SonarSpec spec() {
  SonarSpec s;
  s.name = "test";
  s.centre_frequency = 750e3, s.bandwidth = 150e3;
  s.beams = 64, s.field_of_view = radians(60);
  s.beam_width = radians(1), s.elevation_width = radians(20);
  s.side_lobe_db = 0;
  s.min_range = 0.5, s.max_range = 9;
  return s;
}

void expect_refused(const SonarSpec& s, const std::string& part) {
  expect_error(ErrorKind::argument, {part}, [&] { make_head(s, 1490); });
}

}  // namespace

// 1 degree needs 0.8859 / (0.5 sin 1 deg) = 101.5 half-wavelength elements.
TEST(MakeHead, builds_the_array_for_the_beam_width) {
  const SonarHead head = make_head(spec(), 1490);
  EXPECT_NEAR(static_cast<double>(head.array.elements()), 101.5, 0.6);
  EXPECT_NEAR(degrees(array_beam_width(head.array, 1500 / 750e3)), 1, 0.006);
}

TEST(MakeHead, lengthens_a_shaded_array_to_keep_the_beam_width) {
  SonarSpec s = spec();
  s.side_lobe_db = -30;
  const SonarHead head = make_head(s, 1490);
  EXPECT_GT(head.array.elements(), 115U);
  EXPECT_NEAR(degrees(array_beam_width(head.array, 1500 / 750e3)), 1, 0.006);
}

TEST(MakeHead, shades_the_array_as_asked_and_keeps_the_beam_width) {
  const auto shaded = [](std::optional<Shading> shading, double side_lobe_db) {
    SonarSpec s = spec();
    s.shading = shading;
    s.side_lobe_db = side_lobe_db;
    return make_head(s, 1490).array;
  };
  for (const Shading shading : {Shading::uniform, Shading::taylor, Shading::hamming, Shading::chebyshev}) {
    const LineArray array = shaded(shading, -35);
    EXPECT_EQ(array.shading, shading_weights(shading, array.elements(), -35)) << shading_name(shading);
    EXPECT_NEAR(degrees(array_beam_width(array, 1500 / 750e3)), 1, 0.006) << shading_name(shading);
  }
  EXPECT_EQ(shaded({}, -35).shading, shaded(Shading::taylor, -35).shading);
  EXPECT_EQ(shaded({}, 0).shading, shaded(Shading::uniform, -35).shading);
}

TEST(MakeHead, refuses_a_shading_without_its_side_lobe_level) {
  SonarSpec s = spec();
  for (const Shading shading : {Shading::taylor, Shading::chebyshev}) {
    s.shading = shading;
    expect_refused(s, "side_lobe_db = 0 dB, must be within -80 and -13.3 for shading taylor or chebyshev");
  }
  s.shading = Shading::hamming;
  EXPECT_NO_THROW(make_head(s, 1490));
}

TEST(MakeHead, samples_the_pulse_unless_given_a_bin_size) {
  EXPECT_NEAR(make_head(spec(), 1490).gate.bin_size, 0.44 * 1490 / 300e3, 1e-12);
  SonarSpec fine = spec();
  fine.bin_size = 0.001;
  EXPECT_EQ(make_head(fine, 1490).gate.bin_size, 0.001);
  SonarSpec coarse = spec();
  coarse.bin_size = 0.01;
  expect_refused(coarse, "would under-sample the pulse");
}

TEST(MakeHead, takes_given_beams) {
  SonarSpec s = spec();
  s.azimuths = {-0.3, 0.1, 0.15};
  EXPECT_EQ(make_head(s, 1490).fan.azimuth, s.azimuths);
}

TEST(MakeHead, builds_rows_of_beams_and_the_column_of_a_planar_array) {
  SonarSpec s = spec();
  s.elevations = {-0.1, 0.05};
  s.column_beam_width = radians(2);
  s.transmit_width = 0.8;
  s.side_lobe_db = -30;
  const SonarHead head = make_head(s, 1490);
  ASSERT_EQ(head.fan.beams(), 128U);
  EXPECT_EQ(head.fan.elevation[63], -0.1);
  EXPECT_EQ(head.fan.elevation[64], 0.05);
  EXPECT_EQ(head.fan.azimuth[64], head.fan.azimuth[0]);
  EXPECT_EQ(head.transmit_width, 0.8);
  EXPECT_EQ(head.fan.row_width, radians(2));
  EXPECT_NEAR(degrees(array_beam_width(*head.column, 1500 / 750e3)), 2, 0.02);
  EXPECT_EQ(head.column->shading, taylor_shading(head.column->elements(), -30));
  EXPECT_FALSE(make_head(spec(), 1490).column);
}

TEST(MakeHead, takes_a_table_of_beams) {
  SonarSpec s = spec();
  s.azimuths = {-0.3, 0.1, 0.15}, s.elevations = {0.1, 0.2, 0.1};
  const SonarHead head = make_head(s, 1490);
  EXPECT_EQ(head.fan.azimuth, s.azimuths);
  EXPECT_EQ(head.fan.elevation, s.elevations);
  s.elevations.pop_back();
  expect_refused(s, "elevations_deg = 2 numbers, must be as many as the 3 of azimuths_deg");
}

TEST(MakeHead, names_key_value_unit_and_rule) {
  SonarSpec s = spec();
  s.max_range = 0.1;
  expect_refused(s, "max_range_m = 0.1 m, must be above min_range_m");
  s = spec();
  s.bandwidth = 2e6;
  expect_refused(s, "bandwidth_hz = 2000000 Hz");
  s = spec();
  s.beam_width = 0;
  expect_refused(s, "beam_width_deg = 0 deg");
  s = spec();
  s.side_lobe_db = -5;
  expect_refused(s, "side_lobe_db = -5 dB");
}

TEST(MakeHead, refuses_a_beam_too_narrow_for_any_array) {
  SonarSpec s = nine_beams();
  for (const double width_deg : {1e-3, 1e-6, 1e-300}) {
    s.beam_width = radians(width_deg);
    expect_error(ErrorKind::argument, {"beam_width = ", "deg needs more than 16384 elements"},
                 [&] { make_head(s, 1500); });
  }
  for (const double width : {0.0, -0.1, std::nan("")}) {
    s.beam_width = width;
    expect_error(ErrorKind::argument, {"beam_width_deg", "> 0"}, [&] { make_head(s, 1500); });
  }
}

TEST(MakeHead, takes_one_omnidirectional_element_for_a_beam_of_180_degrees) {
  SonarSpec s = nine_beams();
  s.beam_width = pi;
  for (const double side_lobes : {0.0, -30.0}) {
    s.side_lobe_db = side_lobes;
    const SonarHead head = make_head(s, 1500);
    ASSERT_EQ(head.array.elements(), 1U);
    EXPECT_EQ(array_beam_width(head.array, 1500 / s.centre_frequency), pi);
    for (const double u : {-1.0, -0.3, 0.0, 0.7, 1.0})
      EXPECT_EQ(array_response(head.array, 0.1, u, 0.2).real(), 1) << u;
  }
  EXPECT_NEAR(directivity_index_db(uniform_line(1, 0.5), wavelength_900k), 0, 1e-12);
  s.beam_width = radians(181);
  expect_error(ErrorKind::argument, {"beam_width_deg = 181 deg", "at most 180"}, [&] { make_head(s, 1500); });
}

TEST(MakeHead, refuses_a_pulse_longer_than_the_gate) {
  SonarSpec s = nine_beams();
  s.bandwidth = 50;  // c / 2B = 15 m in a gate of 11 m
  expect_error(ErrorKind::argument, {"make_head", "bandwidth_hz = 50 Hz", "15 m", "11 m"}, [&] { make_head(s, 1500); });
  s.bandwidth = 100;  // 7.5 m fits
  EXPECT_EQ(make_head(s, 1500).gate.bins(), 4U);
  for (const double b : {0.0, -1.0, std::nan("")}) {
    s.bandwidth = b;
    expect_error(ErrorKind::argument, {"bandwidth_hz", "Hz, must be > 0"}, [&] { make_head(s, 1500); });
  }
}

TEST(MakeHead, refuses_a_bin_that_would_under_sample_the_pulse) {
  SonarSpec s = nine_beams();
  const double coarsest = 0.44 * 1500 / (2 * s.bandwidth);
  s.bin_size = 1.01 * coarsest;
  expect_error(ErrorKind::argument, {"bin_size_m", "under-sample", "0.44 c / 2B = 0.0165 m"},
               [&] { make_head(s, 1500); });
  s.bin_size = coarsest;
  EXPECT_EQ(make_head(s, 1500).gate.bin_size, coarsest);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "store/sonar_text.hpp"

TEST(SonarFile, reads_plain_keys_in_si_and_radians) {
  const SonarSpec s = load_sonar(plain).spec;
  EXPECT_EQ(s.name, "mine");
  EXPECT_EQ(s.centre_frequency, 900e3);
  EXPECT_EQ(s.bandwidth, 30e3);
  EXPECT_EQ(s.source_level_db, 210);
  EXPECT_EQ(s.beams, 128u);
  EXPECT_EQ(s.field_of_view, radians(90));
  EXPECT_EQ(s.beam_width, radians(1.5));
  EXPECT_EQ(s.elevation_width, radians(20));
  EXPECT_EQ(s.min_range, 0.5);
  EXPECT_EQ(s.max_range, 30);
  EXPECT_EQ(s.elevation, 0);
  EXPECT_EQ(s.side_lobe_db, -30);
  EXPECT_EQ(s.elevation_shape, ElevationShape::gaussian);
  EXPECT_FALSE(s.bin_size.has_value());
  EXPECT_TRUE(s.azimuths.empty());
}

TEST(SonarFile, reads_the_optional_keys) {
  const SonarSpec s = load_sonar(plain +
                                 "elevation_deg = -10\nelevation_shape = \"sector\"\nside_lobe_db = 0\n"
                                 "bin_size_m = 0.01\ndescription = \"x\"\n")
                          .spec;
  EXPECT_EQ(s.elevation, radians(-10));
  EXPECT_EQ(s.elevation_shape, ElevationShape::sector);
  EXPECT_EQ(s.side_lobe_db, 0);
  EXPECT_EQ(s.bin_size, 0.01);
}

TEST(SonarFile, reads_how_a_mission_mounts_the_head) {
  EXPECT_TRUE(load_sonar(plain).mounting.isZero());
  const SonarFile down =
      load_sonar(plain + "mounting_deg = { value = [0, 90, 0], status = \"derived\", source = \"down\" }\n");
  EXPECT_EQ(down.mounting.y(), radians(90));
  EXPECT_EQ(down.numbers.back().value, "[0.0, 90.0, 0.0]");
  refuses_sonar(plain + "mounting_deg = [0, 90]\n",
                "12: mounting_deg = [0, 90], must be three numbers: yaw, pitch, roll");
}

TEST(SonarFile, keeps_the_origin_of_each_number_and_says_user_and_default) {
  const SonarFile file =
      load_sonar(replaced(plain, "210", "{ value = 221, status = \"recalled\", source = \"a talk\" }"));
  std::map<std::string, SourcedNumber> numbers;
  for (const auto& number : file.numbers) numbers[number.key] = number;
  EXPECT_EQ(file.spec.source_level_db, 221);
  EXPECT_EQ(numbers["source_level_db"].value, "221.0");
  EXPECT_EQ(numbers["source_level_db"].status, "recalled");
  EXPECT_EQ(numbers["source_level_db"].source, "a talk");
  EXPECT_EQ(numbers["centre_frequency_hz"].value, "900000.0");
  EXPECT_EQ(numbers["centre_frequency_hz"].status, "user");
  EXPECT_EQ(numbers["elevation_shape"].value, "gaussian");
  EXPECT_EQ(numbers["elevation_shape"].status, "assumed");
  EXPECT_EQ(numbers["side_lobe_db"].source, "omitted in the file: default of insonify");
}

// B = c / 2 dr with the nominal 1500 m/s: one inch is 29.53 kHz.
TEST(SonarFile, takes_range_resolution_for_bandwidth_but_not_both) {
  EXPECT_DOUBLE_EQ(load_sonar(replaced(plain, "bandwidth_hz = 30e3", "range_resolution_m = 0.0254")).spec.bandwidth,
                   1500 / 0.0508);
  refuses_sonar(plain + "range_resolution_m = 0.0254\n",
                "4: bandwidth_hz follows from range_resolution_m; leave it out");
  refuses_sonar(replaced(plain, "bandwidth_hz = 30e3\n", ""),
                "1: missing key 'bandwidth_hz' (or 'range_resolution_m')");
}

// Three beams at -20, 0, 30 deg: mean spacing 25 deg, half of it beyond either end makes 75 deg.
TEST(SonarFile, takes_beams_at_given_azimuths) {
  const std::string text = replaced(plain, "beams = 128\nfield_of_view_deg = 90\n", "azimuths_deg = [-20, 0, 30.0]\n");
  const SonarSpec s = load_sonar(text).spec;
  EXPECT_EQ(s.azimuths, (std::vector<double>{radians(-20), 0, radians(30)}));
  EXPECT_EQ(s.beams, 3u);
  EXPECT_NEAR(s.field_of_view, radians(75), 1e-15);
  refuses_sonar(text + "beams = 3\n", "11: beams follows from azimuths_deg; leave it out");
  refuses_sonar(replaced(text, "[-20, 0, 30.0]", "[]"),
                "6: azimuths_deg = [], must be a list, each a number within -180 and 180");
  refuses_sonar(replaced(text, "30.0", "300"),
                "6: azimuths_deg = [-20, 0, 300], must be a list, each a number within -180 and 180");
  refuses_sonar(replaced(text, "30.0", "\"x\""),
                "6: azimuths_deg = [-20, 0, \"x\"], must be a list, each a number within -180 and 180");
}

TEST(SonarFile, unknown_keys_are_errors_with_line_and_suggestion) {
  refuses_sonar(plain + "\n# a comment\nelevaton_deg = 3\n",
                "14: unknown key 'elevaton_deg'; did you mean 'elevation_deg'?");
  EXPECT_THAT(error_of_sonar(plain + "colour = 3\n"),
              HasSubstr("s.toml:12: unknown key 'colour'; known are name, centre_frequency_hz, bandwidth_hz"));
  refuses_sonar(replaced(plain, "210", "{ value = 1, status = \"sourced\", sources = \"a\" }"),
                "5: unknown key 'source_level_db.sources'; did you mean 'source_level_db.source'?");
}

TEST(SonarFile, missing_keys_are_named) {
  for (const char* line : {"centre_frequency_hz = 900_000\n", "source_level_db = 210\n", "beam_width_deg = 1.5\n",
                           "elevation_width_deg = 20\n", "min_range_m = 0.5\n", "max_range_m = 30\n"}) {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    refuses_sonar(replaced(plain, line, ""), "1: missing key '" + key + "'");
  }
  refuses_sonar(replaced(plain, "beams = 128\n", ""), "1: missing key 'beams' (or 'azimuths_deg')");
  refuses_sonar(replaced(plain, "name = \"mine\"\n", ""), "1: missing key 'name'");
  refuses_sonar(replaced(plain, "schema = 1\n", ""), "1: missing key 'schema'");
}

TEST(SonarFile, wrong_types_are_errors_with_line) {
  refuses_sonar(replaced(plain, "210", "\"loud\""), "5: source_level_db = \"loud\", must be a number");
  refuses_sonar(replaced(plain, "210", "true"), "5: source_level_db = true, must be a number");
  refuses_sonar(replaced(plain, "128", "12.5"), "6: beams = 12.5, must be a whole number within 1 and 65536");
  refuses_sonar(replaced(plain, "128", "0"), "6: beams = 0, must be a whole number within 1 and 65536");
  refuses_sonar(plain + "elevation_shape = \"round\"\n",
                "12: elevation_shape = \"round\", must be one of gaussian, line, sector");
  refuses_sonar(replaced(plain, "210", "{ status = \"sourced\" }"), "5: missing key 'source_level_db.value'");
  refuses_sonar(
      replaced(plain, "210", "{ value = 210, status = \"certain\" }"),
      "5: source_level_db.status = \"certain\", must be one of sourced, recalled, derived, assumed, unknown, user");
  refuses_sonar(replaced(plain, "210", "nan"), "5: source_level_db = nan dB, must be a number");
}

TEST(SonarFile, values_that_make_no_sonar_are_errors_with_line) {
  refuses_sonar(replaced(plain, "max_range_m = 30", "max_range_m = 0.25"),
                "11: max_range_m = 0.25 m, must be above min_range_m");
  EXPECT_EQ(error_of_sonar(replaced(plain, "900_000", "-9")).substr(0, 47),
            "content: s.toml:3: centre_frequency_hz = -9 Hz,");
  EXPECT_EQ(error_of_sonar(replaced(plain, "bandwidth_hz = 30e3", "range_resolution_m = 1e-6")).substr(0, 32),
            "content: s.toml:4: bandwidth_hz ");
}

TEST(SonarFile, other_schemas_and_broken_toml_are_errors_with_line) {
  refuses_sonar(replaced(plain, "schema = 1", "schema = 2"),
                "1: schema = 2, this version reads schema 1; the file is of a newer insonify");
  EXPECT_EQ(error_of_sonar(plain + "beams = = 3\n").substr(0, 19), "content: s.toml:12:");
  EXPECT_EQ(error_of_sonar(plain + "beams = 3\n").substr(0, 19), "content: s.toml:12:");  // given twice
}

TEST(SonarFile, shading_is_one_of_four_words) {
  EXPECT_EQ(load_sonar(plain + "shading = \"hamming\"\n").spec.shading, Shading::hamming);
  refuses_sonar(plain + "shading = \"hann\"\n",
                "12: shading = \"hann\", must be one of taylor, uniform, hamming, chebyshev");
  refuses_sonar(plain + "shading = 3\n", "12: shading = 3, must be one of taylor, uniform, hamming, chebyshev");
  std::map<std::string, SourcedNumber> numbers;
  for (const auto& number : load_sonar(plain + "side_lobe_db = 0\n").numbers) numbers[number.key] = number;
  EXPECT_EQ(numbers["shading"].value, "uniform");
  EXPECT_EQ(numbers["shading"].status, "derived");
}

TEST(SonarFile, takes_a_sweep_with_its_length_and_window) {
  const SonarSpec s = load_sonar(plain + "pulse = \"linear_fm\"\npulse_length_s = 2.1e-3\n").spec;
  EXPECT_EQ(s.pulse, PulseShape::linear_fm);
  EXPECT_EQ(s.pulse_length, 2.1e-3);
  EXPECT_FALSE(s.replica_window.has_value());
  expect_same_bits(load_sonar(sonar_as_toml(s)).spec, s);
}

TEST(SonarFile, takes_a_hyperbolic_sweep_and_a_tone_burst) {
  const SonarSpec sweep =
      load_sonar(plain + "pulse = \"hyperbolic_fm\"\npulse_length_s = 2e-3\nreplica_window = \"hann\"\n").spec;
  EXPECT_EQ(sweep.pulse, PulseShape::hyperbolic_fm);
  EXPECT_EQ(make_head(sweep, 1500).pulse.window, ReplicaWindow::hann);
  expect_same_bits(load_sonar(sonar_as_toml(sweep)).spec, sweep);
  const SonarSpec burst = load_sonar(plain + "pulse = \"tone_burst\"\n").spec;
  EXPECT_EQ(burst.pulse, PulseShape::tone_burst);
  EXPECT_EQ(make_head(burst, 1500).pulse.shape, PulseShape::tone_burst);
  expect_same_bits(load_sonar(sonar_as_toml(burst)).spec, burst);
  refuses_sonar(plain + "pulse = \"hyperbolic_fm\"\n",
                "12: pulse = hyperbolic_fm, must come with pulse_length_s, the duration of the sweep");
  refuses_sonar(plain + "pulse = \"hyperbolic_fm\"\npulse_length_s = 10\n",
                "13: pulse_length_s = 10 s, times bandwidth_hz = 30000 Hz, must be within 1 and 2e4; it is 300000");
  refuses_sonar(plain + "pulse = \"tone_burst\"\nreplica_window = \"hann\"\n",
                "13: replica_window = hann, must be left out for pulse tone_burst; use pulse = \"linear_fm\"");
}

TEST(SonarFile, refuses_halves_of_a_sweep_with_line) {
  refuses_sonar(plain + "pulse = \"chirp\"\n",
                "12: pulse = \"chirp\", must be one of gaussian, linear_fm, "
                "tone_burst, hyperbolic_fm");
  refuses_sonar(plain + "pulse = \"linear_fm\"\npulse_length_s = \"long\"\n",
                "13: pulse_length_s = \"long\", must be a number");
  refuses_sonar(plain + "pulse = \"linear_fm\"\n",
                "12: pulse = linear_fm, must come with pulse_length_s, the duration of the sweep");
  refuses_sonar(plain + "pulse_length_s = 0.001\n",
                "12: pulse_length_s = 0.001 s, must be left out for pulse gaussian, whose length follows "
                "from its bandwidth; use pulse = \"linear_fm\"");
  refuses_sonar(plain + "pulse = \"linear_fm\"\npulse_length_s = 0.001\nreplica_window = \"kaiser\"\n",
                "14: replica_window = \"kaiser\", must be one of uniform, hann, hamming");
  refuses_sonar(plain + "replica_window = \"hann\"\n",
                "12: replica_window = hann, must be left out for pulse gaussian; use pulse = "
                "\"linear_fm\"");
}

TEST(SonarFile, takes_rows_of_beams_and_a_planar_array) {
  const std::string text =
      plain + "elevations_deg = [-10, 0.1, 20]\ncolumn_beam_width_deg = 3\ntransmit_width_deg = 70\n";
  const SonarSpec s = load_sonar(text).spec;
  EXPECT_EQ(s.elevations, (std::vector<double>{radians(-10), radians(0.1), radians(20)}));
  EXPECT_EQ(s.column_beam_width, radians(3));
  EXPECT_EQ(s.transmit_width, radians(70));
  EXPECT_EQ(s.beams, 128u);
  EXPECT_EQ(beams_of(s), 384u);
  expect_same_bits(load_sonar(sonar_as_toml(s)).spec, s);
}

TEST(SonarFile, takes_a_table_of_beams) {
  const std::string text = replaced(plain, "beams = 128\nfield_of_view_deg = 90\n",
                                    "azimuths_deg = [-20, 0, 30]\nelevations_deg = [1, -2, 3]\n");
  const SonarSpec s = load_sonar(text).spec;
  EXPECT_EQ(beams_of(s), 3u);
  EXPECT_EQ(s.elevations, (std::vector<double>{radians(1), radians(-2), radians(3)}));
  expect_same_bits(load_sonar(sonar_as_toml(s)).spec, s);
  refuses_sonar(replaced(text, "[1, -2, 3]", "[1, -2]"),
                "7: elevations_deg = 2 numbers, must be as many as the 3 of azimuths_deg, one for each beam");
  refuses_sonar(replaced(text, "[1, -2, 3]", "[1, -2, 93]"),
                "7: elevations_deg = [1, -2, 93], must be a list, each a number within -90 and 90");
  refuses_sonar(text + "elevation_deg = 3\n", "12: elevation_deg follows from elevations_deg; leave it out");
}

TEST(SonarFile, refuses_widths_and_rows_that_make_no_array) {
  refuses_sonar(plain + "column_beam_width_deg = 0\n",
                "12: column_beam_width_deg = 0 deg, must be a number > 0 (omit the key if there is none)");
  refuses_sonar(plain + "transmit_width_deg = -4\n",
                "12: transmit_width_deg = -4 deg, must be a number > 0 (omit the key if there is none)");
  refuses_sonar(plain + "transmit_width_deg = 400\n",
                "12: transmit_width_deg = 400 deg, must be > 0 and at most 360; leave it out for a transmitter "
                "that fills the fan evenly");
  refuses_sonar(replaced(plain, "field_of_view_deg = 90", "field_of_view_deg = 360"),
                "7: field_of_view_deg = 360 deg, must be > 0 and at most 180: a line array cannot tell ahead from "
                "astern");
  std::string rows = "elevations_deg = [0";
  for (int r = 0; r < 512; ++r) rows += ", 1";
  refuses_sonar(plain + rows + "]\n", "12: elevations_deg = 513 rows of 128 beams, must be at most 65536 beams in all");
}

TEST(SonarFile, is_also_the_sonar_table_of_a_run) {
  const SonarSpec spec = load_sonar(plain).spec;
  expect_same_bits(load_sonar("seed = 3\n[sonar]\n" + sonar_as_toml(spec) + "[water]\nsalinity_psu = 35\n").spec, spec);
  refuses_sonar("seed = 3\n[sonar]\nschema = 1\n", "2: missing key 'name'");
}

// SPDX-License-Identifier: BSD-3-Clause
// insonify beampattern: what it prints is what the beam of a ping is.
#include <nlohmann/json.hpp>

#include "sonar/beam_pattern.hpp"
#include "store/sonar_file.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

using nlohmann::json;

namespace {

class BeamPatternVerb : public ToolTest {
 protected:
  json measure(const std::string& arguments) const { return json_of("beampattern " + arguments); }
};

}  // namespace

TEST_F(BeamPatternVerb, json_holds_the_report_of_the_array_of_the_sonar) {
  const json result = measure("oculus-m750d --steer 30");
  const SonarHead head = make_head(find_sonar("oculus-m750d").spec, result["sound_speed"]);
  const double wavelength = result["wavelength_m"];
  EXPECT_DOUBLE_EQ(wavelength, result["sound_speed"].get<double>() / 750e3);
  const BeamPatternReport report = measure_beam_pattern(head.array, wavelength, radians(30));
  EXPECT_EQ(result["sonar"], "oculus-m750d");
  EXPECT_EQ(result["elements"], head.array.elements());
  EXPECT_DOUBLE_EQ(result["spacing_m"], head.array.spacing);
  EXPECT_EQ(result["shading"], "taylor");
  EXPECT_NEAR(result["steering_deg"], 30, 1e-12);
  EXPECT_NEAR(result["width_deg"], degrees(report.width), 1e-12);
  EXPECT_NEAR(result["first_null_deg"], degrees(*report.first_null), 1e-12);
  EXPECT_NEAR(result["highest_side_lobe_db"], report.highest_side_lobe_db, 1e-12);
  EXPECT_NEAR(result["highest_side_lobe_deg"], degrees(report.highest_side_lobe), 1e-12);
  EXPECT_NEAR(result["directivity_index_db"], report.directivity_index_db, 1e-12);
  EXPECT_EQ(result["grating_lobes_deg"], json::array());
  EXPECT_FALSE(result.contains("picture"));
}

// Shadings keep the beam width that the sonar asks for (1 degree, within half an element and the 0.7 % by which water of
// 1490 m/s differs from the nominal 1500 m/s) and pay in elements.
TEST_F(BeamPatternVerb, shading_can_be_chosen) {
  const json uniform = measure("p900-45 --set sonar.shading=uniform");
  const json hamming = measure("p900-45 --set sonar.shading=hamming");
  const json chebyshev = measure("p900-45 --set sonar.shading=chebyshev --set sonar.side_lobe_db=-40");
  for (const json& result : {uniform, hamming, chebyshev}) EXPECT_NEAR(result["width_deg"], 1, 0.015);
  EXPECT_LT(uniform["elements"], chebyshev["elements"]);
  EXPECT_LT(chebyshev["elements"], hamming["elements"]);
  EXPECT_EQ(hamming["shading"], "hamming");
  EXPECT_NEAR(uniform["highest_side_lobe_db"], -13.26, 0.02);
  EXPECT_NEAR(hamming["highest_side_lobe_db"], -42.7, 0.1);
  EXPECT_NEAR(chebyshev["highest_side_lobe_db"], -40, 0.01);
  EXPECT_EQ(measure("p900-45 --set sonar.side_lobe_db=0"), uniform);
}

TEST_F(BeamPatternVerb, text_says_everything_with_units) {
  const std::string text = succeed("beampattern p900-45 --steer=-30");
  for (const char* part :
       {"p900-45, beam at 30.00 deg starboard", "elements       128", "0.8333 mm", "m/s", "taylor, side lobes -30 dB",
        "deg at -3 dB", "deg off the beam", "grating lobes  none", " dB"})
    EXPECT_THAT(text, HasSubstr(part));
}

// One element: no null, no side lobe, no grating lobe.
TEST_F(BeamPatternVerb, absent_things_are_none_and_null) {
  const json result = measure("p900-45 --set sonar.beam_width_deg=180");
  EXPECT_EQ(result["elements"], 1);
  EXPECT_NEAR(result["width_deg"], 180, 1e-9);
  EXPECT_TRUE(result["first_null_deg"].is_null());
  EXPECT_TRUE(result["highest_side_lobe_db"].is_null());
  EXPECT_THAT(succeed("beampattern p900-45 --set sonar.beam_width_deg=180"), HasSubstr("first null     none"));
}

TEST_F(BeamPatternVerb, draws_a_picture_when_asked) {
  const json result = measure("p900-45 --steer 30 -o pattern.png --size 400x300");
  EXPECT_EQ(result["picture"], "pattern.png");
  EXPECT_EQ(read("pattern.png").substr(1, 3), "PNG");
}

TEST_F(BeamPatternVerb, bad_input_gets_one_line) {
  expect_refused("beampattern p900-54", 2, {"p900-54", "p900-45"});
  expect_refused("beampattern nowhere.toml", 4, {"nowhere.toml"});
  expect_refused("beampattern", 2, {"SONAR"});
  expect_refused("beampattern p900-45 --steer 91", 2, {"--steer = 91 deg", "within -90 and 90"});
  expect_refused("beampattern p900-45 --steer abeam", 2, {"--steer = 'abeam' is not a number"});
  expect_refused("beampattern p900-45 --steer nan", 2, {"--steer"});
  expect_refused("beampattern p900-45 --set sonar.shading=hann", 2,
                 {"shading = \"hann\"", "must be one of taylor, uniform, hamming, chebyshev"});
  expect_refused("beampattern p900-45 --set sonar.shadng=taylor", 2, {"shadng", "did you mean 'shading'"});
  expect_refused("beampattern p900-45 --set sonar.shading=chebyshev --set sonar.side_lobe_db=0", 2,
                 {"side_lobe_db = 0 dB", "within -80 and -13.3"});
  expect_refused("beampattern p900-45 -o nowhere/pattern.png", 4, {"nowhere/pattern.png"});
  expect_refused("beampattern p900-45 --size 3 -o x.png", 2, {"--size"});
}

TEST_F(BeamPatternVerb, help_has_two_examples) {
  const std::string help = succeed("beampattern --help");
  const auto first = help.find("\n  insonify beampattern ");
  ASSERT_NE(first, std::string::npos);
  EXPECT_NE(help.find("\n  insonify beampattern ", first + 1), std::string::npos);
}

// SPDX-License-Identifier: BSD-3-Clause
// Levels through the whole tool.
#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "acoustics/surface_laws.hpp"
#include "store/cube.hpp"
#include "store/materials_file.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

class Levels : public ToolTest {
 protected:
  void write_scatterer(const std::string& name, double range, double azimuth) const {
    char line[200];
    std::snprintf(line, sizeof line, "%.17g,%.17g,0,0.01,1,0\n", range, azimuth);
    write(name, std::string("range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n") + line);
  }
};

// A scatterer of -20 dB on the axis of a beam, at a bin centre: SL - 2 TL + TS within 1e-6 dB, in float32, if so much is
// asked for (1e-8 of the pressure), and within what the default tolerance of 1e-4 allows; with one absorption for the pulse.
TEST_F(Levels, one_scatterer_through_synthesize_is_the_sonar_equation) {
  write_scatterer("first.csv", 10, 0);
  const std::string sonar = " --sonar p900-45 --range 5:15 --no-picture -q";
  succeed("synthesize first.csv -o first" + sonar);
  const Ping axes = cube_of("first").pings[0];
  for (const std::size_t beam : {0, 100, 255})
    for (const std::string method : {"gridded", "gridded --tolerance 1e-8", "direct"}) {
      const double r = axes.gate.centre(400);
      write_scatterer("one.csv", r, axes.fan.azimuth[beam]);
      succeed("synthesize one.csv --force -o one --absorption-order 0 --method " + method + sonar);
      const Cube c = cube_of("one");
      const double expected = c.source_level_db - 2 * (20 * std::log10(r) + c.absorption_db_per_m * r) - 20;
      const auto& p = c.pings[0].pressure;
      EXPECT_NEAR(pressure_level_db(std::abs(std::complex<double>(p(static_cast<int>(beam), 400)))), expected,
                  method == "gridded" ? 20 * std::log10(1 + 1e-4) : 1e-6)
          << method;
      Eigen::Index peak_beam = 0, peak_bin = 0;
      p.abs().maxCoeff(&peak_beam, &peak_bin);
      EXPECT_EQ(peak_beam, static_cast<int>(beam));
      EXPECT_EQ(peak_bin, 400);
    }
}

// Without further options the beams are what the elements receive, to the tolerance, as of a ping: delays across the array
// and absorption over the band where the budget needs them.
TEST_F(Levels, synthesize_computes_what_the_plan_of_a_ping_finds_needed) {
  std::string rows = "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n";
  for (int i = 0; i < 12; ++i)
    rows += std::to_string(4.7 + 0.05 * i) + "," + std::to_string(-0.8 + 0.14 * i) + ",0.02,0.01," +
            (i % 2 == 0 ? "1,0\n" : "0,-1\n");
  write("some.csv", rows);
  const auto pressure = [&](const std::string& run, const std::string& more) {
    succeed("synthesize some.csv -o " + run + " --sonar oculus-m750d --set sonar.beams=40 --no-picture -q " + more);
    return ComplexGrid(cube_of(run).pings[0].pressure.cast<std::complex<double>>());
  };
  const std::string near = "--range 4.5:5.6 ";
  const ComplexGrid planned = pressure("planned", near);
  const ComplexGrid elements = pressure("elements", near + "--method element-exact --absorption-order 2");
  EXPECT_LT(relative_l2(planned, elements), 2e-4);
  EXPECT_GT(relative_l2(pressure("narrow", near + "--method gridded"), elements), 0.1);
  const auto synthesis = [&](const std::string& run) { return manifest_of(run)["synthesis"]; };
  EXPECT_EQ(synthesis("planned")["method"], "true-delays");
  EXPECT_EQ(synthesis("planned")["absorption_order"], 2);
  EXPECT_EQ(synthesis("narrow")["method"], "gridded");
  // A budget of ten times the pressure needs neither.
  pressure("rough", near + "--accuracy-db 20");
  EXPECT_EQ(synthesis("rough")["method"], "gridded");
  EXPECT_EQ(synthesis("rough")["absorption_order"], 0);
  EXPECT_NE(read("rough/run.toml").find("accuracy_db = 20"), std::string::npos);
}

// Flat bottom 3 m below the head (SL 220 dB, 1 degree, 29.5 kHz, sigma its cross-section per area):
// RL = SL - 40 log r - 2 a r + 10 log sigma(h/r) + 10 log[(lambda/L) r^2 / sqrt(r^2 - h^2) c tau_e / 2],
// tau_e = 0.469719 / B. Mean over a strip of 1 m less that [dB].
template <typename Sigma>
double excess_over_bottom(const Cube& c, double strip, const Sigma& sigma) {
  constexpr double h = 3;
  const Ping& ping = c.pings[0];
  const double wavelength = c.sound_speed / c.centre_frequency;
  // The uniform array of the preset: half a wavelength apart at 1500 m/s, 0.886 wavelengths / width long.
  const double length = std::round(0.885893 / (0.5 * radians(1))) * 0.5 * 1500 / c.centre_frequency;
  double excess = 0, samples = 0;
  for (std::size_t b = 0; b < ping.fan.beams(); ++b)
    for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
      const double r = ping.gate.centre(n), cell = wavelength / length * r * r / std::sqrt(r * r - h * h) * 0.5 *
                                                   c.sound_speed * 0.469719 / c.bandwidth;
      if (std::abs(ping.fan.azimuth[b]) > radians(8.5) || std::abs(r - strip) > 0.5) continue;
      const double expected = c.source_level_db - 40 * std::log10(r) - 2 * c.absorption_db_per_m * r +
                              db_from_power(sigma(h / r)) + db_from_power(cell);
      const std::complex<double> p(ping.pressure(static_cast<int>(b), static_cast<int>(n)));
      excess += power_from_db(pressure_level_db(std::abs(p)) - expected);
      ++samples;
    }
  return db_from_power(excess / samples);
}

const std::string bottom_ping =
    " --pose=0,0,3,0,0,0 --no-picture -q --sonar p900-45 --set sonar.beams=41 --set sonar.field_of_view_deg=40 "
    "--set sonar.beam_width_deg=1 --set sonar.bandwidth_hz=29500 --set sonar.source_level_db=220 "
    "--set sonar.elevation_shape=sector --set sonar.elevation_width_deg=170 --set sonar.side_lobe_db=0 ";

// A strip holds 17 beams x 89 cells: one standard deviation is 0.11 dB.
TEST_F(Levels, flat_bottom_has_the_closed_form_level_from_5_to_40_m) {
  have("plane.ply", "make-scene plane --size 60,40 --points 600000 --mu-db -27");
  succeed("ping plane.ply -o out --range 4:41" + bottom_ping);
  const Cube c = cube_of("out");
  const auto lambert = [](double sine) { return power_from_db(-27) * sine * sine; };
  for (const double strip : {5.0, 10.0, 20.0, 40.0})
    EXPECT_NEAR(excess_over_bottom(c, strip, lambert), 0, 0.5) << strip << " m";
}

// Expected levels of each law, at grazing angles of 49, 30 and 17 degrees, against the law itself: without speckle.
TEST_F(Levels, flat_bottoms_have_the_levels_of_their_laws) {
  have("plane.ply", "make-scene plane --size 60,40 --points 600000 --mu-db -27");
  write("laws.toml",
        "schema = 1\n[[material]]\nname = \"bed\"\nlike = \"medium-sand\"\n"
        "[[material]]\nname = \"slope\"\nlike = \"fine-sand@small_slope\"\n"
        "[[material]]\nname = \"wall\"\nlike = \"concrete@rough\"\nslope = 0.3\nmicro_roughness_mm = 0.5\n"
        "[[material]]\nname = \"measured\"\nlaw = \"table\"\nincidence_deg = [0, 45, 80]\n"
        "frequency_khz = [300, 500]\nsigma_db = [-10, -20, -35, -12, -18, -33]\n");
  for (const SourcedMaterial& m : load_materials(path("laws.toml")).materials) {
    const std::string& name = m.material.name;
    succeed("ping plane.ply --method incoherent --materials laws.toml --material " + name + " -o " + name +
            " --range 3.2:11 --set sonar.centre_frequency_hz=400e3 --set sonar.min_range_m=1" + bottom_ping);
    const Cube c = cube_of(name);
    const auto surface = surface_of(m.material, 400e3, c.sound_speed);
    for (const double strip : {4.0, 6.0, 10.0})
      EXPECT_NEAR(excess_over_bottom(c, strip, [&](double sine) { return sine * surface->back(sine); }), 0, 0.2)
          << name << " " << strip << " m";
    const std::string notes = manifest_of(name)["notes"].dump();
    EXPECT_EQ(notes.find("may be off by") != notes.npos, name == "bed" || name == "slope") << notes;
  }
}

// Refuses words and tables that are no material, with a sentence for each.
TEST_F(Levels, materials_that_are_none_are_refused) {
  have("small.ply", "make-scene plane --points 500");
  const std::string ping = "ping small.ply --sonar p900-45 --pose=0,0,3,0,0,0 -o no --material ";
  expect_refused(ping + "medium-sant", 2, {"did you mean 'medium-sand'"});
  const auto refused = [&](const std::string& keys, const std::string& text) {
    write("bad.toml", "schema = 1\n[[material]]\nname = \"x\"\n" + keys);
    expect_refused(ping + "x --materials bad.toml", 3, {"bad.toml:", text});
  };
  const std::string rough = "law = \"rough\"\nslope = 0.2\n", sand = "like = \"medium-sand\"\n";
  refused("like = \"fine-sant@seabed\"\n", "4: like: material 'fine-sant@seabed' is unknown; did you mean");
  refused(rough + "reflection = 0.9\ndiffuse_mu_db = -6\n", "of the power that falls in at");
  refused(rough, "needs either density");
  refused(rough + "reflection = 1\nloss = 0.01\n", "7: law 'rough' of material 'x' has no loss");
  refused("law = \"seabed\"\n", "2: missing key 'material.density_ratio' of law 'seabed'");
  refused("law = \"sea\"\n", "must be one of lambert, seabed, small_slope, rough, ellis_crowe, table");
  refused("law = \"table\"\nincidence_deg = [0]\nsigma_db = [-20]\n", "incidence has 1 angles, must have 2 or more");
  refused(sand + "lambert_mu_db = -20\n", "has no use beside law 'seabed'");
  refused(sand + "relief_slope = 0.1\n", "has slopes of its own");
}

// The harbour with laws of its own, as a file and as tiles; `info` names them, and pings of both are the same.
TEST_F(Levels, scenes_keep_their_laws) {
  succeed("make-scene harbour --points 6000 --materials natural -o natural.ply -q");
  succeed("prepare natural.ply -o natural.tiles -q");
  for (const char* scene : {"natural.ply", "natural.tiles"}) {
    EXPECT_THAT(succeed(std::string("info --json ") + scene), HasSubstr("\"law\": \"seabed\"")) << scene;
    succeed(std::string("ping ") + scene + " -o of_" + scene + " --sonar p900-45 --pose=0,0,-3,0,20,0 --no-picture -q");
  }
  EXPECT_EQ(read("of_natural.ply/cube.h5"), read("of_natural.tiles/cube.h5"));
}

TEST_F(Levels, materials_lists_explains_and_draws) {
  const std::string all = succeed("materials");
  for (const char* name : {"medium-sand@seabed", "medium-sand@small_slope", "rough-rock@seabed", "concrete@rough"})
    EXPECT_THAT(all, HasSubstr(name));
  const std::string sand = succeed("materials medium-sand -o sand.png");
  EXPECT_THAT(sand, HasSubstr("TR 9407"));
  EXPECT_THAT(sand, HasSubstr("may be off by 5 dB"));
  EXPECT_GT(std::filesystem::file_size(path("sand.png")), 5000U);
  EXPECT_THAT(succeed("materials concrete@rough --toml"), HasSubstr("law = \"rough\""));
  expect_refused("materials -o all.png", 2, {"needs the name"});
}

// SPDX-License-Identifier: BSD-3-Clause
// A flat Lambert bottom, and the materials that ship with insonify against handbook values.
#include "acoustics/direct_echoes.hpp"
#include "acoustics/reflection.hpp"
#include "speckle_bench.hpp"
#include "store/materials_file.hpp"
#include "support/test.hpp"

using namespace insonify::laws;

namespace {

constexpr double height = 3, bandwidth = 29.5e3;
const Medium sea{speed, {0.2994626 * nepers_per_db, 0, 0}};  // Francois and Garrison, 900 kHz, 10 deg C, 35 psu

/// Returns an array exactly one degree wide at broadside: L = 0.442946 lambda / sin(0.5 deg) = 50.76 wavelengths.
LineArray array_of_one_degree() {
  const std::size_t n = 101;
  return {0.442946 * wavelength / std::sin(radians(0.5)) / n, std::vector<double>(n, 1.0)};
}

/// Returns RL = SL - 40 log r - 2 a r + 10 log mu + 20 log(h/r) + 10 log[(lambda/L) r^2 / sqrt(r^2 - h^2) c tau_e / 2],
/// tau_e = 0.469719 / B.
double closed_form_db(double r) {
  const double length = 0.442946 / std::sin(radians(0.5));
  const double cell = r * r / std::sqrt(r * r - height * height) / length * speed * 0.469719 / bandwidth / 2;
  return 220 - 40 * std::log10(r) - 2 * 0.2994626 * r - 27 + 20 * std::log10(height / r) + db_from_power(cell);
}

/// Returns a strip of the bottom 0.12 m long about slant range r, as wide as the array's first forty side lobes.
SceneCloud strip(double r) {
  SceneCloud scene;
  const double x = std::sqrt(r * r - height * height), length = 0.12, half_width = std::min(x, 0.4 * r);
  const int nx = 96, ny = 1200;
  const double dx = length / nx, dy = 2 * half_width / ny;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {  // rows of constant range: arcs of a circle about the point below the head
      const double y = (j + 0.5) * dy - half_width, out = x + (i + 0.5) * dx - length / 2;
      // The area between two arcs is out / sqrt(out^2 - y^2) times that of a straight strip.
      const double ahead = std::sqrt(out * out - y * y);
      if (!(ahead > 0.3 * out)) continue;
      add_surfel(scene, {ahead, y, -height}, {0, 0, 1}, dx * dy * out / ahead);
    }
  return scene;
}

/// Returns the sum of the patches' powers at range r of the beam ahead, each with beam and pulse [dB re 1 uPa].
double incoherent_level_db(double r) {
  SonarHead head = head_with(array_of_one_degree(), {0}, bandwidth, {r - 0.1, r + 0.1, 0.01});
  head.fan.beam_width = radians(80);  // the margin that is sampled beside the beam
  const SceneCloud scene = strip(r);
  const Scatterers s = visible(scene, head, Pose::Identity());
  const Echoes echoes = direct_echoes(s, scene.materials, head.pulse, sea, {.amplitude = SurfaceAmplitude::coherent});
  double power = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const EchoEnvelope envelope = echo_envelope(head.pulse, sea.absorption, s.range[i]);
    power += std::norm(echoes.amplitude[i] * envelope.at(2 * r / speed - echoes.delay[i]) *
                       array_response(head.array, wavelength, echoes.u[i], 0).real());
  }
  return pressure_level_db(std::sqrt(power));
}

const Material& shipped(const MaterialTable& table, const std::string& name) {
  for (const SourcedMaterial& m : table.materials)
    if (m.material.name == name) return m.material;
  throw std::runtime_error("no material " + name);
}

MaterialTable shipped_materials() { return load_materials(INSONIFY_DATA "/materials.toml"); }

}  // namespace

// SL 220 dB, h 3 m, 10 log mu -27 dB, 1 degree, 29.5 kHz, 900 kHz: 129.28, 110.47, 89.28 and 62.21 dB at 5, 10, 20
// and 40 m. The sum over patches holds the pattern and the pulse instead of their widths: 0.1 dB.
TEST(BottomLaws, flat_lambert_bottom_falls_by_50_log_r_with_its_conical_term) {
  const struct { double range, level_db; } expected[] = {{5, 129.28}, {10, 110.47}, {20, 89.28}, {40, 62.21}};
  for (const auto& e : expected) {
    EXPECT_NEAR(closed_form_db(e.range), e.level_db, 0.02) << e.range << " m";
    EXPECT_NEAR(incoherent_level_db(e.range), closed_form_db(e.range), 0.1) << e.range << " m";
  }
  // Without the cone r^2 / sqrt(r^2 - h^2) the cell at 5 m is 0.97 dB too small.
  EXPECT_NEAR(db_from_power(5 / 4.0), 0.97, 0.005);
  // 40 log r of spreading and 20 log r of the grazing angle, less 10 log r of the cell.
  EXPECT_NEAR(closed_form_db(300) - closed_form_db(3000) - 2 * 0.2994626 * 2700, 50, 0.01);
}

// Normal reflection coefficients of the sediments of APL-UW TR 9407 (1994), from density and sound speed ratio.
TEST(BottomLaws, sediments_of_the_handbook_reflect_as_tabulated_at_normal_incidence) {
  const struct {
    const char* name;
    double density, speed_ratio, reflection;
  } sediments[] = {{"rock", 2.5, 2.5, 0.724},
                   {"gravel", 2.5, 1.8, 0.636},
                   {"sandy gravel", 2.492, 1.337, 0.538},
                   {"coarse sand", 2.231, 1.2503, 0.472},
                   {"medium sand", 1.845, 1.1782, 0.370},
                   {"fine sand", 1.451, 1.1073, 0.233},
                   {"coarse silt", 1.195, 1.0179, 0.098},
                   {"medium silt", 1.149, 0.9885, 0.064},
                   {"clay", 1.145, 0.980, 0.057}};
  for (const auto& s : sediments) {
    FlatBottom bottom;
    bottom.density_ratio = s.density;
    bottom.sound_speed_ratio = s.speed_ratio;
    bottom.loss = 0;
    EXPECT_NEAR(std::abs(bottom_reflection(bottom, pi / 2)), s.reflection, 6e-4) << s.name;
  }
}

// Lambert equivalents of the TR 9407 model at 100 kHz and 30 degrees of grazing; its limit is 1 / pi, -4.97 dB.
TEST(BottomLaws, shipped_sea_beds_are_the_lambert_equivalents_of_the_handbook_model) {
  const MaterialTable table = shipped_materials();
  const struct {
    const char* name;
    double mu_db;
  } beds[] = {{"rough-rock", -4.97},  {"gravel", -7.8}, {"sandy-gravel", -11.5},
              {"coarse-sand", -14.1}, {"sand", -16.6},  {"fine-sand", -18.6},
              {"coarse-silt", -20.4}, {"silt", -23.9},  {"clay", -24.0}};
  for (const auto& bed : beds)
    EXPECT_NEAR(db_from_power(shipped(table, bed.name).lambert_mu), bed.mu_db, 0.1) << bed.name;
}

// Upper bound of a fully diffuse surface, |R|^2 / pi; R of handbook impedances in water of 1026 kg/m^3 and 1500 m/s.
TEST(BottomLaws, shipped_hard_materials_are_their_normal_reflectivity_over_pi) {
  const MaterialTable table = shipped_materials();
  const struct {
    const char* name;
    double reflection;
  } hard[] = {{"steel", 0.936},     {"titanium", 0.893},     {"aluminium", 0.835}, {"granite", 0.809},
              {"glass", 0.803},     {"concrete", 0.705},     {"ice", 0.392},       {"pvc", 0.362},
              {"acrylic", 0.357},   {"polyethylene", 0.194}, {"wood", 0.07},       {"rubber", 0.02},
              {"fibreglass", 0.519}};
  for (const auto& h : hard)
    EXPECT_NEAR(db_from_power(shipped(table, h.name).lambert_mu), db_from_power(h.reflection * h.reflection / pi), 0.03)
        << h.name;
  EXPECT_NEAR(shipped(table, "steel").lambert_mu, 0.279, 0.0006);
  EXPECT_NEAR(shipped(table, "concrete").lambert_mu, 0.158, 0.0006);
  EXPECT_NEAR(shipped(table, "pvc").lambert_mu, 0.042, 0.0006);
}

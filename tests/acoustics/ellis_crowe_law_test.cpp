// SPDX-License-Identifier: BSD-3-Clause
// The law against its published form in angles, and against facets of a solid in Kirchhoff's limit.
#include "acoustics/surface_laws.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "support/errors.hpp"
#include "support/test.hpp"

namespace insonify::ellis_crowe_law_tests {

constexpr double water_speed = 1500, frequency = 1e5;

// The law of Ellis and Crowe in their variables: grazing angles of incidence and scattering, and the turn between their
// azimuths, 0 for forward.
double published(const EllisCroweLaw& law, double grazing_in, double grazing_out, double turn) {
  using std::cos, std::sin;
  const double across = cos(grazing_in) * cos(grazing_in) + cos(grazing_out) * cos(grazing_out) -
                        2 * cos(grazing_in) * cos(grazing_out) * cos(turn);
  const double tilt = across / std::pow(sin(grazing_in) + sin(grazing_out), 2);
  return law.diffuse_mu * sin(grazing_in) * sin(grazing_out) +
         law.facet_strength * (1 + tilt) * (1 + tilt) * std::exp(-tilt / (2 * law.facet_slope * law.facet_slope));
}

TEST(EllisCroweLaw, is_the_published_one) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const auto u = random_uniform(7, RandomStage::scene_points, {k, 0, 0});
    const auto v = random_uniform(7, RandomStage::scene_points, {k, 1, 0});
    const EllisCroweLaw law{.diffuse_mu = 0.05 * u[0], .facet_strength = u[1], .facet_slope = 0.05 + 0.5 * u[2]};
    const double in = 0.01 + 1.55 * u[3], out = 0.01 + 1.55 * v[0], turn = 2 * pi * v[1];
    // The sound comes from azimuth 180 degrees and goes on to `turn`: the directions are 180 degrees apart if it is 0.
    const double between = std::sin(in) * std::sin(out) - std::cos(in) * std::cos(out) * std::cos(turn);
    const double expected = published(law, in, out, turn);
    EXPECT_NEAR(surface_of(law, frequency, water_speed)->cross_section({std::sin(in), std::sin(out), between}),
                expected, 1e-9 * expected + 1e-300);
  }
}

// Evaluated by hand from the published form: mu = -27 dB, nu = 0.1 / sr, sigma = tan 10 degrees.
TEST(EllisCroweLaw, has_known_backscatter) {
  const auto surface = surface_of(EllisCroweLaw{.diffuse_mu = std::pow(10, -2.7)}, frequency, water_speed);
  const auto level_db = [&](double grazing_deg) {
    const double sine = std::sin(radians(grazing_deg));
    return db_from_power(surface->back(sine) * sine);
  };
  EXPECT_NEAR(level_db(90), -9.914, 0.01);   // nu + mu = 0.1020
  EXPECT_NEAR(level_db(80), -11.777, 0.01);  // nu / sin^4 exp(-1 / 2) + mu sin^2
  EXPECT_NEAR(level_db(45), -30.010, 0.01);  // the facets are down to 4e-8
  EXPECT_NEAR(level_db(20), -36.319, 0.01);
}

// Its nu is R^2 / (8 pi sigma^2) for facets of reflection R. Law rough has the same facets, in part in shadow.
TEST(EllisCroweLaw, is_law_rough_without_shadows) {
  const RoughLaw rough{.slope = 0.2, .reflection = 0.4};
  const double sigma = rough.slope / std::sqrt(2);
  const EllisCroweLaw law{.diffuse_mu = 0, .facet_strength = 0.16 / (8 * pi * sigma * sigma), .facet_slope = sigma};
  const auto one = surface_of(law, frequency, water_speed), other = surface_of(rough, frequency, water_speed);
  for (const double cosine : {1.0, 0.98, 0.95, 0.9})
    EXPECT_NEAR(one->back(cosine) / other->back(cosine), 1, 1e-3) << cosine;
  EXPECT_NEAR(one->lobe_slope(), other->lobe_slope(), 1e-12);
  EXPECT_NEAR(albedo(*one, 1), 0.16, 0.005);
}

TEST(EllisCroweLaw, is_a_law_of_files) {
  const SurfaceLaw law = EllisCroweLaw{.diffuse_mu = 0.003, .facet_strength = 0.2, .facet_slope = 0.1};
  EXPECT_EQ(law_to_text(law), "ellis_crowe diffuse_mu=0.003 facet_strength=0.2 facet_slope=0.1");
  EXPECT_EQ(law_from_text(law_to_text(law)), law);
  EXPECT_TRUE(traits_of(law).own_slopes);
  EXPECT_THAT(error_of([] { surface_of(EllisCroweLaw{.facet_slope = 0.001}, frequency, water_speed); }),
              testing::HasSubstr("facet_slope = 0.001, must be within 0.02 and 1"));
  EXPECT_THAT(error_of([] { require_energy({.name = "mirror", .law = EllisCroweLaw{.facet_strength = 3}}, "here"); }),
              testing::HasSubstr("material 'mirror' sends back 2."));
}

}  // namespace insonify::ellis_crowe_law_tests

// SPDX-License-Identifier: BSD-3-Clause
#include "returns/find_contributors.hpp"

#include <tuple>

#include "beamforming/head_patterns.hpp"
#include "support/test.hpp"

namespace insonify::find_contributors_tests {

const Medium medium{1500, {0.02, 0, 0}};

/// Returns a head at 600 kHz, 11 beams over 40 degrees, bins of 1 cm from 2 m to 4 m.
SonarHead contributor_head() {
  SonarHead head;
  head.pulse = {600e3, 30e3, 200};
  head.array = array_for_beam_width(radians(3), 1500 / 600e3, Shading::taylor, -30);
  head.fan = make_fan(11, radians(40), radians(3), radians(30));
  head.gate = {2, 4, 0.01};
  return head;
}

/// Echoes of surfels, put together by hand.
struct SurfelSet {
  SceneCloud scene;
  Echoes echoes;
  std::vector<std::uint32_t> surfel;
  std::vector<LegPair> legs;

  /// Adds a surfel named 100, 101 ..., of material 0, 1, 2, 0 ...
  std::uint32_t add_surfel() {
    const auto i = static_cast<std::uint32_t>(scene.size());
    scene.point.emplace_back(0, 0, 0), scene.normal.emplace_back(1, 0, 0), scene.area.push_back(1);
    scene.material.push_back(static_cast<std::uint16_t>(i % 3)), scene.id.push_back(100 + i);
    return i;
  }
  void add(std::uint32_t of, double range, double azimuth, double elevation, std::complex<double> amplitude,
           LegPair by = {}) {
    echoes.delay.push_back(2 * range / medium.sound_speed);
    echoes.u.push_back(std::cos(elevation) * std::sin(azimuth)), echoes.v.push_back(std::sin(elevation));
    echoes.amplitude.push_back(amplitude);
    surfel.push_back(of), legs.push_back(by);
  }
  std::vector<SurfelEchoes> parts() const { return {{echoes, surfel, legs}}; }
  Contributors find(const SonarHead& head, const ContributorOptions& options = {}) const {
    return find_contributors(scene, parts(), head, medium, options);
  }
};

/// Returns surfels of several parts over the fan and a little beyond, some with bounced paths, in random order; `size`
/// [rad].
SurfelSet random_echoes(unsigned seed, bool doppler = false, int surfels = 60, int parts = 5, double size = 0.02) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> even(-1, 1);
  std::normal_distribution<double> normal;
  SurfelSet set;
  for (int s = 0; s < surfels; ++s) set.add_surfel();
  for (int p = 0; p < parts; ++p)
    for (std::uint32_t s = 0; s < set.scene.size(); ++s) {
      std::mt19937 own(seed + s);
      const double range = 3 + 1.1 * even(own), azimuth = 0.4 * even(own), elevation = 0.2 * even(own);
      set.add(s, range + 0.01 * even(random), azimuth + size * even(random), elevation + size * even(random),
              {normal(random), normal(random)});
      if (s % 4 == 0) set.add(s, range + 0.02, azimuth, 0.3, {normal(random), 0}, {0, 1});
      if (s % 8 == 0) set.add(s, range + 0.04, azimuth, 0.3, {normal(random), 0}, {1, 1});
    }
  if (doppler)
    for (std::size_t i = 0; i < set.echoes.size(); ++i) set.echoes.doppler.push_back(300 * even(random));
  return set;
}

using Key = std::tuple<std::uint32_t, std::uint8_t, std::uint8_t>;

/// Returns the energy of every echo in every pixel, with the whole pulse and the array summed element by element (E63).
std::map<Key, double> energies_at(const SurfelSet& h, const SonarHead& head, std::size_t beam, std::size_t bin) {
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const double u_beam = std::cos(head.fan.elevation[beam]) * std::sin(head.fan.azimuth[beam]);
  const bool rows = head.column || fan_rows(head.fan).size() > 1;
  const EchoShapes shapes(head.pulse, medium);
  RowResponse row(head, wavelength, head.fan.elevation[beam]);
  std::map<Key, double> energies;
  for (std::size_t i = 0; i < h.echoes.size(); ++i) {
    const double response =
        array_response(head.array, wavelength, h.echoes.u[i], u_beam).real() * (rows ? row.at(h.echoes.v[i]) : 1);
    const double t = 2 * head.gate.centre(bin) / medium.sound_speed - h.echoes.delay[i];
    const double energy =
        std::norm(h.echoes.amplitude[i] * response * shapes.of(h.echoes.delay[i], h.echoes.doppler_of(i)).at(t));
    energies[{h.surfel[i], h.legs[i].out, h.legs[i].back}] += energy;
  }
  return energies;
}

/// Compares every listed contributor of every pixel with the reference. The floor of -120 dB omits parts of
/// contributors of at most some 10^2 in energy.
void expect_as_referee(const SurfelSet& set, const SonarHead& head) {
  const ContributorOptions options{.per_pixel = 3, .floor_db = -120};
  const Contributors c = set.find(head, options);
  std::size_t checked = 0;
  for (std::size_t b = 0; b < c.beams; ++b)
    for (std::size_t n = 0; n < c.bins; n += 3) {
      const auto energies = energies_at(set, head, b, n);
      double total = 0;
      std::vector<std::pair<double, Key>> sorted;
      for (const auto& [key, energy] : energies) total += energy, sorted.emplace_back(energy, key);
      std::sort(sorted.rbegin(), sorted.rend());
      if (sorted[0].first < 1e-3) continue;  // the table's error of 2e-5 of peaks of about 10 shows
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t at = c.at(b, n, k);
        const double share = sorted[k].first / total;
        ASSERT_NEAR(c.share[at], share, 2e-3) << "beam " << b << " bin " << n << " k " << k;
        const bool distinct = (k == 0 || sorted[k - 1].first - sorted[k].first > 4e-3 * total) &&
                              sorted[k].first - sorted[k + 1].first > 4e-3 * total;
        if (!distinct) continue;
        const auto [surfel, out, back] = sorted[k].second;
        ASSERT_EQ(c.surfel[at], surfel) << "beam " << b << " bin " << n << " k " << k;
        ASSERT_EQ(c.id[at], 100 + surfel);
        ASSERT_EQ(c.material[at], surfel % 3);
        ASSERT_EQ(static_cast<int>(c.path[at]), (out > 0) + (back > 0));
        ++checked;
      }
    }
  EXPECT_GT(checked, 200U);
}

TEST(FindContributors, agrees_with_every_echo_against_every_pixel) {
  for (const unsigned seed : {1U, 2U, 3U}) expect_as_referee(random_echoes(seed), contributor_head());
}

// Many parts close together, represented by a few directions.
TEST(FindContributors, agrees_with_the_referee_for_surfels_of_many_parts) {
  expect_as_referee(random_echoes(10, false, 25, 50, 0.003), contributor_head());
  SonarHead head = contributor_head();
  head.fan.elevation_width = radians(10);
  for (std::size_t b = 0; b < 6; ++b) head.fan.elevation[b] = radians(-8);
  expect_as_referee(random_echoes(11, false, 25, 50, 0.003), head);
}

TEST(FindContributors, agrees_with_the_referee_for_a_sweep_with_doppler) {
  SonarHead head = contributor_head();
  head.pulse.shape = PulseShape::linear_fm;
  head.pulse.duration = 1e-3;
  expect_as_referee(random_echoes(4, true), head);
}

TEST(FindContributors, agrees_with_the_referee_for_rows_and_for_a_planar_array) {
  SonarHead head = contributor_head();
  const BeamFan below = make_fan(11, radians(40), radians(3), radians(10), radians(-8));
  head.fan.elevation_width = radians(10);
  head.fan.azimuth.insert(head.fan.azimuth.end(), below.azimuth.begin(), below.azimuth.end());
  head.fan.elevation.insert(head.fan.elevation.end(), below.elevation.begin(), below.elevation.end());
  expect_as_referee(random_echoes(5), head);
  head.column = array_for_beam_width(radians(6), 1500 / 600e3, Shading::uniform, 0);
  head.fan.row_width = radians(6);
  expect_as_referee(random_echoes(6), head);
}

// Elements two wavelengths apart have a grating lobe at u = 0.5 as high as the main lobe.
TEST(FindContributors, includes_grating_lobes) {
  SonarHead head = contributor_head();
  head.array = {2 * 1500 / 600e3, std::vector<double>(16, 1.0)};
  head.fan = make_fan(1, 0, radians(3), radians(30));
  SurfelSet set;
  set.add(set.add_surfel(), 3, std::asin(0.5), 0, 1);
  set.add(set.add_surfel(), 3, std::asin(0.25), 0, 100);  // in a null
  const Contributors c = set.find(head, {.floor_db = -20});
  EXPECT_EQ(c.surfel[c.at(0, 100)], 0U);
}

TEST(FindContributors, shares_of_a_pixel_add_up_to_one_when_all_are_listed) {
  const Contributors c = random_echoes(7).find(contributor_head(), {.per_pixel = 90});
  for (std::size_t pixel = 0; pixel < c.beams * c.bins; ++pixel) {
    double sum = 0;
    for (std::size_t k = 0; k < 90; ++k) {
      const std::size_t at = pixel * 90 + k;
      sum += c.share[at];
      EXPECT_EQ(c.surfel[at] == Contributors::none, c.share[at] == 0);
      if (k > 0) {
        EXPECT_LE(c.share[at], c.share[at - 1]);
      }
    }
    if (c.surfel[pixel * 90] != Contributors::none) {
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
}

TEST(FindContributors, a_single_target_is_listed_where_it_contributes_and_nowhere_else) {
  SurfelSet set;
  set.add_surfel();
  const SonarHead head = contributor_head();
  set.add(set.add_surfel(), 3.005, head.fan.azimuth[7], radians(-5), {0, 2});
  const Contributors c = set.find(head);
  const std::size_t at = c.at(7, 100);  // its centre is 3.005 m
  EXPECT_EQ(c.surfel[at], 1U);
  EXPECT_EQ(c.id[at], 101U);
  EXPECT_EQ(c.material[at], 1U);
  EXPECT_EQ(c.path[at], PathKind::direct);
  EXPECT_FLOAT_EQ(c.share[at], 1);
  EXPECT_NEAR(c.elevation[at], radians(-5), 1e-6);
  EXPECT_EQ(c.surfel[at + 1], Contributors::none);
  EXPECT_EQ(c.share[at + 1], 0);
  EXPECT_EQ(c.surfel[c.at(7, 120)], Contributors::none);  // 20 cm farther
  EXPECT_EQ(c.material[c.at(7, 120)], Contributors::no_material);
}

// Range and bearing do not distinguish them: layover.
TEST(FindContributors, two_targets_of_one_cell_at_different_elevations_are_both_listed) {
  SurfelSet set;
  set.add(set.add_surfel(), 3.005, 0, radians(10), 1);
  set.add(set.add_surfel(), 3.005, 0, radians(-20), {0, 2});
  const Contributors c = set.find(contributor_head());
  const std::size_t at = c.at(5, 100);
  EXPECT_EQ(c.surfel[at], 1U);
  EXPECT_EQ(c.surfel[at + 1], 0U);
  EXPECT_NEAR(c.share[at], 0.8, 1e-4);
  EXPECT_NEAR(c.share[at + 1], 0.2, 1e-4);
  EXPECT_NEAR(c.elevation[at], radians(-20), 1e-6);
  EXPECT_NEAR(c.elevation[at + 1], radians(10), 1e-6);
}

// Four parts of the first surfel, each weaker than the only one of the second.
TEST(FindContributors, parts_of_a_surfel_count_together) {
  SurfelSet set;
  set.add_surfel(), set.add_surfel();
  for (int p = 0; p < 4; ++p) set.add(0, 3.005, 0, 0, std::polar(1.0, 1.5 * p));
  set.add(1, 3.005, 0, 0, std::sqrt(3.0));
  const Contributors c = set.find(contributor_head());
  EXPECT_EQ(c.surfel[c.at(5, 100)], 0U);
  EXPECT_NEAR(c.share[c.at(5, 100)], 4.0 / 7, 1e-4);
}

TEST(FindContributors, paths_of_one_surfel_are_separate_contributors) {
  SurfelSet set;
  set.add_surfel();
  set.add(0, 3.005, 0, 0, 3);
  set.add(0, 3.005, 0, radians(30), 2, {0, 1});
  set.add(0, 3.005, 0, radians(31), 1, {1, 1});
  const Contributors c = set.find(contributor_head());
  const std::size_t at = c.at(5, 100);
  EXPECT_EQ(c.path[at], PathKind::direct);
  EXPECT_EQ(c.path[at + 1], PathKind::one_bounce);
  EXPECT_EQ(c.path[at + 2], PathKind::two_bounces);
  EXPECT_NEAR(c.elevation[at + 1], radians(30), 1e-6);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(c.surfel[at + k], 0U);
}

// A sea bed of mud to port and rock to starboard: high beams (port) show mud.
TEST(FindContributors, label_images_put_materials_at_their_bearing) {
  SurfelSet set;
  for (int i = 0; i < 81; ++i)
    for (int j = 0; j < 40; ++j) {
      const std::uint32_t s = set.add_surfel();
      const double azimuth = radians(0.5) * (i - 40);
      set.scene.material[s] = azimuth > radians(5) ? 2 : 1;
      set.add(s, 2.5 + 0.02 * j, azimuth, radians(-20), 1);
    }
  SonarHead head = contributor_head();
  const Contributors c = set.find(head);
  const auto materials = material_image(c);
  const auto ids = id_image(c);
  for (int b = 0; b < 11; ++b) {
    // On the cone of the beam, the boundary is seen at its own direction cosine.
    const double u = std::sin(head.fan.azimuth[static_cast<std::size_t>(b)]);
    const double boundary = std::cos(radians(20)) * std::sin(radians(5.25));
    EXPECT_EQ(materials(b, 80), u > boundary ? 2 : 1) << b;
    EXPECT_EQ(ids(b, 80), c.id[c.at(static_cast<std::size_t>(b), 80)]);
    EXPECT_EQ(materials(b, 5), Contributors::no_material);
    EXPECT_EQ(ids(b, 5), Contributors::none);
  }
}

TEST(FindContributors, does_not_depend_on_threads) {
  const SurfelSet set = random_echoes(8);
  const Contributors one = set.find(contributor_head(), {.threads = 1});
  for (const int threads : {2, 7}) {
    const Contributors many = set.find(contributor_head(), {.threads = threads});
    EXPECT_EQ(one.surfel, many.surfel);
    EXPECT_EQ(one.share, many.share);
    EXPECT_EQ(one.elevation, many.elevation);
  }
}

TEST(FindContributors, of_no_echoes_are_none) {
  const Contributors c = SurfelSet().find(contributor_head());
  EXPECT_EQ(c.beams, 11U);
  EXPECT_EQ(c.bins, 200U);
  for (const std::uint32_t s : c.surfel) EXPECT_EQ(s, Contributors::none);
}

TEST(FindContributors, refuses_invalid_arguments) {
  SurfelSet set = random_echoes(9);
  const SonarHead head = contributor_head();
  EXPECT_EQ(error_of([&] { set.find(head, {.per_pixel = 0}); }),
            "find_contributors: per_pixel = 0, must be within 1 and 255");
  EXPECT_EQ(error_of([&] { set.find(head, {.per_pixel = 256}); }),
            "find_contributors: per_pixel = 256, must be within 1 and 255");
  EXPECT_EQ(error_of([&] { set.find(head, {.floor_db = 0}); }),
            "find_contributors: floor_db = 0 dB, must be within -200 and 0");
  // 11 x 200 pixels x (31 x 255 + 16) bytes
  EXPECT_EQ(error_of([&] { set.find(head, {.per_pixel = 255, .max_mib = 10}); }),
            "find_contributors: 11 beams x 200 bins x 255 contributors take 17 MiB, must be at most 10; keep fewer "
            "contributors, or make the range gate shorter");
  set.echoes.amplitude[17] = std::nan("");
  EXPECT_THAT(error_of([&] { set.find(head); }), HasSubstr("echo 17 is not finite"));
  set.surfel[3] = 60;
  EXPECT_EQ(error_of([&] { set.find(head); }), "find_contributors: surfel[3] = 60, but the scene has 60");
  set.surfel.pop_back();
  EXPECT_THAT(error_of([&] { set.find(head); }), HasSubstr("give one of each"));
}

}  // namespace insonify::find_contributors_tests

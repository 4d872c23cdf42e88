// SPDX-License-Identifier: BSD-3-Clause
// Layers, maps and labels of a cube, and how many bits of pressures it keeps.
#include "store/random_cube.hpp"
#include "store/raw_file.hpp"

TEST(CubeLayers, come_back_bit_for_bit_in_their_order) {
  Cube cube = random_cube(2);
  for (Ping& ping : cube.pings) ping.layers = {{"noise", ping.pressure * 0.5f}, {"direct", ping.pressure * 2.0f}};
  const Cube back = read_cube(write(cube));
  ASSERT_EQ(back.pings.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    ASSERT_EQ(back.pings[p].layers.size(), 2u);
    for (std::size_t l = 0; l < 2; ++l) {
      EXPECT_EQ(back.pings[p].layers[l].name, cube.pings[p].layers[l].name);
      EXPECT_TRUE((back.pings[p].layers[l].pressure == cube.pings[p].layers[l].pressure).all());
    }
  }
}

TEST(CubeMaps, come_back_bit_for_bit_with_their_holes) {
  Cube cube = random_cube(2);
  for (Ping& ping : cube.pings) {
    ping.intensity = ping.pressure.abs2();
    ping.split_phase = ping.pressure.arg();
    ping.split_phase(1, 2) = std::numeric_limits<float>::quiet_NaN();
    ping.unknown = (ping.pressure.real() > 0.3f).cast<std::uint8_t>();
    ping.expected_level = true;
  }
  const std::string path = write(cube);
  const Cube back = read_cube(path);
  for (std::size_t p = 0; p < 2; ++p) {
    const Ping &a = back.pings[p], &b = cube.pings[p];
    ASSERT_EQ(a.split_phase.size(), b.split_phase.size());
    ASSERT_EQ(a.unknown.size(), b.unknown.size());
    const std::size_t cells = static_cast<std::size_t>(b.unknown.size());
    EXPECT_EQ(std::memcmp(a.split_phase.data(), b.split_phase.data(), cells * sizeof(float)), 0);
    EXPECT_TRUE((a.intensity == b.intensity).all());
    EXPECT_EQ(std::memcmp(a.unknown.data(), b.unknown.data(), cells), 0);
    EXPECT_TRUE(a.expected_level);
  }
  const RawFile file(path);
  EXPECT_EQ(raw_extent(file, "/split_phase"), raw_extent(file, "/pressure"));
  EXPECT_EQ(raw_extent(file, "/unknown"), raw_extent(file, "/pressure"));
  EXPECT_EQ(raw_text(file, "/split_phase", "units"), "rad");
  EXPECT_EQ(raw_extent(file, "/intensity"), raw_extent(file, "/pressure"));
  EXPECT_EQ(raw_text(file, "/intensity", "units"), "Pa^2");
  EXPECT_EQ(raw_text(file, "/", "expected_level"), "expected level, no speckle");
}

TEST(CubeMaps, are_absent_unless_the_pings_have_them) {
  const std::string path = write(random_cube(1));
  const Ping back = read_cube(path).pings[0];
  EXPECT_EQ(back.split_phase.size(), 0);
  EXPECT_EQ(back.unknown.size(), 0);
  EXPECT_FALSE(back.expected_level);
  const RawFile file(path);
  for (const char* name : {"/intensity", "/split_phase", "/unknown"}) EXPECT_EQ(H5Lexists(file, name, H5P_DEFAULT), 0);
  EXPECT_EQ(H5Aexists(file, "expected_level"), 0);
}

TEST(CubeLevels, of_display_cells_come_back_within_half_a_hundredth_of_a_decibel) {
  Cube cube = random_cube(2);
  for (Ping& ping : cube.pings) {
    ping.display_cells = true;
    ping.pressure = ping.pressure.abs().cast<std::complex<float>>();
    ping.pressure(3, 4) = 0;
    ping.layers = {{"direct", ping.pressure * 0.5f}};
  }
  const std::string path = write(cube);
  const Cube back = read_cube(path);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_TRUE(back.pings[p].display_cells);
    EXPECT_LE((level_db(back.pings[p]) - level_db(cube.pings[p])).abs().maxCoeff(), 0.0051f);
    EXPECT_EQ(back.pings[p].pressure(3, 4), std::complex<float>(0));
    const float ratio = std::abs(back.pings[p].layers[0].pressure(1, 1) / cube.pings[p].layers[0].pressure(1, 1));
    EXPECT_NEAR(ratio, 1, 1e-3);
  }
  const RawFile file(path);
  EXPECT_EQ(H5Lexists(file, "/pressure", H5P_DEFAULT), 0);
  EXPECT_EQ(raw_extent(file, "/level").size(), 3u);
  EXPECT_EQ(raw_text(file, "/level", "units"), "dB re 1 uPa");
  EXPECT_EQ(raw_text(file, "/", "display_cells"), "mean intensity over the area of each cell, without phase");
  // Levels that are read and written again stay the same.
  EXPECT_TRUE((read_cube(write(back, "again.h5")).pings[1].pressure == back.pings[1].pressure).all());
  EXPECT_EQ(read_track(path).size(), 2u);
  EXPECT_THAT(error_with_kind([&] { read_beam(path, 0, 1, 0); }), HasSubstr("without --display"));
}

TEST(CubeMaps, must_be_the_same_in_every_ping) {
  const auto error_with = [](const auto& change) {
    Cube cube = random_cube(2);
    change(cube.pings[0], cube.pings[1]);
    return error_with_kind([&] { write(cube); });
  };
  const auto contains = [](const std::string& text, const char* part) { EXPECT_THAT(text, HasSubstr(part)) << text; };
  contains(error_with([](Ping&, Ping& b) { b.split_phase.setZero(70, 46); }),
           "split_phase of ping 41 has 70 x 46 cells, must be like that of ping 40: absent");
  contains(error_with([](Ping& a, Ping&) { a.unknown.setZero(70, 46); }),
           "unknown of ping 41 has 0 x 0 cells, must be like that of ping 40, one cell for each of its pressure");
  contains(error_with([](Ping&, Ping& b) { b.intensity.setZero(70, 46); }), "intensity of ping 41 has 70 x 46 cells");
  contains(error_with([](Ping& a, Ping&) { a.unknown.setZero(70, 45); }), "unknown of ping 40 has 70 x 45 cells");
  contains(error_with([](Ping&, Ping& b) { b.expected_level = true; }),
           "only one of pings 40 and 41 is an expected level");
  contains(error_with([](Ping&, Ping& b) { b.display_cells = true; }), "only one of pings 40 and 41 has display cells");
}

TEST(CubeMaps, of_another_type_or_extent_are_refused) {
  Cube cube = random_cube(2);
  for (Ping& ping : cube.pings) ping.split_phase.setZero(70, 46);
  const std::string path = write(cube);
  {
    const RawFile file(path);
    H5Lcreate_hard(file, "/split_phase", file, "/unknown", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: /unknown must be of uint8");
  {
    const RawFile file(path);
    H5Ldelete(file, "/unknown", H5P_DEFAULT);
    H5Lcreate_hard(file, "/pose", file, "/unknown", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: /unknown differs in extent from /pressure");
}

TEST(CubeLayers, must_be_the_same_in_every_ping) {
  Cube cube = random_cube(2);
  cube.pings[1].layers = {{"noise", cube.pings[1].pressure}};
  const std::string error = error_with_kind([&] { write(cube); });
  EXPECT_THAT(error, HasSubstr("ping 41 has other layers than ping 40")) << error;
}

TEST(CubeKeepBits, rounds_each_part_by_at_most_the_bound_and_makes_the_file_smaller) {
  Cube cube = random_cube(1);
  for (Ping& ping : cube.pings) ping.layers = {{"direct", ping.pressure * 2.0f}};
  std::uintmax_t before = std::filesystem::file_size(write(cube));
  for (const int bits : {23, 16, 12, 8, 1}) {
    cube.keep_bits = bits;
    const std::string path = write(cube, std::to_string(bits) + ".h5");
    const Cube back = read_cube(path);
    EXPECT_EQ(back.keep_bits, bits);
    float worst = 0;
    const auto compare = [&](const ComplexGridF& kept, const ComplexGridF& exact) {
      const auto error = [](float a, float b) { return std::abs(a - b) / std::abs(b); };
      for (Eigen::Index i = 0; i < exact.size(); ++i)
        worst = std::max({worst, error(kept(i).real(), exact(i).real()), error(kept(i).imag(), exact(i).imag())});
    };
    compare(back.pings[0].pressure, cube.pings[0].pressure);
    compare(back.pings[0].layers[0].pressure, cube.pings[0].layers[0].pressure);
    EXPECT_LE(worst, std::ldexp(1.0f, -bits)) << bits;
    const float bound =
        std::ldexp(1.0f, -bits);  // half a step, of numbers that are at least half a step above a power of 2
    EXPECT_GE(worst, 0.9f * bound / (1 + bound)) << bits;
    EXPECT_LT(std::filesystem::file_size(path), before) << bits;
    before = std::filesystem::file_size(path);
    // Rounding what is rounded changes nothing, so cubes may be merged and written again.
    Cube again = back;
    EXPECT_EQ(file_bytes(write(again, "again.h5")), file_bytes(path));
  }
}

TEST(CubeKeepBits, keeps_silence_infinities_and_all_bits_by_default) {
  Cube cube = random_cube(1);
  const float most = std::numeric_limits<float>::infinity();
  cube.pings[0].pressure(0, 0) = {0.0f, -0.0f};
  cube.pings[0].pressure(0, 1) = {most, -most};
  EXPECT_TRUE((read_cube(write(cube)).pings[0].pressure == cube.pings[0].pressure).all());
  EXPECT_EQ(read_cube(write(cube)).keep_bits, Cube::all_bits);
  cube.keep_bits = 9;
  const ComplexGridF back = read_cube(write(cube, "rounded.h5")).pings[0].pressure;
  EXPECT_EQ(back(0, 0), std::complex<float>(0, 0));
  EXPECT_TRUE(std::signbit(back(0, 0).imag()));
  EXPECT_EQ(back(0, 1), std::complex<float>(most, -most));
}

TEST(CubeKeepBits, out_of_range_is_refused) {
  Cube cube = random_cube(1);
  for (const int bits : {0, -1, 25}) {
    cube.keep_bits = bits;
    EXPECT_THAT(error_with_kind([&] { write_cube(own_path("bad.h5"), cube); }),
                testing::HasSubstr("keep_bits = " + std::to_string(bits) + ", must be within 1 and 24"));
  }
}

// Copied from where they are in the file; of 3000 beams the last chunk of 64 is not full.
TEST(CubeMaps, large_images_come_back_bit_for_bit) {
  Cube cube = random_cube(2, 3000);
  for (Ping& ping : cube.pings) {
    ping.layers = {{"direct", 2 * ping.pressure}, {"noise", -ping.pressure}};
    ping.intensity = ping.pressure.abs2();
  }
  for (const int bits : {Cube::all_bits, 20}) {
    cube.keep_bits = bits;
    const Cube back = read_cube(write(cube));
    for (std::size_t p = 0; p < 2; ++p) {
      const Ping &a = back.pings.at(p), &b = cube.pings[p];
      EXPECT_LE((a.pressure - b.pressure).abs().maxCoeff(), bits == 20 ? 1e-5F : 0.0F);
      EXPECT_TRUE((a.layers.at(0).pressure == 2 * a.pressure).all());
      EXPECT_TRUE((a.layers.at(1).pressure == -a.pressure).all());
      EXPECT_TRUE((a.intensity == b.intensity).all());
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// Tests coverage and bed of a survey as files.
#include "scene_io/coverage_file.hpp"

#include "scene_io/bed_of_returns.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/test.hpp"

namespace {

CoveredSurfel covered_surfel(std::uint32_t id, double intensity) {
  return {id, 1, {0.1 * id, 5e6 + id, -3}, 0.5F + 0.01F * static_cast<float>(id % 7), 4, intensity};
}

/// Returns every `step`th of 5000 surfels.
std::vector<CoveredSurfel> every(std::uint32_t step, double intensity) {
  std::vector<CoveredSurfel> covered;
  for (std::uint32_t id = step; id < 5000; id += step) covered.push_back(covered_surfel(id, intensity));
  return covered;
}

}  // namespace

TEST(CoverageFile, of_several_parts_is_that_of_their_sum) {
  const auto a = every(2, 1e-6), b = every(3, 3e-6), c = every(5, 0.1);
  save_coverage(own_path("a.ply"), a);
  save_coverage(own_path("b.ply"), b);
  save_coverage(own_path("c.ply"), c);
  join_coverage(own_path("all.ply"), {own_path("a.ply"), own_path("b.ply"), own_path("c.ply")});
  std::vector<CoveredSurfel> sum = a;
  add(sum, b);
  add(sum, c);
  save_coverage(own_path("sum.ply"), sum);
  EXPECT_EQ(file_bytes(own_path("all.ply")), file_bytes(own_path("sum.ply")));
  // Surfel 4992 belongs to a and b, 30 to all three.
  const std::string bytes = file_bytes(own_path("all.ply"));
  EXPECT_THAT(bytes.substr(0, 300), HasSubstr("property int scalar_pings"));
  const auto row = std::find_if(sum.begin(), sum.end(), [](const auto& s) { return s.id == 30; }) - sum.begin();
  std::uint32_t pings = 0;
  std::memcpy(&pings, bytes.data() + bytes.size() - 52 * (sum.size() - static_cast<std::size_t>(row)) + 44, 4);
  EXPECT_EQ(pings, 3U);
}

TEST(CoverageFile, of_one_part_is_that_part) {
  save_coverage(own_path("a.ply"), every(7, 1));
  join_coverage(own_path("all.ply"), {own_path("a.ply")});
  EXPECT_EQ(file_bytes(own_path("all.ply")), file_bytes(own_path("a.ply")));
}

TEST(CoverageFile, refuses_what_is_none) {
  save_coverage(own_path("a.ply"), every(7, 1));
  save_soundings(own_path("returns.ply"), {});
  expect_error(ErrorKind::content, {"returns.ply", "not the coverage of a survey"}, [] {
    join_coverage(own_path("all.ply"), {own_path("a.ply"), own_path("returns.ply")});
  });
  expect_error(ErrorKind::file, {"none.ply"}, [] { join_coverage(own_path("all.ply"), {own_path("none.ply")}); });
  expect_error(ErrorKind::argument, {"id = 3, must ascend"}, [] {
    save_coverage(own_path("b.ply"), {covered_surfel(3, 1), covered_surfel(3, 1)});
  });
  EXPECT_FALSE(file_exists(own_path("all.ply")));
}

TEST(BedOfReturns, is_the_surface_on_which_they_stand) {
  Soundings returns;
  for (int i = 0; i < 400; ++i) {
    returns.position.emplace_back(i % 20 * 0.5, i / 20 * 0.5, -5 + 0.1 * (i % 20 * 0.5));
    returns.level_db.push_back(90);
    returns.range.push_back(5);
  }
  returns.azimuth = returns.elevation = returns.range;
  returns.true_elevation = returns.range;
  returns.ping = returns.beam = returns.bin = returns.true_surfel = returns.true_material =
      std::vector<std::uint32_t>(400, 0);
  save_soundings(own_path("returns.ply"), returns);
  const BedSurface bed = bed_of_returns(own_path("returns.ply"), 1);
  for (double x = 1; x < 9; x += 0.7) EXPECT_NEAR(bed.at(x, 4.2), -5 + 0.1 * x, 0.03) << x;
  // Far above it a false alarm, which comes from no surfel.
  returns.position[210].z() = 500;
  returns.true_surfel[210] = Soundings::none;
  save_soundings(own_path("returns.ply"), returns);
  for (double x = 1; x < 9; x += 0.7)
    EXPECT_NEAR(bed_of_returns(own_path("returns.ply"), 1).at(x, 5.2), -5 + 0.1 * x, 0.06) << x;
  returns.true_surfel.assign(400, Soundings::none);
  save_soundings(own_path("noise.ply"), returns);
  expect_error(ErrorKind::content, {"noise.ply: holds no returns of surfels"},
               [] { bed_of_returns(own_path("noise.ply"), 1); });
  save_soundings(own_path("none.ply"), {});
  expect_error(ErrorKind::content, {"none.ply: holds no returns"}, [] { bed_of_returns(own_path("none.ply"), 1); });
}

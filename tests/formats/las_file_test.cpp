// SPDX-License-Identifier: BSD-3-Clause
#include "formats/las_file.hpp"

#include "formats/las_decoder.hpp"
#include "scene_io/load_scene.hpp"
#include "support/test.hpp"

namespace {

constexpr UtmZone las_zone{32, true};
const std::vector<LasPoint> las_points = {{{565432.1234, 5995123.4567, -20.0501}, 1777624200.5, 101.25F, 0.0125F, 7, 3},
                                          {{565400.5, 5995200.25, -18.75}, 1777624201, 133.5F, 0.5F, 70000, 399},
                                          {{565440, 5995100, -3}, 1777624202, -5, 0.25F, 9, 0}};

std::string las_bytes(const std::string& name) {
  const std::string path = own_path(name);
  LasFile file(path, las_zone, las_points[0].position);
  for (const LasPoint& point : las_points) file.add(point);
  file.finish();
  return file_bytes(path);
}

}  // namespace

// Read by the offsets of ASPRS LAS 1.4 R15, tables 3, 6, 7 and 24.
TEST(LasFile, holds_what_its_specification_says) {
  const std::string bytes = las_bytes("points.las");
  decode::Cursor c(bytes);
  EXPECT_EQ(c.text(4), "LASF");
  c.text(2);
  EXPECT_EQ(c.unsigned_little(2), 0x11U);  // adjusted GPS time; well-known text, as formats from 6 on must have
  c.text(16);
  EXPECT_EQ(c.unsigned_little(1), 1U);
  EXPECT_EQ(c.unsigned_little(1), 4U);
  c.text(64 + 4);
  EXPECT_EQ(c.unsigned_little(2), 375U);
  const std::uint64_t data = c.unsigned_little(4);
  EXPECT_EQ(c.unsigned_little(4), 2U);
  EXPECT_EQ(c.unsigned_little(1), 6U);
  EXPECT_EQ(c.unsigned_little(2), 44U);
  EXPECT_EQ(c.text(24), std::string(24, '\0'));
  double scale[3], offset[3];
  for (double& s : scale) EXPECT_EQ(s = c.float64(), 1e-4);
  for (double& o : offset) o = c.float64();
  const double box[6] = {565440, 565400.5, 5995200.25, 5995100, -3, -20.0501};
  for (const double edge : box) EXPECT_NEAR(c.float64(), edge, 1e-4);
  c.text(8 + 8 + 4);
  EXPECT_EQ(c.unsigned_little(8), 3U);
  EXPECT_EQ(c.unsigned_little(8), 3U);
  EXPECT_EQ(bytes.size(), data + 3 * 44);

  decode::Cursor record(bytes, 375);
  record.text(2);
  EXPECT_EQ(record.text(16), "LASF_Projection" + std::string(1, '\0'));
  EXPECT_EQ(record.unsigned_little(2), 2112U);
  const std::string wkt = (record.text(2), decode::Cursor(bytes, 375 + 54)).text(utm_wkt(las_zone).size());
  EXPECT_EQ(wkt, utm_wkt(las_zone));
  EXPECT_THAT(
      wkt, testing::AllOf(HasSubstr("PARAMETER[\"central_meridian\",9]"), HasSubstr("AUTHORITY[\"EPSG\",\"32632\"]")));

  for (std::size_t i = 0; i < 3; ++i) {
    decode::Cursor point(bytes, data + 44 * i);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(static_cast<double>(point.signed_little(4)) * scale[axis] + offset[axis],
                  las_points[i].position[axis], 5.1e-5);
    EXPECT_EQ(point.unsigned_little(2), (std::array{10125U, 13350U, 0U})[i]);
    EXPECT_EQ(point.unsigned_little(2), 0x11U);
    EXPECT_EQ(point.unsigned_little(1), 40U);
    point.text(5);
    EXPECT_NEAR(point.float64() + 1e9 + 315964800 - 18, las_points[i].time, 1e-6);  // 18 leap seconds since 1980
    EXPECT_EQ(point.float32(), las_points[i].level_db);
    EXPECT_EQ(point.float32(), las_points[i].deviation);
    EXPECT_EQ(point.unsigned_little(4), las_points[i].ping);
    EXPECT_EQ(point.unsigned_little(2), las_points[i].beam);
  }
}

// Bit 2 of the classification flags, in 1.2 bit 7 of the classification; a remark is the text area description.
TEST(LasFile, flags_withheld_points_and_has_a_remark) {
  for (const int minor : {2, 4}) {
    const std::string path = own_path("withheld.las");
    LasFile file(path, las_zone, las_points[0].position, {minor, 0, "processing profile: ctd.csv"});
    for (LasPoint point : las_points) {
      point.withheld = point.ping == 9;
      file.add(point);
    }
    file.finish();
    const std::string bytes = file_bytes(path);
    const std::vector<decode::LasRow> rows = decode::read_las(bytes);
    ASSERT_EQ(rows.size(), 3U);
    for (const decode::LasRow& row : rows) {
      EXPECT_EQ(row.withheld, row.ping == 9) << minor;
      EXPECT_EQ(row.classification, minor == 4 ? 40U : 2U);
    }
    EXPECT_EQ(decode::Cursor(bytes, 100).unsigned_little(4), 3U);
    EXPECT_THAT(bytes, HasSubstr("processing profile: ctd.csv"));
  }
}

TEST(LasFile, is_read_as_a_scene_in_its_own_coordinates) {
  const std::string path = own_path("scene.las");
  LasFile file(path, las_zone, {565400, 5995100, -20});
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 400; ++i) {
    positions.emplace_back(565400 + 0.25 * (i % 20), 5995100 + 0.25 * (i / 20), -20 + 0.01 * (i % 7));
    file.add({positions.back(), 1777624200, 100, 0.01F, 1, static_cast<std::uint16_t>(i)});
  }
  file.finish();
  const LoadedScene scene = load_scene(path);
  ASSERT_EQ(scene.scene.size(), positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    EXPECT_LT((scene.scene.origin + scene.scene.point[i].cast<double>() - positions[i]).norm(), 1e-3);
  const std::string bytes = file_bytes(path);
  for (std::size_t size = 0; size < bytes.size(); size += size < 1700 ? 1 : 7)  // every byte of the header
    EXPECT_THAT(error_of_file([](const std::string& p) { load_scene(p); }, "cut.las", bytes.substr(0, size)),
                HasSubstr("cut.las"));
}

TEST(LasFile, refuses_points_that_it_cannot_hold) {
  LasFile file(own_path("far.las"), las_zone, {0, 0, 0});
  EXPECT_THAT(error_of(
                  [&] {
                    file.add({{3e5, 0, 0}, 0, 0, 0, 12, 0});
                  },
                  ErrorKind::content),
              HasSubstr("300000 m of ping 12"));
  EXPECT_THAT(error_of(
                  [&] {
                    file.add({{0, std::nan(""), 0}, 0, 0, 0, 12, 0});
                  },
                  ErrorKind::content),
              HasSubstr("must be finite"));
}

// Offsets are those of ASPRS LAS 1.2, tables 3 and 5 to 8: for readers that know no 1.4.
TEST(LasFile, of_version_2_holds_the_same_points) {
  const std::string path = own_path("old.las");
  LasFile file(path, las_zone, las_points[0].position, {2, 1777624200});
  for (const LasPoint& point : las_points) file.add(point);
  file.finish();
  const std::string bytes = file_bytes(path);
  EXPECT_EQ(decode::Cursor(bytes, 90).unsigned_little(2), 121U);  // 1 May 2026
  EXPECT_EQ(decode::Cursor(bytes, 92).unsigned_little(2), 2026U);
  EXPECT_EQ(decode::Cursor(bytes, 94).unsigned_little(2), 227U);
  EXPECT_EQ(decode::Cursor(bytes, 107).unsigned_little(4), 3U);
  EXPECT_EQ(decode::Cursor(bytes, 111).unsigned_little(4), 3U);  // first returns
  decode::Cursor keys(bytes, 227 + 2);
  EXPECT_EQ(keys.text(15), "LASF_Projection");
  keys.text(1);
  EXPECT_EQ(keys.unsigned_little(2), 34735U);
  EXPECT_EQ(decode::Cursor(bytes, 227 + 54 + 30).unsigned_little(2), 32632U);
  const std::vector<decode::LasRow> rows = decode::read_las(bytes);
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(rows[i].position[0], las_points[i].position.x(), 5.1e-5);
    EXPECT_NEAR(rows[i].time, las_points[i].time, 1e-6);
    EXPECT_EQ(rows[i].classification, 2U);
    EXPECT_EQ(rows[i].level_db, las_points[i].level_db);
    EXPECT_EQ(rows[i].beam, las_points[i].beam);
  }
  EXPECT_EQ(load_scene(path).scene.size(), 3U);
  EXPECT_THAT(error_of(
                  [] {
                    LasFile(own_path("odd.las"), las_zone, {0, 0, 0}, {3, 0});
                  },
                  ErrorKind::argument),
              HasSubstr("minor = 3, must be 2 or 4"));
}

TEST(LasFile, counts_returns_of_a_beam_and_says_line_and_angle) {
  for (const int minor : {2, 4}) {
    const std::string path = own_path("returns.las");
    LasFile file(path, las_zone, {0, 0, 0}, {minor, 0});
    LasPoint point;
    point.source = 7, point.returns = 3;
    for (std::uint8_t number = 1; number <= 3; ++number) {
      point.return_number = number, point.scan_angle = radians(-60 + 30.0 * number);
      file.add(point);
    }
    file.finish();
    const std::vector<decode::LasRow> rows = decode::read_las(file_bytes(path));
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(rows[i].return_number, i + 1);
      EXPECT_EQ(rows[i].returns, 3U);
      EXPECT_EQ(rows[i].source, 7U);
      EXPECT_NEAR(rows[i].scan_angle_deg, -30 + 30.0 * i, 0.003);
    }
    const std::string bytes = file_bytes(path);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(minor == 4 ? decode::Cursor(bytes, 255 + 8 * k).unsigned_little(8)
                           : decode::Cursor(bytes, 111 + 4 * k).unsigned_little(4),
                k < 3 ? 1U : 0U);
  }
}

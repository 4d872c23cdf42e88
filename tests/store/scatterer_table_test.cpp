// SPDX-License-Identifier: BSD-3-Clause
#include "store/csv_tables.hpp"
#include "support/test.hpp"

namespace {
const std::string header = "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n";

void refuses_table(const std::string& text, const std::string& what) {
  EXPECT_EQ(error_of_file(load_scatterer_table, "s.csv", text), "content: s.csv:" + what);
}
}  // namespace

TEST(ScattererTable, reads_every_column_in_line_order) {
  const auto t = load_scatterer_table(own_file(
      "s.csv", "# made by a ray tracer\n" + header + "10,0.1,-0.2,1e-3,0.6,-0.8\n\n# between\n20.5,-0.25,+.5,0,1,0\n"));
  ASSERT_EQ(t.scatterers.size(), 2u);
  EXPECT_EQ(t.scatterers.range, (std::vector<double>{10, 20.5}));
  EXPECT_EQ(t.scatterers.azimuth, (std::vector<double>{0.1, -0.25}));
  EXPECT_EQ(t.scatterers.elevation, (std::vector<double>{-0.2, 0.5}));
  EXPECT_EQ(t.sigma, (std::vector<double>{1e-3, 0}));
  EXPECT_EQ(t.xi, (std::vector<std::complex<double>>{{0.6, -0.8}, {1, 0}}));
  EXPECT_EQ(t.scatterers.id, (std::vector<std::uint64_t>{0, 1}));
}

TEST(ScattererTable, fills_every_array_of_the_scatterers) {
  const auto t = load_scatterer_table(own_file("s.csv", header + "10,0,0,1,1,0\n20,0,0,1,1,0\n"));
  EXPECT_EQ(t.scatterers.cos_incidence, (std::vector<float>{1, 1}));
  EXPECT_EQ(t.scatterers.projected_area.size(), 2u);
  EXPECT_EQ(t.scatterers.material, (std::vector<std::uint16_t>{0, 0}));
  EXPECT_EQ(t.scatterers.surfel, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ScattererTable, takes_columns_in_any_order_spaces_windows_lines_and_a_byte_order_mark) {
  const auto t = load_scatterer_table(own_file(
      "s.csv", "\xEF\xBB\xBFxi_im , xi_re,sigma_m2,elevation_rad,azimuth_rad, range_m\r\n6, 5 ,4,0.3,0.2,1\r\n"));
  EXPECT_EQ(t.scatterers.range, (std::vector<double>{1}));
  EXPECT_EQ(t.scatterers.azimuth, (std::vector<double>{0.2}));
  EXPECT_EQ(t.scatterers.elevation, (std::vector<double>{0.3}));
  EXPECT_EQ(t.sigma, (std::vector<double>{4}));
  EXPECT_EQ(t.xi[0], std::complex<double>(5, 6));
}

TEST(ScattererTable, reads_the_last_line_without_newline_and_a_table_of_none) {
  EXPECT_EQ(load_scatterer_table(own_file("s.csv", header + "10,0,0,1,1,0")).sigma.size(), 1u);
  EXPECT_EQ(load_scatterer_table(own_file("s.csv", header)).sigma.size(), 0u);
}

TEST(ScattererTable, names_a_missing_unknown_or_doubled_column) {
  refuses_table("range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re\n", "1: missing column 'xi_im'");
  refuses_table("# one\nrange,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n",
                "2: unknown column 'range'; did you mean 'range_m'?");
  refuses_table("range_m,temperature\n", "1: unknown column 'temperature'");
  refuses_table("range_m,xi_re,xi_re\n", "1: column 'xi_re' occurs twice");
}

TEST(ScattererTable, names_line_column_value_and_rule) {
  refuses_table(header + "10,0,0,1,1,0\n# x\n0,0,0,1,1,0\n", "4: range_m = 0 m, must be > 0");
  refuses_table(header + "1,0,0,-1e-3,1,0\n", "2: sigma_m2 = -0.001 m^2, must be >= 0");
  refuses_table(header + "1,45,0,1,1,0\n", "2: azimuth_rad = 45 rad, must be within -pi and pi (is it in degrees?)");
  refuses_table(header + "1,0,-2,1,1,0\n",
                "2: elevation_rad = -2 rad, must be within -pi/2 and pi/2 (is it in degrees?)");
  refuses_table(header + "1,0,0,1,nan,0\n", "2: xi_re = 'nan', must be a finite number");
  refuses_table(header + "inf,0,0,1,1,0\n", "2: range_m = 'inf', must be a finite number");
  refuses_table(header + "1,0,0,1,1,0x\n", "2: xi_im = '0x', must be a finite number");
  refuses_table(header + "1,,0,1,1,0\n", "2: azimuth_rad = '', must be a finite number");
  refuses_table(header + "1,0,0,1,1\n", "2: has 5 fields, the header has 6");
}

TEST(ScattererTable, says_what_an_empty_or_missing_file_lacks) {
  refuses_table("# only a comment\n",
                " has no header, must start with range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im");
  const std::string missing = own_path("missing.csv");
  EXPECT_EQ(error_with_kind([&] { load_scatterer_table(missing); }),
            "file: " + missing + ": no such file; check the path");
}

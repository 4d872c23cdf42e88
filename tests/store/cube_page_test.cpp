// SPDX-License-Identifier: BSD-3-Clause
// Tests the description in a cube, as another program finds it, and the page that describes it: docs/formats.md.
#include <hdf5_hl.h>

#include "store/cube.hpp"
#include "store/random_cube.hpp"
#include "support/test.hpp"

namespace {

std::string text_attribute(hid_t object, const char* name) {
  const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  char* text = nullptr;
  H5Aread(attribute, type, &text);
  const std::string copy = text ? text : "";
  H5free_memory(text);
  H5Tclose(type), H5Aclose(attribute);
  return copy;
}

/// Returns a cube with every dataset and attribute that there can be.
Cube full_cube() {
  Cube cube = random_cube();
  cube.keep_bits = 20;
  cube.head = "port", cube.start_utc = "2026-05-01T08:30:00Z", cube.anchor = {54.1, 7.9, 30};
  for (Ping& ping : cube.pings) {
    const auto rows = ping.pressure.rows(), columns = ping.pressure.cols();
    ping.layers = {{"direct", ping.pressure}};
    ping.intensity = ping.split_phase = Grid<float>::Ones(rows, columns);
    ping.unknown = Grid<std::uint8_t>::Ones(rows, columns);
    ping.labels.material = Grid<std::uint16_t>::Zero(rows, columns);
    ping.labels.id = Grid<std::uint32_t>::Zero(rows, columns);
    ping.labels.share = Grid<float>::Ones(rows, columns);
    ping.labels.names = {"sand"};
    ping.labels.elevation = ping.labels.second_share = Grid<float>::Zero(rows, columns);
    ping.labels.second = Grid<std::uint16_t>::Zero(rows, columns);
    ping.labels.part = Grid<std::uint16_t>::Zero(rows, columns);
    ping.labels.part_names = {"bed"}, ping.labels.part_labels = {""}, ping.labels.views.resize(1);
    ping.scan = ScanDirection{0, 0.5};
    ping.expected_level = true;
    ping.fan.row_width = 0.02;
  }
  return cube;
}

struct Found {
  std::vector<std::string> datasets, attributes;
};
Found everything_in(hid_t file) {
  Found found;
  H5Ovisit2(
      file, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t, const char* name, const auto* info, void* to) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<Found*>(to)->datasets.push_back("/" + std::string(name));
        return 0;
      },
      &found, H5O_INFO_BASIC);
  H5Aiterate2(
      file, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5A_info_t*, void* to) -> herr_t {
        static_cast<Found*>(to)->attributes.emplace_back(name);
        return 0;
      },
      &found);
  return found;
}

/// Returns the cells of a row of a table of the page whose first cell holds `name`.
std::vector<std::string> row_of_page(const std::string& name) {
  std::istringstream lines(file_bytes(INSONIFY_FORMATS_PAGE));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ") || line.substr(0, line.find(" |", 1)).find("`" + name + "`") == line.npos) continue;
    std::vector<std::string> cells;
    for (std::size_t at = 1, end; (end = line.find('|', at)) != line.npos; at = end + 1) {
      const std::string cell = line.substr(at, end - at);
      const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
      cells.push_back(first == cell.npos ? "" : cell.substr(first, last - first + 1));
    }
    return cells;
  }
  return {};
}

}  // namespace

TEST(CubePage, has_every_dataset_with_its_unit_and_every_attribute) {
  const std::string path = write(full_cube(), "full.h5");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const Found found = everything_in(file);
  EXPECT_EQ(found.datasets.size(), 23U);
  for (const std::string& name : found.datasets) {
    SCOPED_TRACE(name);
    const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    const std::vector<std::string> row = row_of_page(name.starts_with("/layers") ? "/layers/NAME" : name);
    ASSERT_EQ(row.size(), 5U);
    const bool has_unit = H5Aexists(dataset, "units") > 0;
    EXPECT_EQ(has_unit ? text_attribute(dataset, "units") : "", row[3]);
    EXPECT_GT(text_attribute(dataset, "long_name").size(), 8U);
    const hid_t space = H5Dget_space(dataset);
    const int rank = H5Sget_simple_extent_ndims(space);
    const std::string dims[] = {"ping", "beam", "bin"};
    char label[16] = "";
    ASSERT_GT(H5DSget_label(dataset, 0, label, sizeof label), 0);
    if (rank == 3 && name != "/pose" && name != "/part_views") {
      for (unsigned d = 0; d < 3; ++d) {
        H5DSget_label(dataset, d, label, sizeof label);
        EXPECT_EQ(label, dims[d]);
        EXPECT_EQ(H5DSget_num_scales(dataset, d), 1);
      }
    }
    if (name == "/range" || name == "/azimuth" || name == "/ping") {
      EXPECT_EQ(H5DSis_scale(dataset), 1);
    }
    H5Sclose(space), H5Dclose(dataset);
  }
  for (const std::string& name : found.attributes) EXPECT_FALSE(row_of_page(name).empty()) << name;
  EXPECT_EQ(text_attribute(file, "head"), "port");
  H5Fclose(file);
  const Cube back = read_cube(path);
  EXPECT_EQ(back.head, "port");
  EXPECT_EQ(back.start_utc, "2026-05-01T08:30:00Z");
  ASSERT_TRUE(back.anchor);
  EXPECT_EQ(back.anchor->heading_deg, 30);
}

// The attribute states the law: a sine of 1 Pa amplitude has 0.7071 Pa rms, 116.99 dB.
TEST(CubePage, says_how_a_level_follows_from_a_pressure) {
  Cube cube = random_cube(1);
  cube.pings[0].pressure(0, 0) = {0.6F, -0.8F};
  const std::string path = write(cube, "law.h5");
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
              dataset = H5Dopen2(file, "/pressure", H5P_DEFAULT);
  EXPECT_THAT(text_attribute(dataset, "convention"), HasSubstr("20 log10(abs / sqrt(2) / 1e-6)"));
  H5Dclose(dataset), H5Fclose(file);
  EXPECT_NEAR(level_db(read_cube(path).pings[0])(0, 0), 20 * std::log10(1 / std::sqrt(2.0) / 1e-6), 1e-4);
  EXPECT_THAT(row_of_page("/pressure").at(3), "Pa");
  EXPECT_THAT(file_bytes(INSONIFY_FORMATS_PAGE), HasSubstr("20 log10(abs / sqrt(2) / 1e-6) dB re 1 uPa"));
}

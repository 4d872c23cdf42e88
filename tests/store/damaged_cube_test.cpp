// SPDX-License-Identifier: BSD-3-Clause
// Tests cubes with one wrong byte, where HDF5 trusts it.
#include "store/concatenate_cube_files.hpp"
#include "store/random_cube.hpp"

namespace {

/// Reads a cube in which one byte is `value`. Returns its error, or "".
std::string error_with_byte(const std::string& whole, std::size_t at, int value) {
  std::string bytes = whole;
  bytes[at] = static_cast<char>(value);
  try {
    read_cube(own_file("cube.h5", bytes));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::content) << at << ": " << error.what();
    return error.what();
  }
  return "";
}

}  // namespace

TEST(DamagedCube, members_beyond_their_type_are_refused) {
  const std::string whole = file_bytes(write(random_cube(1, 4)));
  constexpr std::size_t high_byte_of_offset = 11;
  for (const std::string& name : {std::string("r\0\0\0\0\0\0\0", 8), std::string("i\0\0\0\0\0\0\0", 8)}) {
    const std::size_t at = whole.find(name);
    ASSERT_NE(at, std::string::npos);
    for (const int value : {0x20, 0x41, 0x7f, 0x80, 0xff})
      EXPECT_THAT(error_with_byte(whole, at + high_byte_of_offset, value),
                  AllOf(HasSubstr("cube.h5: "), HasSubstr("copy or export it again")));
  }
}

TEST(DamagedCube, chunk_indexes_are_read_or_refused) {
  const std::string whole = file_bytes(write(random_cube(3, 70)));
  for (std::size_t tree = whole.find("TREE"); tree != std::string::npos; tree = whole.find("TREE", tree + 1))
    for (std::size_t at = tree; at < std::min(tree + 80, whole.size()); at += 3)
      for (const int value : {0x80, 0xff}) error_with_byte(whole, at, value);
}

TEST(DamagedCube, is_not_joined) {
  std::string bytes = file_bytes(write(random_cube(1, 4)));
  for (std::size_t tree = bytes.find("TREE"); tree != std::string::npos; tree = bytes.find("TREE", tree))
    bytes[tree] = 't';
  const std::string part = own_file("part.h5", bytes), whole = own_path("whole.h5");
  for (const bool copy : {false, true})
    expect_error(ErrorKind::content, {"part.h5: "}, [&] { concatenate_cube_files(whole, {part}, copy); });
  EXPECT_FALSE(std::filesystem::exists(whole));
}

namespace {

/// Returns a cube whose pixels show materials 0 and 1, parts 0 to 2, shadow and nothing.
Cube labelled_cube() {
  Cube cube = random_cube(2, 4);
  for (Ping& ping : cube.pings) {
    PixelLabels& labels = ping.labels;
    const Eigen::Index beams = ping.pressure.rows(), bins = ping.pressure.cols();
    labels.material = Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::nothing);
    labels.material.row(1) = PixelLabels::shadow, labels.material(2, 3) = 1, labels.material(2, 4) = 0;
    labels.id = Grid<std::uint32_t>::Zero(beams, bins), labels.share = Grid<float>::Ones(beams, bins);
    labels.part = Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::no_part);
    labels.part(2, 3) = 2;
    labels.names = {"sand", "tyre"};
    labels.part_names = labels.part_labels = {"bed", "pot", "tyre"}, labels.views.resize(3);
  }
  return cube;
}

}  // namespace

TEST(DamagedCube, labels_without_names_are_refused) {
  EXPECT_EQ(read_cube(write(labelled_cube())).pings[1].labels.material(2, 3), 1);
  Cube no_names = labelled_cube(), one_name = labelled_cube(), two_parts = labelled_cube();
  for (Ping& ping : no_names.pings) ping.labels.names.clear();
  for (Ping& ping : one_name.pings) ping.labels.names.pop_back();
  for (Ping& ping : two_parts.pings)
    ping.labels.part_names = ping.labels.part_labels = {"bed", "pot"}, ping.labels.views.pop_back();
  EXPECT_EQ(error_of_cube(write(no_names)),
            "content: cube.h5: /label_material holds 1, but label_names has 0 names, counted from 0; the file is "
            "damaged: copy or export it again");
  EXPECT_THAT(error_of_cube(write(one_name)), HasSubstr("/label_material holds 1, but label_names has 1 names"));
  Cube second = labelled_cube();
  for (Ping& ping : second.pings) {
    ping.labels.second = Grid<std::uint16_t>::Constant(ping.labels.id.rows(), ping.labels.id.cols(), 2);
    ping.labels.second_share = ping.labels.elevation = Grid<float>::Zero(ping.labels.id.rows(), ping.labels.id.cols());
  }
  EXPECT_THAT(error_of_cube(write(second)), HasSubstr("/label_second holds 2, but label_names has 2 names"));
  EXPECT_THAT(error_of_cube(write(two_parts)), HasSubstr("/label_part holds 2, but part_names has 2 names"));
}

TEST(Cube, names_of_labels_may_be_empty) {
  Cube cube = labelled_cube();
  for (const std::vector<std::string>& names : {std::vector<std::string>{"", ""}, {"sand", ""}, {"", "tyre"}}) {
    for (Ping& ping : cube.pings) ping.labels.names = names;
    EXPECT_EQ(read_cube(write(cube)).pings[0].labels.names, names);
  }
}

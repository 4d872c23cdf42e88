// SPDX-License-Identifier: BSD-3-Clause
// Cubes of which one byte is wrong, where HDF5 trusts it.
#include "store/concatenate_cube_files.hpp"
#include "store/random_cube.hpp"

namespace {

/// Reads a cube of which one byte is `value`; returns its error, or "".
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

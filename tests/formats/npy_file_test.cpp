// SPDX-License-Identifier: BSD-3-Clause
// Arrays of numpy, written here byte by byte.
#include "formats/npy_file.hpp"

#include "support/npy.hpp"
#include "support/test.hpp"

namespace {

const std::vector<float> six{1, 2, 3, 4, 5, 6};
std::string npy_refusal(const std::string& bytes) {
  return error_of_file([](const std::string& path) { read_npy(path); }, "a.npy", bytes);
}

}  // namespace

TEST(NpyFile, reads_the_orders_of_c_and_fortran) {
  const Grid<double> c = read_npy(own_file("c.npy", made_npy("<f4", "2, 3", false, six))).real;
  ASSERT_EQ(c.rows(), 2);
  EXPECT_EQ(c(0, 1), 2);
  EXPECT_EQ(c(1, 0), 4);
  const Grid<double> f = read_npy(own_file("f.npy", made_npy("<f4", "2, 3", true, six))).real;
  EXPECT_EQ(f(0, 1), 3);
  EXPECT_EQ(f(1, 0), 2);
}

TEST(NpyFile, reads_complex_numbers_and_grey_values) {
  const NpyArray z = read_npy(own_file("z.npy", made_npy("<c8", "1, 3", false, six)));
  EXPECT_EQ(z.real(0, 1), 3);
  EXPECT_EQ(z.imaginary(0, 1), 4);
  const NpyArray g = read_npy(own_file("g.npy", made_npy<std::uint16_t>("<u2", "1, 2", false, {7, 65535})));
  EXPECT_EQ(g.unsigned_bits, 16);
  EXPECT_EQ(g.real(0, 1), 65535);
  EXPECT_EQ(read_npy(own_file("b.npy", made_npy<std::uint8_t>("|u1", "2, 1", false, {7, 9}))).unsigned_bits, 8);
}

TEST(NpyFile, refuses_what_it_cannot_be) {
  EXPECT_THAT(npy_refusal("PK"), HasSubstr("content: a.npy: does not begin as a .npy file"));
  const std::string whole = made_npy("<f4", "2, 3", false, six);
  EXPECT_THAT(npy_refusal(whole.substr(0, 20)), HasSubstr("ends within its header"));
  EXPECT_THAT(npy_refusal(whole.substr(0, whole.size() - 3)),
              HasSubstr("has 21 bytes of numbers, must have 24 for 2 x 3 of '<f4'; the file is truncated"));
  EXPECT_THAT(npy_refusal(made_npy(">f4", "2, 3", false, six)),
              HasSubstr("big-endian numbers ('>f4'), must be little-endian: save a.astype('<f4')"));
  EXPECT_THAT(npy_refusal(made_npy("<f4", "6,", false, six)), HasSubstr("has shape (6,), must have two dimensions"));
  EXPECT_THAT(npy_refusal(made_npy("<f4", "1, 2, 3", false, six)), HasSubstr("must have two dimensions"));
  EXPECT_THAT(npy_refusal(made_npy("<f4", "0, 3", false, six)), HasSubstr("none of them 0"));
  EXPECT_THAT(npy_refusal(made_npy("<i4", "2, 3", false, six)), HasSubstr("numbers of type '<i4'"));
}

// SPDX-License-Identifier: BSD-3-Clause
#include "store/element_file.hpp"

#include "store/raw_file.hpp"
#include "support/test.hpp"

TEST(ElementFile, holds_series_axis_and_steering) {
  SonarHead head;
  head.array = {0.001, {1, 1, 1}};
  head.pulse = {750e3, 50e3, 200};
  ElementSeries series{0.002, 1e-6, ComplexGrid::Random(3, 50)};
  const std::string path = own_path("elements.h5");
  write_element_file(path, series, head, 1490);
  const RawFile file(path);
  const hid_t dataset = H5Dopen2(file, "/pressure", H5P_DEFAULT);
  std::vector<std::complex<float>> samples(150);
  const hid_t type = H5Tcreate(H5T_COMPOUND, 8);
  H5Tinsert(type, "r", 0, H5T_NATIVE_FLOAT);
  H5Tinsert(type, "i", 4, H5T_NATIVE_FLOAT);
  EXPECT_GE(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, samples.data()), 0);
  EXPECT_EQ(samples[57], std::complex<float>(series.pressure(1, 7)));
  EXPECT_EQ(raw_number(file, "step"), 1e-6);
  H5Tclose(type), H5Dclose(dataset);
  series.pressure.conservativeResize(2, 50);
  EXPECT_THAT(error_with_kind([&] { write_element_file(path, series, head, 1490); }),
              HasSubstr("2 elements and 50 samples"));
}

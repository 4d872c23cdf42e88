// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <thread>

#include "hdf/hdf5_internal.hpp"
#include "support/test.hpp"

namespace {

using namespace insonify::hdf5;
constexpr DatasetName numbers_name{"/numbers", "m", "some numbers"};

/// Writes a file of four numbers without HDF5.
std::string plain_file() {
  const std::string path = own_path("plain.h5");
  std::uint64_t offset = 0;
  write_hdf5(path, [&](const FileContext& context, hid_t file) {
    offset = create_plain(context, file, numbers_name, H5T_IEEE_F32LE, {4});
  });
  const std::array<float, 4> numbers{1, 2, 3, 4};
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
      .seekp(static_cast<std::streamoff>(offset))
      .write(reinterpret_cast<const char*>(numbers.data()), sizeof(numbers));
  return path;
}

/// Looks for plain numbers in a file.
void find_numbers(const std::string& path, hid_t type, const Extent& extent) {
  const auto find = [](const FileContext& context, hid_t file, ArraySender&, hid_t of_type, const Extent& of_extent) {
    find_plain(context, file, numbers_name, of_type, of_extent);
  };
  read_hdf5(path, find, type, extent);
}

}  // namespace

TEST(Hdf5File, values_written_at_their_offset_are_those_that_hdf5_reads) {
  const QuietErrors quiet;
  const std::string path = plain_file();
  const FileContext context{path, ErrorKind::content};
  const Handle file = open_file(context);
  EXPECT_EQ(read_all<float>(context, file, numbers_name, {4}), (std::vector<float>{1, 2, 3, 4}));
  const Handle dataset = open_dataset(context, file, numbers_name);
  EXPECT_EQ(find_plain(context, file, numbers_name, H5T_IEEE_F32LE, {4}), H5Dget_offset(dataset));
  EXPECT_EQ(read_text(context, dataset, "units"), "m");
}

TEST(Hdf5File, values_that_do_not_lie_in_the_file_as_announced_are_refused) {
  const std::string path = plain_file();
  find_numbers(path, H5T_IEEE_F32LE, {4});
  expect_error(ErrorKind::content, {"plain.h5", "/numbers has 4 entries, must have 5"},
               [&] { find_numbers(path, H5T_IEEE_F32LE, {5}); });
  expect_error(ErrorKind::content, {"/numbers has 1 dimensions, must have 2"}, [&] {
    find_numbers(path, H5T_IEEE_F32LE, {4, 1});
  });
  expect_error(ErrorKind::content, {"/numbers is of another type"}, [&] { find_numbers(path, H5T_IEEE_F32BE, {4}); });
  write_hdf5(own_path("chunked.h5"), [&](const FileContext& context, hid_t file) {
    const std::array<float, 4> numbers{1, 2, 3, 4};
    const Handle dataset = create_dataset(context, file, numbers_name, H5T_IEEE_F32LE, {4}, {2});
    H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
  });
  expect_error(ErrorKind::content, {"chunked.h5", "contiguous"},
               [&] { find_numbers(own_path("chunked.h5"), H5T_IEEE_F32LE, {4}); });
  expect_error(ErrorKind::content, {"text.h5", "is not an HDF5 file"},
               [&] { find_numbers(own_file("text.h5", "numbers"), H5T_IEEE_F32LE, {4}); });
}

TEST(Hdf5File, values_beyond_the_end_of_the_file_are_refused) {
  constexpr std::uint64_t count = 12345;
  const std::string path = own_path("long.h5");
  write_hdf5(path, [&](const FileContext& context, hid_t file) {
    create_plain(context, file, numbers_name, H5T_IEEE_F32LE, {count});
  });
  std::string bytes = file_bytes(path);
  for (std::uint64_t number : {count, 4 * count}) {
    const auto text = [](std::uint64_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof(n)); };
    bytes = replaced(bytes, text(number), text(number << 30));
  }
  own_file("long.h5", bytes);
  // HDF5 1.14 finds the damage itself, and says it in its own words.
  expect_error(ErrorKind::content,
               {"long.h5: /numbers", H5_VERS_MINOR < 14 ? "the file holds" : "; ", "copy or export it again"},
               [&] { find_numbers(path, H5T_IEEE_F32LE, {count << 30}); });
}

TEST(Hdf5File, appears_whole_or_not_at_all) {
  const std::string path = own_path("none.h5");
  struct Stop {};
  EXPECT_THROW(write_hdf5(path, [](const FileContext&, hid_t) { throw Stop{}; }), Stop);
  EXPECT_TRUE(std::filesystem::is_empty(own_folder()));
}

TEST(Hdf5File, is_read_while_another_thread_writes) {
  const std::string path = plain_file();
  std::jthread writer([to = own_path("other.h5")](const std::stop_token& end) {
    const std::vector<float> numbers(1 << 16);
    while (!end.stop_requested())
      write_hdf5(to, [&](const FileContext& context, hid_t file) {
        for (const char* name : {"/a", "/b", "/c", "/d"})
          write_numbers(context, file, {name, ""}, {numbers.size()}, numbers.data());
      });
  });
  for (int i = 0; i < 20; ++i) find_numbers(path, H5T_IEEE_F32LE, {4});
}

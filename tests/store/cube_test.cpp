// SPDX-License-Identifier: BSD-3-Clause
#include "store/cube.hpp"

#include "files/read_apart.hpp"
#include "store/random_cube.hpp"
#include "store/raw_file.hpp"
#include "store/run_directory.hpp"

TEST(Cube, keeps_the_row_width_of_a_planar_array) {
  Cube cube = random_cube(1);
  EXPECT_EQ(read_cube(write(cube, "line.h5")).pings[0].fan.row_width, 0);
  cube.pings[0].fan.row_width = radians(2);
  EXPECT_EQ(read_cube(write(cube)).pings[0].fan.row_width, radians(2));
}

TEST(Cube, comes_back_bit_for_bit) {
  const Cube cube = random_cube();
  const Cube back = read_cube(write(cube));
  const auto fields = [](const auto& x) {
    return std::tie(x.sound_speed, x.absorption_db_per_m, x.centre_frequency, x.bandwidth, x.source_level_db, x.seed,
                    x.tolerance, x.sonar, x.insonify_version);
  };
  EXPECT_EQ(fields(back), fields(cube));
  ASSERT_EQ(back.pings.size(), cube.pings.size());
  for (std::size_t p = 0; p < back.pings.size(); ++p) {
    const Ping &a = back.pings[p], &b = cube.pings[p];
    EXPECT_EQ(a.number, b.number);
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.world_from_head.matrix(), b.world_from_head.matrix());
    const auto of_ping = [](const auto& x) {
      return std::tie(x.fan.azimuth, x.fan.elevation, x.fan.beam_width, x.fan.elevation_width, x.gate.min_range,
                      x.gate.max_range, x.gate.bin_size);
    };
    EXPECT_EQ(of_ping(a), of_ping(b));
    ASSERT_EQ(a.pressure.rows(), b.pressure.rows());
    EXPECT_TRUE((a.pressure == b.pressure).all());
  }
}

// One ping after the other, with all that it has: the same bits as of the whole cube.
TEST(Cube, is_read_ping_by_ping_as_it_is_as_a_whole) {
  Cube cube = random_cube(4, 5);
  for (Ping& ping : cube.pings) {
    ping.layers = {{"direct", ping.pressure * 0.5F}, {"noise", ping.pressure * 0.25F}};
    ping.split_phase = ping.pressure.real();
    ping.intensity = ping.pressure.abs2();
    ping.scan = ScanDirection{ping.number / 2, 0.1 * static_cast<double>(ping.number)};
  }
  const std::string path = write(cube);
  std::size_t p = 0;
  read_cube_pings(path, [&](const Cube& shared, const Ping& ping) {
    EXPECT_TRUE(shared.pings.empty());
    EXPECT_EQ(shared.sonar, cube.sonar);
    const Ping& whole = cube.pings.at(p++);
    EXPECT_EQ(ping.number, whole.number);
    EXPECT_EQ(ping.time, whole.time);
    EXPECT_EQ(ping.world_from_head.matrix(), whole.world_from_head.matrix());
    EXPECT_TRUE((ping.pressure == whole.pressure).all());
    EXPECT_TRUE((ping.split_phase == whole.split_phase).all());
    EXPECT_TRUE((ping.intensity == whole.intensity).all());
    ASSERT_EQ(ping.layers.size(), 2U);
    EXPECT_TRUE((ping.layers[1].pressure == whole.layers[1].pressure).all());
    ASSERT_TRUE(ping.scan);
    EXPECT_EQ(ping.scan->sweep, whole.scan->sweep);
    EXPECT_EQ(ping.scan->angle, whole.scan->angle);
  });
  EXPECT_EQ(p, 4U);
}

TEST(Cube, of_few_bytes_is_read_at_once_ping_by_ping) {
  const std::string path = write(random_cube(4, 3));
  int reads = 0, pings = 0;
  const ReaderProcess before = set_reader_process({.run = [&](const ReadTask& task, const ReadTask::Send& arguments) {
    ++reads;
    const auto memory = std::make_shared<SharedMemory>(std::size_t{1} << 26);
    ReadTask::send(arguments, *memory);
    task.run(memory);
    return memory;
  }});
  read_cube_pings(path, [&](const Cube&, const Ping&) { ++pings; });
  set_reader_process(before);
  EXPECT_EQ(pings, 4);
  EXPECT_EQ(reads, 1);
}

TEST(Cube, of_one_ping_and_one_beam_comes_back) {
  const Cube cube = random_cube(1, 1);
  const Cube back = read_cube(write(cube));
  ASSERT_EQ(back.pings.size(), 1u);
  EXPECT_TRUE((back.pings[0].pressure == cube.pings[0].pressure).all());
}

TEST(Cube, has_the_same_bytes_a_day_later_and_whatever_memory_held_before) {
  expect_same_bytes_a_day_later([cube = random_cube()](const std::string& name) { return write(cube, name); });
}

TEST(Cube, has_the_documented_layout) {
  const Cube cube = random_cube();
  const RawFile file(write(cube));
  const hsize_t bins = cube.pings[0].gate.bins();
  EXPECT_EQ(raw_extent(file, "/pressure"), (std::vector<hsize_t>{3, 70, bins}));
  EXPECT_EQ(raw_extent(file, "/range"), (std::vector<hsize_t>{bins}));
  EXPECT_EQ(raw_extent(file, "/azimuth"), (std::vector<hsize_t>{70}));
  EXPECT_EQ(raw_extent(file, "/elevation"), (std::vector<hsize_t>{70}));
  EXPECT_EQ(raw_extent(file, "/pose"), (std::vector<hsize_t>{3, 4, 4}));
  EXPECT_EQ(raw_extent(file, "/time"), (std::vector<hsize_t>{3}));
  EXPECT_EQ(raw_extent(file, "/ping"), (std::vector<hsize_t>{3}));
  EXPECT_EQ(raw_text(file, "/pressure", "units"), "Pa");
  EXPECT_EQ(raw_text(file, "/range", "units"), "m");
  EXPECT_EQ(raw_text(file, "/azimuth", "units"), "rad");
  EXPECT_EQ(raw_text(file, "/elevation", "units"), "rad");
  EXPECT_EQ(raw_text(file, "/time", "units"), "s");
  EXPECT_EQ(raw_text(file, "/", "sonar"), "p900-45");
  EXPECT_EQ(raw_text(file, "/", "insonify_version"), "0.1.0");
  EXPECT_EQ(raw_number(file, "schema"), 1);
  EXPECT_EQ(raw_number(file, "sound_speed"), 1489.8);
  EXPECT_EQ(raw_number(file, "min_range"), 2);
}

// h5py and MATLAB read a compound {r, i} of two float32 as complex64.
TEST(Cube, keeps_pressure_as_compound_r_i_of_float32_in_chunks_of_one_ping) {
  const Cube cube = random_cube();
  const RawFile file(write(cube));
  const hid_t dataset = H5Dopen2(file, "/pressure", H5P_DEFAULT), type = H5Dget_type(dataset);
  EXPECT_EQ(H5Tget_class(type), H5T_COMPOUND);
  EXPECT_EQ(H5Tget_size(type), 8u);
  ASSERT_EQ(H5Tget_nmembers(type), 2);
  for (unsigned member = 0; member < 2; ++member) {
    char* name = H5Tget_member_name(type, member);
    EXPECT_STREQ(name, member == 0 ? "r" : "i");
    H5free_memory(name);
    const hid_t member_type = H5Tget_member_type(type, member);
    EXPECT_GT(H5Tequal(member_type, H5T_IEEE_F32LE), 0);
    EXPECT_EQ(H5Tget_member_offset(type, member), 4 * member);
    H5Tclose(member_type);
  }
  const hid_t properties = H5Dget_create_plist(dataset);
  hsize_t chunk[3] = {};
  EXPECT_EQ(H5Pget_chunk(properties, 3, chunk), 3);
  EXPECT_EQ(chunk[0], 1u);
  EXPECT_EQ(chunk[1], 64u);
  EXPECT_EQ(chunk[2], cube.pings[0].gate.bins());
  EXPECT_EQ(H5Pget_nfilters(properties), 0);
  std::vector<std::complex<float>> all(3 * 70 * chunk[2]);
  H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  EXPECT_EQ(all[(2 * 70 + 69) * chunk[2] + 5], cube.pings[2].pressure(69, 5));
  H5Pclose(properties);
  H5Tclose(type);
  H5Dclose(dataset);
}

TEST(Cube, has_bin_centres_as_range_and_poses_row_by_row) {
  const Cube cube = random_cube();
  const RawFile file(write(cube));
  const std::vector<double> range = raw_values(file, "/range"), pose = raw_values(file, "/pose");
  EXPECT_DOUBLE_EQ(range[0], 2.0055);
  EXPECT_DOUBLE_EQ(range[10], 2.1155);
  EXPECT_EQ(pose[16 + 3], 2);  // x of ping 1
  EXPECT_EQ(pose[16 + 7], 2);  // y
  EXPECT_EQ(pose[16 + 11], -3);
  EXPECT_EQ(pose[16 + 15], 1);
  EXPECT_EQ(pose[1], cube.pings[0].world_from_head.matrix()(0, 1));
}

TEST(Cube, keeps_the_water_of_pings_that_differ_from_it) {
  Cube cube = random_cube();
  const std::string plain = file_bytes(write(cube));
  for (const Ping& ping : read_cube(own_path("cube.h5")).pings) {
    EXPECT_EQ(ping.sound_speed, cube.sound_speed);
    EXPECT_EQ(ping.absorption_db_per_m, cube.absorption_db_per_m);
  }
  cube.pings[2].sound_speed = cube.sound_speed, cube.pings[2].absorption_db_per_m = cube.absorption_db_per_m;
  EXPECT_EQ(file_bytes(write(cube)), plain) << "what all have is said once";
  cube.pings[1].sound_speed = 1471.25, cube.pings[1].absorption_db_per_m = 0.28;
  const std::string path = write(cube);
  const Cube back = read_cube(path);
  EXPECT_EQ(back.pings[0].sound_speed, 1489.8);
  EXPECT_EQ(back.pings[1].sound_speed, 1471.25);
  EXPECT_EQ(back.pings[1].absorption_db_per_m, 0.28);
  EXPECT_EQ(back.pings[2].absorption_db_per_m, cube.absorption_db_per_m);
  EXPECT_EQ(read_cube(path, 1, 1).pings[0].sound_speed, 1471.25);
  EXPECT_EQ(read_track(path)[1].sound_speed, 1471.25);
  EXPECT_EQ(read_track(path)[1].absorption_db_per_m, 0.28);
  {
    const RawFile file(path);
    EXPECT_EQ(raw_extent(file, "/sound_speed"), (std::vector<hsize_t>{3}));
    EXPECT_EQ(raw_text(file, "/sound_speed", "units"), "m/s");
    EXPECT_EQ(raw_text(file, "/absorption_db_per_m", "units"), "dB/m");
    raw_overwrite(file, "/sound_speed", {1500, -1, 1500});
  }
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: /sound_speed = -1 m/s, must be finite and >= 0");
}

TEST(Cube, keeps_the_motion_of_pings) {
  Cube cube = random_cube();
  for (const Ping& ping : read_cube(write(cube)).pings) EXPECT_TRUE(ping.motion.none());
  EXPECT_LT(H5Lexists(RawFile(own_path("cube.h5")), "/velocity", H5P_DEFAULT), 1) << "all are at rest";
  cube.pings[1].motion = {{0.25, -1.5, 0.75}, {0.01, 0.02, -0.03}};
  const std::string path = write(cube);
  const Cube back = read_cube(path);
  EXPECT_TRUE(back.pings[0].motion.none());
  EXPECT_EQ(back.pings[1].motion.velocity, cube.pings[1].motion.velocity);
  EXPECT_EQ(back.pings[1].motion.turn_rate, cube.pings[1].motion.turn_rate);
  EXPECT_EQ(read_track(path)[1].motion.turn_rate, cube.pings[1].motion.turn_rate);
  {
    const RawFile file(path);
    EXPECT_EQ(raw_extent(file, "/turn_rate"), (std::vector<hsize_t>{3, 3}));
    EXPECT_EQ(raw_text(file, "/velocity", "units"), "m/s");
    EXPECT_EQ(raw_text(file, "/turn_rate", "units"), "rad/s");
    raw_overwrite(file, "/velocity", {0, 0, 0, 1, HUGE_VAL, 0, 0, 0, 0});
  }
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: /velocity of ping 1 =   1 inf   0 m/s, must be finite");
}

TEST(Cube, names_the_dataset_that_is_missing) {
  for (const char* name : {"/pressure", "/range", "/azimuth", "/elevation", "/pose", "/time", "/ping"}) {
    const std::string path = write(random_cube());
    { EXPECT_GE(H5Ldelete(RawFile(path), name, H5P_DEFAULT), 0); }
    EXPECT_EQ(error_of_cube(path), "content: cube.h5: dataset " + std::string(name) + " is missing");
  }
}

TEST(Cube, names_the_attribute_that_is_missing) {
  for (const char* name :
       {"sound_speed", "absorption_db_per_m", "centre_frequency", "bandwidth", "source_level_db", "seed", "tolerance",
        "insonify_version", "sonar", "beam_width", "elevation_width", "min_range", "max_range", "bin_size"}) {
    const std::string path = write(random_cube());
    { EXPECT_GE(H5Adelete(RawFile(path), name), 0); }
    EXPECT_EQ(error_of_cube(path), "content: cube.h5: attribute '" + std::string(name) + "' is missing");
  }
}

TEST(Cube, of_another_schema_names_both_versions) {
  const std::string path = write(random_cube());
  raw_set(RawFile(path), "schema", 7);
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: has cube schema 7, this version reads schema 1");
}

TEST(Cube, that_contradicts_itself_is_refused) {
  const std::string path = write(random_cube());
  raw_set(RawFile(path), "bin_size", 0.022);
  EXPECT_EQ(error_of_cube(path),
            "content: cube.h5: /pressure has 46 bins, but min_range, max_range and bin_size give 23");
  raw_set(RawFile(path), "bin_size", -1);
  EXPECT_EQ(error_of_cube(path).substr(0, 17), "content: cube.h5:");
  {
    const RawFile file(path);
    H5Ldelete(file, "/time", H5P_DEFAULT);
    H5Lcreate_hard(file, "/azimuth", file, "/time", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_EQ(error_of_cube(path), "content: cube.h5: /time has 70 entries, 3 expected from /pressure");
}

TEST(Cube, refuses_foreign_missing_and_truncated_files) {
  const std::string text = own_file("text.h5", "this is not HDF5\n");
  EXPECT_EQ(error_with_kind([&] { read_cube(text); }), "content: " + text + ": is not an HDF5 file");
  const std::string empty = own_file("empty.h5", "");
  EXPECT_EQ(error_with_kind([&] { read_cube(empty); }), "content: " + empty + ": is not an HDF5 file");
  const std::string missing = own_path("missing.h5");
  EXPECT_EQ(error_with_kind([&] { read_cube(missing); }), "file: " + missing + ": no such file; check the path");
  const std::string whole = read_text_file(write(random_cube()));
  const std::string cut = own_file("cut.h5", whole.substr(0, whole.size() / 2));
  const std::string said = error_with_kind([&] { read_cube(cut); });
  EXPECT_TRUE(said.starts_with("content: " + cut + ": is damaged or cut short: truncated file")) << said;
  EXPECT_TRUE(said.ends_with("; copy or export it again")) << said;
}

TEST(Cube, foreign_hdf5_is_not_a_cube) {
  const std::string path = own_path("foreign.h5");
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_EQ(error_with_kind([&] { read_cube(path); }),
            "content: " + path + ": is not a cube of insonify: attribute 'schema' is missing");
}

TEST(Cube, without_pings_or_with_unlike_ones_is_not_written) {
  const std::string path = own_path("cube.h5");
  const auto error_of_writing = [&](const Cube& cube) {
    return replaced(error_with_kind([&] { write_cube(path, cube); }), path, "cube.h5");
  };
  EXPECT_EQ(error_of_writing(random_cube(0)), "argument: write_cube: cube.h5: no pings, must be at least one");
  Cube cube = random_cube();
  cube.pings[1].fan.azimuth[3] += 1e-3;
  EXPECT_EQ(error_of_writing(cube),
            "argument: write_cube: cube.h5: ping 41 has another fan or gate than ping 40; "
            "write it to a cube of its own");
  cube = random_cube();
  cube.pings[2].pressure.resize(69, 46);
  EXPECT_EQ(error_of_writing(cube), "argument: write_cube: cube.h5: ping 42 has 69 beams x 46 bins, must have 70 x 46");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Cube, that_cannot_be_written_leaves_an_old_one_alone) {
  const std::string path = own_path("no/cube.h5");
  EXPECT_EQ(error_with_kind([&] { write_cube(path, random_cube()); }),
            "file: " + path + ": folder " + own_path("no") + " does not exist; create it first");
  const std::string old = own_file("old.h5", "old");
  EXPECT_THROW(write_cube(old, random_cube(0)), Error);
  EXPECT_EQ(read_text_file(old), "old");
  write_cube(old, random_cube());
  EXPECT_EQ(read_cube(old).pings.size(), 3u);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(old).parent_path()))
    ++files;
  EXPECT_EQ(files, 1u);
}

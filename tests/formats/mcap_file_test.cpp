// SPDX-License-Identifier: BSD-3-Clause
#include "formats/mcap_file.hpp"

#ifdef INSONIFY_TEST_LZ4
#include <lz4frame.h>
#endif
#ifdef INSONIFY_TEST_ZSTD
#include <zstd.h>
#endif

#include "formats/grey_fan.hpp"
#include "formats/ros_decoder.hpp"
#include "formats/ros_messages.hpp"
#include "support/test.hpp"

namespace {

/// Returns three beams: to starboard, ahead, to port; a bright sample in bin 4 of the port beam.
Ping log_ping() {
  Ping ping;
  ping.fan = make_fan(3, radians(90), radians(20), radians(15));
  ping.gate = {1, 2, 0.1};
  ping.world_from_head = pose_from_yaw_pitch_roll({10, 20, -3}, radians(90), 0, 0);
  ping.pressure = ComplexGridF::Constant(3, 10, std::complex<float>(0, 1e-3F));
  ping.pressure(2, 4) = 1;
  return ping;
}

}  // namespace

TEST(RosMessages, image_of_a_sonar_follows_its_frame_and_order) {
  const std::string path = own_path("log.mcap");
  const Ping ping = log_ping();
  const double most = static_cast<double>(level_db(ping).maxCoeff());
  {
    McapFile file(path);
    const RosType type = projected_sonar_image_type();
    const auto grey = file.add_topic("/grey", type.name, type.text, {{"white_db", "7"}});
    const auto linear = file.add_topic("/linear", type.name, type.text);
    const Tvg none{0, 0};
    file.add(grey, 5, projected_sonar_image(ping, 1777624200500000001, 4e5, 1480, none, {false, {most - 50, most}, 1}));
    file.add(linear, 6, projected_sonar_image(ping, 6, 4e5, 1480, none, {true, {}, 2}));
    file.finish();
  }
  const decode::McapContent read = decode::read_mcap(file_bytes(path));
  EXPECT_EQ(read.metadata.at("/grey").at("white_db"), "7");
  ASSERT_EQ(read.messages.size(), 2U);
  const decode::RosMessage& grey = read.messages[0].content;
  EXPECT_EQ(grey.one("header.stamp.sec"), 1777624200);
  EXPECT_EQ(grey.one("header.stamp.nanosec"), 500000001);
  EXPECT_EQ(grey.texts.at("header.frame_id"), "head_sonar");
  EXPECT_EQ(grey.one("ping_info.frequency"), 4e5);
  EXPECT_EQ(grey.one("ping_info.sound_speed"), 1480);
  EXPECT_NEAR(grey.one("ping_info.tx_beamwidths"), radians(15), 1e-6);
  EXPECT_NEAR(grey.one("ping_info.rx_beamwidths"), radians(20), 1e-6);
  // azimuth = atan2(-y, z): positive to port; the beams lie in the plane of y and z.
  for (std::size_t b = 0; b < 3; ++b) {
    const std::string name = "beam_directions[" + std::to_string(b) + "].";
    EXPECT_NEAR(std::atan2(-grey.one(name + "y"), grey.one(name + "z")), ping.fan.azimuth[b], 1e-12);
    EXPECT_NEAR(grey.one(name + "x"), 0, 1e-12);
  }
  EXPECT_NEAR(grey.numbers.at("ranges").at(4), 1.45, 1e-6);
  EXPECT_EQ(grey.one("image.dtype"), 0);
  EXPECT_EQ(grey.one("image.is_bigendian"), 0);
  EXPECT_EQ(grey.one("image.beam_count"), 3);
  const std::vector<double>& data = grey.numbers.at("image.data");
  ASSERT_EQ(data.size(), 30U);
  for (std::size_t i = 0; i < data.size(); ++i) EXPECT_EQ(data[i], i == 4 * 3 + 2 ? 255 : 0) << i;  // range by range

  const decode::RosMessage& linear = read.messages[1].content;
  EXPECT_EQ(linear.one("image.dtype"), 4);
  const std::vector<double>& bytes = linear.numbers.at("image.data");
  ASSERT_EQ(bytes.size(), 120U);
  const auto at = [&](std::size_t i) {
    return bytes[4 * i] + 256 * (bytes[4 * i + 1] + 256 * (bytes[4 * i + 2] + 256 * bytes[4 * i + 3]));
  };
  EXPECT_NEAR(at(14) / 4294967295.0, 0.5, 1e-6);
  EXPECT_NEAR(at(13) / 4294967295.0, 0.0005, 1e-9);
}

// Pixels are much longer than bins: one sample of each would leave out most of them.
TEST(RosMessages, fan_shows_a_loud_bin_wherever_it_is) {
  Ping ping = log_ping();
  const Eigen::Index bins = ping.pressure.cols();
  for (Eigen::Index bin = 0; bin < bins; ++bin) {
    ping.pressure.setConstant(1e-4F);
    ping.pressure(1, bin) = 1;
    const double most = static_cast<double>(level_db(ping).maxCoeff());
    EXPECT_GT((grey_fan(ping, {0, 0}, {most - 60, most - 20}, 4).grey > 128).count(), 0) << bin;
  }
}

TEST(RosMessages, fan_shows_port_on_the_left_and_points_stand_in_the_world) {
  const std::string path = own_path("fan.mcap");
  const Ping ping = log_ping();
  const double most = static_cast<double>(level_db(ping).maxCoeff());
  {
    McapFile file(path);
    const auto image = file.add_topic("/fan", image_type().name, image_type().text);
    const auto cloud = file.add_topic("/points", point_cloud_type().name, point_cloud_type().text);
    const auto tf = file.add_topic("/tf", transforms_type().name, transforms_type().text);
    // A pixel also holds what is beside the loud sample, so that none is as loud.
    file.add(image, 1, fan_image(ping, 1, {0, 0}, {most - 50, most - 20}, 40));
    const std::vector<Eigen::Vector3d> at{{1e6 + 1, 2, -3}, {1e6 - 4, 5, 6.5}};
    file.add(cloud, 2, point_cloud(decode::soundings_at(at, {101, 88.5F}), {1e6, 0, 0}, 2));
    file.add(tf, 3, head_transform(ping.world_from_head, {1, 2, 3}, 3));
    file.add(tf, 4, sonar_transform(4));
    const auto fix = file.add_topic("/fix", nav_sat_fix_type().name, nav_sat_fix_type().text);
    file.add(fix, 5, nav_sat_fix({radians(54.1), radians(7.9), -12.5}, 5));
    file.finish();
  }
  const decode::McapContent read = decode::read_mcap(file_bytes(path));
  const decode::RosMessage& fan = read.messages.at(0).content;
  EXPECT_EQ(fan.texts.at("encoding"), "mono8");
  EXPECT_EQ(fan.one("height"), 40);
  const double width = fan.one("width");
  EXPECT_EQ(fan.one("step"), width);
  double row = 0, column = 0, bright = 0;
  for (std::size_t i = 0; i < fan.numbers.at("data").size(); ++i)
    if (fan.numbers.at("data")[i] == 255)
      row += std::floor(static_cast<double>(i) / width), column += std::fmod(static_cast<double>(i), width), ++bright;
  ASSERT_GT(bright, 0);
  // 1.45 m at 30 degrees to port, pixels of 5 cm, the head below the middle of the last row.
  EXPECT_NEAR(row / bright, 40 - 1.45 * std::cos(radians(30)) / 0.05, 1.5);
  EXPECT_NEAR(column / bright, width / 2 - 1.45 * std::sin(radians(30)) / 0.05, 1.5);

  const decode::RosMessage& cloud = read.messages.at(1).content;
  EXPECT_EQ(cloud.one("width"), 2);
  EXPECT_EQ(cloud.one("point_step"), 40);
  EXPECT_EQ(cloud.texts.at("fields[3].name"), "intensity");
  EXPECT_EQ(cloud.one("fields[2].offset"), 8);
  EXPECT_EQ(cloud.one("fields[0].datatype"), 7);
  std::string raw;
  for (const double byte : cloud.numbers.at("data")) raw.push_back(static_cast<char>(byte));
  decode::Cursor points(raw);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const float n = static_cast<float>(i);
    for (const float expected : {1 - 5 * n, 2 + 3 * n, -3 + 9.5F * n, 101 - 12.5F * n, 12.5F + n, 0.25F, 1.5F})
      EXPECT_EQ(points.float32(), expected);
    EXPECT_EQ(points.unsigned_little(4), i + 7);
    EXPECT_EQ(points.unsigned_little(4), 2U);  // by phase
    EXPECT_EQ(points.unsigned_little(4), 2 * i);
  }
  for (std::size_t k = 0; k < std::size(ros_point_fields); ++k) {
    const std::string name = "fields[" + std::to_string(k) + "].";
    EXPECT_EQ(cloud.texts.at(name + "name"), ros_point_fields[k].name);
    EXPECT_EQ(cloud.one(name + "offset"), 4 * static_cast<double>(k));
    EXPECT_EQ(cloud.one(name + "datatype"), ros_point_fields[k].type == std::string("float32") ? 7 : 6);
  }

  const decode::RosMessage& tf = read.messages.at(2).content;
  EXPECT_EQ(tf.texts.at("transforms[0].header.frame_id"), "world");
  EXPECT_EQ(tf.texts.at("transforms[0].child_frame_id"), "head");
  EXPECT_EQ(tf.one("transforms[0].transform.translation.y"), 18);
  EXPECT_NEAR(tf.one("transforms[0].transform.rotation.z"), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(tf.one("transforms[0].transform.rotation.w"), std::sqrt(0.5), 1e-12);
  // Z of head_sonar lies ahead, X up.
  const decode::RosMessage& fixed = read.messages.at(3).content;
  EXPECT_EQ(fixed.texts.at("transforms[0].header.frame_id"), "head");
  EXPECT_EQ(fixed.texts.at("transforms[0].child_frame_id"), "head_sonar");
  const auto part = [&](const char* name) {
    return fixed.one(std::string("transforms[0].transform.rotation.") + name);
  };
  const Eigen::Quaterniond turn(part("w"), part("x"), part("y"), part("z"));
  EXPECT_LT((turn * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((turn * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  const decode::RosMessage& fix = read.messages.at(4).content;
  EXPECT_NEAR(fix.one("latitude"), 54.1, 1e-12);
  EXPECT_NEAR(fix.one("longitude"), 7.9, 1e-12);
  EXPECT_EQ(fix.one("altitude"), -12.5);
  EXPECT_EQ(fix.one("status.status"), 0);
  EXPECT_EQ(fix.one("status.service"), 1);
  EXPECT_EQ(fix.numbers.at("position_covariance").size(), 9U);
}

TEST(McapFile, indexes_many_messages_in_chunks) {
  const std::string path = own_path("many.mcap");
  {
    McapFile file(path);
    const auto a = file.add_topic("/a", "std_msgs/msg/Blob", "uint8[] data\n");
    const auto b = file.add_topic("/b", "std_msgs/msg/Blob", "uint8[] data\n");
    for (std::uint64_t i = 0; i < 300; ++i) {
      std::string blob("\0\1\0\0", 4);
      const auto size = static_cast<std::uint32_t>(10000 + i);
      for (int k = 0; k < 4; ++k) blob.push_back(static_cast<char>(size >> (8 * k) & 0xff));
      file.add(i % 3 == 0 ? a : b, 1000 + i, blob + std::string(size, static_cast<char>(i)));
    }
    file.finish();
  }
  const std::string bytes = file_bytes(path);
  const decode::McapContent read = decode::read_mcap(bytes);
  EXPECT_EQ(read.chunks, 3U);
  ASSERT_EQ(read.messages.size(), 300U);
  std::set<std::uint64_t> times;
  for (const decode::McapMessage& m : read.messages) {
    const std::uint64_t i = m.time - 1000;
    times.insert(i);
    EXPECT_EQ(m.topic, i % 3 == 0 ? "/a" : "/b");
    EXPECT_EQ(m.content.numbers.at("data").size(), 10000 + i);
  }
  EXPECT_EQ(times.size(), 300U);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 500)
    EXPECT_THROW(decode::read_mcap(bytes.substr(0, size)), std::runtime_error) << size;
  std::string spoilt = bytes;
  spoilt[bytes.size() / 2] = static_cast<char>(spoilt[bytes.size() / 2] ^ 1);
  EXPECT_THROW(decode::read_mcap(spoilt), std::runtime_error);
}

namespace {

/// Unpacks a chunk by the library of its compression.
std::string unpacked(const std::string& compression, const std::string& bytes, std::uint64_t size) {
  std::string plain(size, '\0');
#ifdef INSONIFY_TEST_LZ4
  if (compression == "lz4") {
    LZ4F_dctx* context = nullptr;
    LZ4F_createDecompressionContext(&context, LZ4F_VERSION);
    std::size_t made = plain.size(), used = bytes.size();
    const std::size_t left = LZ4F_decompress(context, plain.data(), &made, bytes.data(), &used, nullptr);
    LZ4F_freeDecompressionContext(context);
    if (left != 0 || made != size || used != bytes.size()) throw std::runtime_error("no frame of LZ4");
    return plain;
  }
#endif
#ifdef INSONIFY_TEST_ZSTD
  if (compression == "zstd") {
    if (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != size ||
        ZSTD_decompress(plain.data(), size, bytes.data(), bytes.size()) != size)
      throw std::runtime_error("no frame of Zstandard");
    return plain;
  }
#endif
  throw std::runtime_error("compression '" + compression + "'");
}

/// Writes 40 messages of 50 kB each.
std::string forty_messages(McapCompression compression) {
  const std::string path = own_path("packed.mcap");
  McapFile file(path, compression);
  file.add_metadata("insonify", {{"sonar", "any"}, {"version", "1"}});
  const auto topic = file.add_topic("/a", "std_msgs/msg/Blob", "uint8[] data\n");
  for (std::uint64_t i = 0; i < 40; ++i)
    file.add(topic, i, std::string("\0\1\0\0\x50\xc3\0\0", 8) + std::string(50000, static_cast<char>(i)));
  file.finish();
  return file_bytes(path);
}

}  // namespace

TEST(McapFile, compresses_chunks_where_the_library_is_there) {
  const std::string plain = forty_messages(McapCompression::none);
  EXPECT_TRUE(has_compression(McapCompression::none));
  for (const auto& [compression, name] :
       {std::pair(McapCompression::lz4, "lz4"), std::pair(McapCompression::zstd, "zstd")}) {
    if (!has_compression(compression)) {
      EXPECT_THAT(error_of([&, which = compression] { McapFile(own_path("no.mcap"), which); }),
                  HasSubstr("whose library this build does not have"));
      continue;
    }
    const std::string bytes = forty_messages(compression);
    EXPECT_LT(bytes.size(), plain.size() / 20) << name;
    EXPECT_EQ(bytes, forty_messages(compression));
    const decode::McapContent read = decode::read_mcap(bytes, unpacked);
    EXPECT_EQ(read.compressions, std::set<std::string>{name});
    EXPECT_EQ(read.chunks, 2U);
    ASSERT_EQ(read.messages.size(), 40U);
    for (const decode::McapMessage& m : read.messages) {
      ASSERT_EQ(m.content.numbers.at("data").size(), 50000U);
      EXPECT_EQ(m.content.numbers.at("data").back(), static_cast<double>(m.time));
    }
  }
}

TEST(McapFile, metadata_of_the_file_is_indexed) {
  const decode::McapContent read = decode::read_mcap(forty_messages(McapCompression::none));
  using Pairs = std::map<std::string, std::string>;
  EXPECT_EQ(read.records, (std::map<std::string, Pairs>{{"insonify", {{"sonar", "any"}, {"version", "1"}}}}));
  EXPECT_EQ(read.compressions, std::set<std::string>{""});
}

// The bytes of a file without messages, from the specification.
TEST(McapFile, begins_and_ends_as_the_specification_says) {
  const std::string path = own_path("empty.mcap");
  McapFile(path).finish();
  const std::string bytes = file_bytes(path);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x89MCAP0\r\n", 8));
  EXPECT_EQ(bytes.substr(8, 9 + 4 + 4 + 4 + 8),
            std::string("\x01\x14\0\0\0\0\0\0\0\x04\0\0\0ros2\x08\0\0\0insonify", 29));
  EXPECT_EQ(decode::read_mcap(bytes).messages.size(), 0U);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(decode::read_mcap(bytes.substr(0, size)), std::runtime_error) << size;
}

// SPDX-License-Identifier: BSD-3-Clause
// MCAP files as the npm packages @mcap/core and @foxglove/rosmsg2-serialization read them: every message, number by
// number as the decoder of these tests.
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "formats/mcap_file.hpp"
#include "formats/ros_decoder.hpp"
#include "formats/ros_messages.hpp"
#include "support/test.hpp"

namespace {

using nlohmann::json;

/// Adds all numbers and texts of a message under the names of decode::RosMessage.
void flatten(const json& value, const std::string& name, decode::RosMessage& message) {
  const std::string prefix = name.empty() ? "" : name + ".";
  if (value.is_object()) {
    for (const auto& [key, member] : value.items())
      flatten(member, prefix + (key == "nsec" ? "nanosec" : key), message);
  } else if (value.is_array()) {
    if (value.empty()) message.numbers[name];
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten(value[i], value[i].is_object() ? name + "[" + std::to_string(i) + "]" : name, message);
  } else if (value.is_string()) {
    message.texts[name] = value.get<std::string>();
  } else {
    message.numbers[name].push_back(value.is_boolean() ? static_cast<double>(value.get<bool>()) : value.get<double>());
  }
}

/// Returns the file as the packages read it, or their error.
json read_by_packages(const std::string& path) {
  const std::string out = own_path("messages.json"), folder = INSONIFY_NPM_READER;
  const std::string command =
      "NODE_PATH='" INSONIFY_NODE_MODULES "' node '" + folder + "/read_mcap.cjs' '" + path + "' > '" + out + "' 2>&1";
  const int code = std::system(command.c_str());
  const std::string text = file_bytes(out);
  if (code != 0) return {{"error", text}};
  return json::parse(text);
}

class McapNpm : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v node >/dev/null") != 0) GTEST_SKIP() << "node is not installed";
    if (!std::filesystem::exists(INSONIFY_NODE_MODULES "/@mcap/core"))
      GTEST_SKIP() << "the npm packages of tests/formats/npm are not in " INSONIFY_NODE_MODULES
                      "; tests/run.sh installs them where npm can";
  }
};

Ping npm_ping() {
  Ping ping;
  ping.number = 3;
  ping.fan = make_fan(5, radians(90), radians(20), radians(15));
  ping.gate = {1, 2, 0.1};
  ping.world_from_head = pose_from_yaw_pitch_roll({10, 20, -3}, 0.3, 0.2, 0.1);
  ping.pressure = ComplexGridF::Constant(5, 10, std::complex<float>(0, 1e-3F));
  ping.pressure(4, 4) = 1;
  return ping;
}

std::string written_log(const char* name, McapCompression compression = McapCompression::none) {
  const std::string path = own_path(name);
  const Ping ping = npm_ping();
  const double most = static_cast<double>(level_db(ping).maxCoeff());
  McapFile file(path, compression);
  file.add_metadata("insonify", {{"sonar", "any"}});
  const auto add = [&](const char* topic, const RosType& type) {
    return file.add_topic(topic, type.name, type.text, {{"reference", "dB re 1 uPa at 1 m"}});
  };
  const auto image = add("/sonar/image", projected_sonar_image_type()), fan = add("/sonar/fan", image_type());
  const auto points = add("/sonar/points", point_cloud_type()), tf = add("/tf", transforms_type());
  const auto fix = add("/sonar/fix", nav_sat_fix_type());
  for (std::uint64_t i = 0; i < 60; ++i) {  // several chunks
    const std::uint64_t time = 1777624200500000000 + i * 100000000;
    const std::vector<Eigen::Vector3d> at{{1, 2 + static_cast<double>(i), -3}, {-4, 5, 6.5}};
    file.add(image, time, projected_sonar_image(ping, time, 4e5, 1480, {0, 0}, {i % 2 == 1, {most - 50, most}, 2}));
    file.add(fan, time, fan_image(ping, time, {0, 0}, {most - 50, most}, 160));
    file.add(points, time, point_cloud(decode::soundings_at(at, {101, 88.5F}), {0, 0, 0}, time));
    file.add(tf, time, head_transform(ping.world_from_head, {1, 2, 3}, time));
    file.add(fix, time, nav_sat_fix({0.9, 0.1, -3}, time));
  }
  file.finish();
  return path;
}

}  // namespace

TEST_F(McapNpm, read_every_number_of_every_message) {
  const std::string path = written_log("log.mcap");
  const json read = read_by_packages(path);
  ASSERT_FALSE(read.contains("error")) << read["error"];
  EXPECT_EQ(read["profile"], "ros2");
  const decode::McapContent own = decode::read_mcap(file_bytes(path));
  EXPECT_GT(own.chunks, 1U);
  ASSERT_EQ(read["messages"].size(), 300U);
  std::map<std::pair<std::string, std::string>, const decode::RosMessage*> expected;
  for (const decode::McapMessage& m : own.messages) expected[{m.topic, std::to_string(m.time)}] = &m.content;
  ASSERT_EQ(expected.size(), 300U);
  for (const json& message : read["messages"]) {
    const decode::RosMessage& mine = *expected.at({message["topic"], message["time"]});
    decode::RosMessage theirs;
    flatten(message["content"], "", theirs);
    EXPECT_EQ(theirs.numbers, mine.numbers) << message["topic"];
    EXPECT_EQ(theirs.texts, mine.texts) << message["topic"];
    EXPECT_EQ(message["metadata"]["reference"], "dB re 1 uPa at 1 m");
  }
  EXPECT_EQ(read["messages"][0]["type"].get<std::string>().substr(0, 4), "mari");
}

TEST_F(McapNpm, unpack_chunks_and_know_the_metadata_of_the_file) {
  const json plain = read_by_packages(written_log("plain.mcap"));
  EXPECT_EQ(plain["metadata"], json({{"insonify", {{"sonar", "any"}}}}));
  EXPECT_EQ(plain["compressions"], json({""}));
  if (!std::filesystem::exists(INSONIFY_NODE_MODULES "/fzstd") ||
      !std::filesystem::exists(INSONIFY_NODE_MODULES "/lz4js"))
    GTEST_SKIP() << "fzstd and lz4js are not installed";
  for (const auto& [compression, name] :
       {std::pair(McapCompression::lz4, "lz4"), std::pair(McapCompression::zstd, "zstd")}) {
    if (!has_compression(compression)) continue;
    const json packed = read_by_packages(written_log("packed.mcap", compression));
    ASSERT_FALSE(packed.contains("error")) << packed["error"];
    EXPECT_EQ(packed["compressions"], json({name}));
    EXPECT_EQ(packed["messages"], plain["messages"]);
    EXPECT_EQ(packed["metadata"], plain["metadata"]);
  }
}

TEST_F(McapNpm, refuse_a_changed_byte_and_a_cut_file) {
  const std::string bytes = file_bytes(written_log("whole.mcap"));
  std::string spoilt = bytes;
  spoilt[bytes.size() / 2] = static_cast<char>(spoilt[bytes.size() / 2] ^ 1);
  for (const std::string& bad : {spoilt, bytes.substr(0, bytes.size() - 1), bytes.substr(0, bytes.size() / 2)})
    EXPECT_TRUE(read_by_packages(own_file("bad.mcap", bad)).contains("error"));
}

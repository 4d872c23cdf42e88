// SPDX-License-Identifier: BSD-3-Clause
// Reads back what `export --to mcap` writes of a ball to port of the head, ahead of it and above the bed.
#include "formats/mcap_file.hpp"
#include "formats/ros_decoder.hpp"
#include "tool/ball_fixture.hpp"

TEST_F(ExportProducts, mcap_has_it_in_image_points_and_transforms) {
  succeed("export out --to mcap --start-utc 2026-05-01T08:30:00Z -o ball.mcap -q");
  const decode::McapContent read = decode::read_mcap(read_bytes("ball.mcap"));
  ASSERT_EQ(read.messages.size(), 5U);  // image, fan, points, and both transforms
  for (const decode::McapMessage& message : read.messages) {
    EXPECT_EQ(message.time, 1777624200000000000U);
    if (message.topic == "/sonar/image") {
      const std::vector<double>& data = message.content.numbers.at("image.data");
      const auto brightest = static_cast<std::size_t>(std::max_element(data.begin(), data.end()) - data.begin());
      const std::string beam = "beam_directions[" + std::to_string(brightest % 65) + "].";
      EXPECT_NEAR(std::atan2(-message.content.one(beam + "y"), message.content.one(beam + "z")), radians(24),
                  radians(2.1));
      const double range = message.content.numbers.at("ranges").at(brightest / 65);
      EXPECT_GT(range, least - 0.02);
      EXPECT_LT(range, most);
    } else if (message.topic == "/tf") {
      EXPECT_NEAR(message.content.one("transforms[0].transform.translation.z"), pose.translation().z(), 1e-9);
    } else if (message.topic == "/tf_static") {
      EXPECT_EQ(message.content.texts.at("transforms[0].child_frame_id"), "head_sonar");
    } else if (message.topic == "/sonar/points") {
      EXPECT_GE(message.content.one("width"), 1);
    }
  }
  EXPECT_EQ(read.metadata.at("/sonar/image").at("law"), "level = black_db + value / 255 (white_db - black_db)");
  EXPECT_THAT(read.metadata.at("/tf_static").at("offered_qos_profiles"), HasSubstr("durability: 1"));
  // Levels by that law are within half a step of those of the cube.
  const Cube cube = cube_of("out");
  const Grid<float> level = range_compensated_level_db(cube.pings[0], cube.absorption_db_per_m);
  const double black = std::stod(read.metadata.at("/sonar/image").at("black_db")),
               white = std::stod(read.metadata.at("/sonar/image").at("white_db")), half = (white - black) / 255 / 2;
  double off = 0;
  int compared = 0;
  for (const decode::McapMessage& message : read.messages)
    if (message.topic == "/sonar/image") {
      const std::vector<double>& data = message.content.numbers.at("image.data");
      for (Eigen::Index n = 0; n < level.cols(); ++n)
        for (Eigen::Index b = 0; b < level.rows(); ++b)
          if (const double value = data[static_cast<std::size_t>(n * level.rows() + b)]; value > 0 && value < 255) {
            const double difference = black + value / 255 * (white - black) - static_cast<double>(level(b, n));
            EXPECT_LE(std::abs(difference), 1.001 * half);
            off += difference, ++compared;
          }
    }
  ASSERT_GT(compared, 1000);
  EXPECT_LT(std::abs(off / compared), 0.1 * half);  // without a bias
}

// The file says what made it, and what its grey values are, in a record of its own; compressed it is smaller, or says why
// it is not.
TEST_F(ExportProducts, mcap_has_metadata_and_compressed_chunks) {
  const std::string to = "export out --to mcap --start-utc 2026-05-01T08:30:00Z -o ";
  succeed(to + "plain.mcap -q");
  const decode::McapContent content = decode::read_mcap(read("plain.mcap"));
  ASSERT_EQ(content.records.size(), 1U);
  std::map<std::string, std::string> about = content.records.at("insonify");
  EXPECT_EQ(about["name"], "insonify");
  EXPECT_THAT(about["version"], testing::MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+"));
  EXPECT_EQ(about["sonar"], cube_of("out").sonar);
  EXPECT_EQ(about["start_utc"], "2026-05-01T08:30:00Z");
  for (const auto& [key, value] : content.metadata.at("/sonar/image")) EXPECT_EQ(about[key], value) << key;
  EXPECT_NEAR(std::stod(about["white_db"]) - std::stod(about["black_db"]), 80, 1e-9);
  for (const auto& [compression, name] :
       {std::pair(McapCompression::lz4, "lz4"), std::pair(McapCompression::zstd, "zstd")}) {
    const std::string file = std::string(name) + ".mcap";
    const ToolResult said = run(to + file + " --compression " + name);
    EXPECT_EQ(said.exit_code, 0);
    if (has_compression(compression)) {
      EXPECT_LT(read(file).size(), read("plain.mcap").size());
      const decode::Unpack none = [](const std::string& used, const std::string&, std::uint64_t) -> std::string {
        throw std::runtime_error("packed by " + used);
      };
      EXPECT_THAT([&] { decode::read_mcap(read(file), none); },
                  testing::ThrowsMessage<std::runtime_error>(std::string("packed by ") + name));
    } else {
      EXPECT_EQ(read(file), read("plain.mcap"));
      EXPECT_THAT(said.err, testing::AllOf(HasSubstr("is not compressed"), HasSubstr(name)));
    }
  }
}

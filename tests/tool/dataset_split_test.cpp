// SPDX-License-Identifier: BSD-3-Clause
// Tests which images go into train, val and test of a data set.
#include "support/test.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/dataset_fixture.hpp"

TEST_F(DatasetRun, splits_by_scene) {
  have("plane.ply", "make-scene plane --size 20,20 --points 20000");
  for (const std::string scene : {"plane", "harbour"})
    succeed("ping " + scene +
            ".ply --sonar p900-45 --set sonar.beams=32 --pose=0,0,3,0,15,0 --range 2:15 --no-picture -q --keep "
            "contributors -o " +
            scene);
  succeed("dataset plane harbour survey -o set --split 50:50:0");
  std::map<std::string, std::set<std::string>> splits_of;
  std::istringstream lines(read("set/meta.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json meta = nlohmann::json::parse(line);
    splits_of[meta["scene"]].insert(meta["split"].get<std::string>());
  }
  EXPECT_EQ(splits_of.size(), 2U);
  EXPECT_EQ(splits_of["plane.ply"].size(), 1U);
  // Each share above 0 has a scene, if there are enough.
  EXPECT_THAT(succeed("dataset plane harbour -o uneven --split 75:25:0"), HasSubstr("(1 train, 1 val, 0 test)"));
  for (const std::string form : {"polar", "fan"}) {
    EXPECT_THAT(read("set/" + form + "/data.yaml"), testing::StartsWith("train: train.txt\nval: val.txt\nnames:\n"));
    for (const std::string split : {"train", "val"}) {
      std::istringstream names(read("set/" + form + "/" + split + ".txt"));
      for (std::string name; std::getline(names, name);)
        EXPECT_TRUE(file_exists(path("set/" + form + "/" + name))) << name;
    }
  }
  EXPECT_NE(splits_of["plane.ply"], splits_of["harbour.ply"]);
}

// A scene has one part; legs, stretches of track and pings divide it, and what they share is said.
TEST_F(DatasetRun, splits_by_legs_regions_and_pings_and_says_what_they_share) {
  const auto split_of = [&](const std::string& options) {
    succeed("dataset survey -o set --force " + options);
    std::string parts;
    std::istringstream lines(read("set/meta.jsonl"));
    for (std::string line; std::getline(lines, line);)
      parts += nlohmann::json::parse(line)["split"].get<std::string>().front();
    return parts;
  };
  ToolResult one = run("dataset survey -o set --split 50:50:0");
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_THAT(one.err, testing::AllOf(HasSubstr("no image is in val: --split 50:50:0 needs more scenes"),
                                      HasSubstr("--split-by leg, region or ping")));
  EXPECT_THAT(one.out, HasSubstr("4 images (4 train, 0 val, 0 test)"));

  EXPECT_EQ(split_of("--split-by region --split 50:25:25"), "ttvt");  // train, train, val, test
  EXPECT_THAT(read("set/README.md"), HasSubstr("| val | 1 | 1 |"));
  EXPECT_THAT(read("set/polar/val.txt"), HasSubstr("000_000002.png"));
  EXPECT_THAT(read("set/polar/test.txt"), HasSubstr("000_000003.png"));
  const std::string drawn = split_of("--split-by ping --split 50:50:0");
  EXPECT_EQ(std::count(drawn.begin(), drawn.end(), 't'), 2);
  EXPECT_EQ(split_of("--split-by ping --split 50:50:0"), drawn);

  // Legs of a mission: from 2 s on the second one.
  write("legs.toml",
        replaced(mission(), "[randomise]", "[[leg]]\nname = \"out\"\nto_s = 2\n[[leg]]\nname = \"on\"\n[randomise]"));
  succeed("survey legs.toml -o legs -q");
  const ToolResult by_leg = run("dataset legs -o of_legs --split-by leg --split 50:50:0");
  EXPECT_EQ(by_leg.exit_code, 0);
  EXPECT_THAT(by_leg.err, HasSubstr("2 of 2 images of val were taken within their range of an image of train"));
  EXPECT_THAT(read("of_legs/fan/train.txt"), testing::AllOf(HasSubstr("000_000000.png"), HasSubstr("000_000001.png")));
  EXPECT_THAT(read("of_legs/fan/val.txt"), testing::AllOf(HasSubstr("000_000002.png"), HasSubstr("000_000003.png")));
  const auto said = nlohmann::json::parse(succeed("dataset legs -o of_legs --split-by leg --json --force -q"));
  EXPECT_EQ(said["splits"]["val"]["near_train"], 2);
  expect_refused("dataset survey -o none --split-by beam", 2, {"--split-by", "beam"});
}

// SPDX-License-Identifier: BSD-3-Clause
// Data sets to learn from, opened by readers of their own: the formats as their definitions have them.
#include <nlohmann/json.hpp>

#include "files/sha256.hpp"
#include "support/test.hpp"
#include "tool/dataset_fixture.hpp"

namespace {

/// A mask of COCO: run lengths down the columns, the first of pixels outside.
Grid<std::uint8_t> decoded_mask(const nlohmann::json& segmentation) {
  const auto rows = segmentation["size"][0].get<Eigen::Index>(), columns = segmentation["size"][1].get<Eigen::Index>();
  Grid<std::uint8_t> mask = Grid<std::uint8_t>::Zero(rows, columns);
  Eigen::Index at = 0;
  std::uint8_t value = 0;
  for (const auto& count : segmentation["counts"]) {
    for (Eigen::Index end = at + count.get<Eigen::Index>(); at < end; ++at) mask(at % rows, at / rows) = value;
    value ^= 1;
  }
  EXPECT_EQ(at, rows * columns);
  return mask;
}

}  // namespace

TEST_F(DatasetRun, holds_images_masks_and_boxes_that_agree) {
  succeed("dataset survey -o set --stuff sand --min-contrast=-1000");  // all objects have boxes
  const nlohmann::json manifest = manifest_of("set");
  const auto classes = manifest["classes"].get<std::vector<std::string>>();
  EXPECT_EQ(classes[0], "nothing");
  EXPECT_EQ(classes[1], "shadow");
  std::set<int> annotation_ids;
  for (const std::string form : {"polar", "fan"}) {
    const nlohmann::json c = coco(form);
    ASSERT_EQ(c["images"].size(), 4U);
    std::set<int> boxed;
    for (const auto& a : c["annotations"]) boxed.insert(a["category_id"].get<int>());
    for (const auto& category : c["categories"]) {
      EXPECT_EQ(category["name"], classes.at(category["id"]));
      EXPECT_NE(category["name"], "sand");  // no box has it
    }
    EXPECT_LE(boxed.size(), c["categories"].size());
    EXPECT_EQ(c["annotations"].size(), manifest["boxes"][form].get<std::size_t>());
    std::map<int, std::string> name_of;
    std::size_t areas = 0;
    for (const auto& image : c["images"]) {
      const std::string name = image["file_name"];
      name_of[image["id"]] = name;
      const GreyPicture picture = png(form + "/images/" + name);
      EXPECT_EQ(picture.bits, form == "polar" ? 16 : 8);
      EXPECT_EQ(picture.value.cols(), image["width"].get<Eigen::Index>());
      EXPECT_EQ(picture.value.rows(), image["height"].get<Eigen::Index>());
      EXPECT_EQ(png(form + "/masks/" + name).value.rows(), picture.value.rows());
    }
    for (const auto& a : c["annotations"]) {
      EXPECT_TRUE(annotation_ids.insert(a["id"].get<int>()).second);
      const std::string name = name_of.at(a["image_id"]);
      const Grid<std::uint8_t> mask = decoded_mask(a["segmentation"]);
      const Grid<std::uint16_t> category = png(form + "/masks/" + name).value,
                                instance = png(form + "/instances/" + name).value;
      EXPECT_NE(classes.at(a["category_id"]), "sand");
      // Area, box and both masks say the same.
      const auto number = a["instance"].get<std::uint16_t>();
      EXPECT_TRUE(((mask == 1) == (instance == number)).all());
      EXPECT_EQ(mask.cast<int>().sum(), a["area"].get<int>());
      EXPECT_GT(2 * (mask == 1 && category == a["category_id"].get<std::uint16_t>()).count(), a["area"].get<int>());
      const auto box = a["bbox"].get<std::vector<Eigen::Index>>();
      EXPECT_EQ(mask.block(box[1], box[0], box[3], box[2]).cast<int>().sum(), a["area"].get<int>());
      EXPECT_GT(mask.row(box[1]).maxCoeff(), 0);
      EXPECT_GT(mask.col(box[0] + box[2] - 1).maxCoeff(), 0);
      areas += a["area"].get<std::size_t>();
    }
    // Classes add up: what has an instance is in an annotation.
    std::size_t instances = 0;
    for (const auto& [id, name] : name_of)
      instances += static_cast<std::size_t>((png(form + "/instances/" + name).value > 0).count());
    EXPECT_EQ(areas, instances) << form;
    EXPECT_GT(areas, 0U);
  }
}

// Loads a data set as training programs do, where pycocotools is installed: Debian 12 has no package of it.
TEST_F(DatasetRun, is_loaded_by_pycocotools) {
  if (std::system("python3 -c 'import pycocotools, numpy' 2>/dev/null") != 0)
    GTEST_SKIP() << "pycocotools is not installed";
  succeed("dataset survey -o set");
  write("load.py", R"(import sys
import numpy
from pycocotools.coco import COCO
for form in ("polar", "fan"):
    coco = COCO("set/%s/annotations/instances_train.json" % form)
    assert len(coco.getImgIds()) == 4 and len(coco.getAnnIds()) > 0
    for a in coco.loadAnns(coco.getAnnIds()):
        mask = coco.annToMask(a)
        rows, columns = numpy.nonzero(mask)
        box = [columns.min(), rows.min(), columns.max() - columns.min() + 1, rows.max() - rows.min() + 1]
        assert mask.sum() == a["area"] and box == a["bbox"], a["id"]
)");
  const std::string line = "cd " + folder_.string() + " && python3 load.py >load.txt 2>&1";
  EXPECT_EQ(std::system(line.c_str()), 0) << read("load.txt");
}

TEST_F(DatasetRun, of_a_head_with_several_rows_of_beams_is_of_its_rows) {
  have("floor.ply", "make-scene plane --size 12,12 --points 8000");
  succeed(
      "ping floor.ply --sonar waterlinked-3d15 --set sonar.beams=32 --set sonar.elevations_deg=[-12,-4,4] "
      "--pose=1,0,2,0,20,0 --range 3:7 --no-picture -q --keep contributors -o head");
  succeed("dataset head -o set");
  EXPECT_EQ(coco("polar")["images"].size(), 1U);
  EXPECT_EQ(coco("polar")["images"][0]["file_name"], "000_000000_row01.png");
  EXPECT_THAT(read("set/meta.jsonl"), HasSubstr("\"row\":1,\"row_elevation_deg\":-4"));
  EXPECT_THAT(read("set/meta.jsonl"), testing::Not(HasSubstr("\"absorption_db_per_m\":0.0")));
  EXPECT_EQ(png("polar/images/000_000000_row01.png").value.cols(), 32);
  succeed("dataset head -o set --row all --force");
  EXPECT_EQ(coco("fan")["images"].size(), 3U);
  // The lower a row looks, the nearer its bed begins: its image has more of it.
  const auto bed = [&](const std::string& row) {
    return (png("polar/masks/000_000000_row" + row + ".png").value == 2).count();
  };
  EXPECT_GT(bed("00"), 0);
  EXPECT_NE(png("polar/images/000_000000_row00.png").value.cast<int>().sum(),
            png("polar/images/000_000000_row02.png").value.cast<int>().sum());
  expect_refused("dataset head -o set --row 3 --force", 2, {"--row = 3", "below 3"});
  expect_refused("dataset head -o set --row top --force", 2, {"--row"});
}

TEST_F(DatasetRun, colours_of_masks_are_those_of_the_palette_and_of_view_labels) {
  succeed("dataset survey -o set --columns 400");
  const nlohmann::json palette = read_json("set/palette.json");
  const auto classes = manifest_of("set")["classes"].get<std::vector<std::string>>();
  ASSERT_EQ(palette.size(), classes.size());
  for (std::size_t k = 0; k < classes.size(); ++k) EXPECT_EQ(palette[k]["name"], classes[k]);
  EXPECT_EQ(palette[0]["rgb"], nlohmann::json::parse("[0, 0, 0]"));
  EXPECT_TRUE(file_exists(path("set/polar/colours/000_000003.png")));
  // The picture of one ping: the same pixels in the same colours.
  succeed("merge survey");
  succeed("image survey/fls/cube.h5 --ping 3 --view labels --size 400x400 -o labels.png");
  EXPECT_EQ(read("labels.png"), read("set/fan/colours/000_000003.png"));
  const nlohmann::json key = read_json("labels.json");
  EXPECT_EQ(key["least_share"], 0.5);
  EXPECT_EQ(key["classes"][1]["rgb"], palette[1]["rgb"]);
  EXPECT_GT(key["classes"][2]["samples"], 1000);
  succeed(
      "ping harbour.ply --sonar p900-45 --set sonar.beams=16 --pose=0,0,-3,0,10,0 --range 2:6 --no-picture -q -o bare");
  expect_refused("image bare --view labels -o none.png", 3, {"bare", "no labels", "--keep labels"});
}

TEST_F(DatasetRun, yolo_boxes_are_those_of_coco) {
  succeed("dataset survey -o set");
  const nlohmann::json c = coco("fan");
  std::map<std::string, std::vector<std::vector<double>>> expected;
  std::map<int, nlohmann::json> image_of;
  for (const auto& image : c["images"]) image_of[image["id"]] = image;
  for (const auto& a : c["annotations"]) {
    const nlohmann::json& image = image_of.at(a["image_id"]);
    const double w = image["width"], h = image["height"], x = a["bbox"][0], y = a["bbox"][1], bw = a["bbox"][2],
                 bh = a["bbox"][3];
    double number = 0;  // among the categories, in their order
    while (c["categories"][static_cast<std::size_t>(number)]["id"] != a["category_id"]) ++number;
    expected[image["file_name"]].push_back({number, (x + bw / 2) / w, (y + bh / 2) / h, bw / w, bh / h});
  }
  ASSERT_FALSE(expected.empty());
  for (const auto& [name, boxes] : expected) {
    std::istringstream lines(read("set/fan/labels/" + name.substr(0, name.size() - 4) + ".txt"));
    for (const auto& box : boxes)
      for (const double number : box) {
        double read_number = -1;
        lines >> read_number;
        EXPECT_NEAR(read_number, number, 1e-6);
      }
  }
  // Ultralytics demands train and val, and looks from the folder of the file unless there is a path.
  EXPECT_THAT(
      read("set/fan/data.yaml"),
      testing::StartsWith("train: train.txt\nval: train.txt  # there is no image of val\nnames:\n  0: \"sand\"\n"));
  EXPECT_THAT(read("set/fan/train.txt"), HasSubstr("./images/000_000003.png\n"));
}

// Only classes that have boxes are named; shadow is left to the masks, and outlines stand beside run lengths.
TEST_F(DatasetRun, names_classes_with_boxes_and_draws_their_outlines) {
  succeed("dataset survey -o set --stuff sand --polygons");
  const auto manifest = manifest_of("set");
  const auto names = manifest["boxed_classes"].get<std::vector<std::string>>();
  EXPECT_EQ(std::count(names.begin(), names.end(), "shadow") + std::count(names.begin(), names.end(), "sand"), 0);
  std::string yaml = "names:\n";
  for (std::size_t k = 0; k < names.size(); ++k) yaml += "  " + std::to_string(k) + ": \"" + names[k] + "\"\n";
  EXPECT_THAT(read("set/fan/data.yaml"), testing::EndsWith(yaml));
  EXPECT_GT((png("polar/masks/000_000003.png").value == 1).count(), 0);  // the masks have shadows nevertheless
  for (const std::string form : {"polar", "fan"}) {
    const nlohmann::json c = coco(form);
    const auto outlined = nlohmann::json::parse(read("set/" + form + "/annotations/polygons_train.json"));
    ASSERT_EQ(outlined["annotations"].size(), c["annotations"].size());
    ASSERT_GT(c["annotations"].size(), 0U);
    for (std::size_t k = 0; k < c["annotations"].size(); ++k) {
      const auto &a = c["annotations"][k], &b = outlined["annotations"][k];
      EXPECT_EQ(a["id"], b["id"]);
      EXPECT_EQ(a["bbox"], b["bbox"]);
      // All pixels lie within, and no part leaves the box.
      double within = 0, right = 0, top = 1e9;
      for (const auto& part : b["segmentation"]) {
        const auto line = part.get<std::vector<int>>();
        ASSERT_GE(line.size(), 8U);
        for (std::size_t i = 0; i < line.size(); i += 2) {
          const std::size_t next = (i + 2) % line.size();
          within += 0.5 * (line[i] * line[next + 1] - line[next] * line[i + 1]);
          right = std::max<double>(right, line[i]), top = std::min<double>(top, line[i + 1]);
        }
      }
      EXPECT_GE(within, a["area"].get<double>());
      EXPECT_EQ(right, a["bbox"][0].get<double>() + a["bbox"][2].get<double>());
      EXPECT_EQ(top, a["bbox"][1].get<double>());
    }
  }
  expect_refused("dataset survey -o none --stuff gold", 2, {"--stuff = gold", "shadow"});
}

TEST_F(DatasetRun, shadow_has_boxes_only_if_it_is_a_thing) {
  succeed("dataset survey -o set");
  const auto without = manifest_of("set")["boxed_classes"].get<std::vector<std::string>>();
  EXPECT_THAT(without, testing::Contains("sand"));
  EXPECT_THAT(without, testing::Not(testing::Contains("shadow")));
  EXPECT_THAT(read("set/README.md"), HasSubstr("In masks alone: shadow."));
  succeed("dataset survey -o set --things shadow --force");
  EXPECT_THAT(manifest_of("set")["boxed_classes"].get<std::vector<std::string>>(), testing::Contains("shadow"));
  EXPECT_THAT(read("set/README.md"), HasSubstr("In masks alone: none."));
  expect_refused("dataset survey -o none --things sand", 2, {"--things", "shadow"});
}

// The first image looks up, into water and its noise: white is what one sample in 1000 of all images exceeds, at most 5 dB
// above it.
TEST_F(DatasetRun, has_the_window_of_all_its_images) {
  have("up",
       "ping harbour.ply --sonar p900-45 --set sonar.beams=48 --pose=0,0,-3,0,-80,0 --range 2:15 --noise "
       "--keep contributors");
  succeed("dataset up survey -o set --split 100:0:0");
  const nlohmann::json c = coco("polar");
  ASSERT_EQ(c["images"].size(), 5U);
  double white = 0, bright = 0, samples = 0;
  for (const auto& image : c["images"]) {
    const Grid<std::uint16_t> value = png("polar/images/" + image["file_name"].get<std::string>()).value;
    white += static_cast<double>((value == 65535).count()), samples += static_cast<double>(value.size());
    bright += static_cast<double>((value >= 60000).count());  // 5 of the 60 dB below white
  }
  EXPECT_LE(white / samples, 0.001);
  EXPECT_GE(bright / samples, 0.0009);
}

TEST_F(DatasetRun, meta_says_pose_seed_mapping_and_what_was_randomised) {
  succeed("dataset survey -o set --window 80:140");
  std::istringstream lines(read("set/meta.jsonl"));
  std::set<double> levels;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const nlohmann::json meta = nlohmann::json::parse(line);
    EXPECT_EQ(meta["ping"], count);
    EXPECT_EQ(meta["split"], "train");
    EXPECT_EQ(meta["seed"], 4);
    EXPECT_EQ(meta["mapping"]["min_db"], 80);
    EXPECT_EQ(meta["scene"], "harbour.ply");
    const double along = meta["world_from_head"][0][3], moved = meta["randomised"]["position_m"][0];
    EXPECT_NEAR(along, count + moved, 1e-9);  // of 1 m/s and 1 Hz, and the draw
    EXPECT_LE(std::abs(moved), 0.2);
    EXPECT_LE(std::abs(meta["randomised"]["source_level_db"].get<double>()), 3);
    levels.insert(meta["randomised"]["source_level_db"].get<double>());
  }
  EXPECT_EQ(count, 4);
  EXPECT_EQ(levels.size(), 4U);
  EXPECT_THAT(read("set/README.md"), HasSubstr("| 1 | shadow |"));
}

TEST_F(DatasetRun, sums_check_every_file_and_repeat) {
  succeed("dataset survey -o set");
  std::istringstream lines(read("set/SHA256SUMS"));
  std::size_t files = 0;
  for (std::string line; std::getline(lines, line); ++files)
    EXPECT_EQ(sha256_of_file(path("set/" + line.substr(66))), line.substr(0, 64)) << line;
  std::size_t there = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path("set"))) there += entry.is_regular_file();
  EXPECT_EQ(files + 2, there);  // all but itself and the manifest, which has its digest
  const std::string before = read("set/SHA256SUMS");
  succeed("dataset survey -o set --force");
  EXPECT_EQ(read("set/SHA256SUMS"), before);
  succeed("survey mission.toml -o again -j1 -q");
  succeed("dataset again -o other");
  EXPECT_EQ(read("other/SHA256SUMS").substr(0, 64), before.substr(0, 64));
  EXPECT_EQ(read("other/polar/images/000_000003.png"), read("set/polar/images/000_000003.png"));
}

TEST_F(DatasetRun, refuses_runs_without_labels_and_wrong_options) {
  succeed(
      "ping harbour.ply --sonar p900-45 --set sonar.beams=32 --pose=0,0,-3,0,10,0 --range 2:15 --no-picture -q -o "
      "bare");
  expect_refused("dataset bare -o set", 3, {"bare/cube.h5", "ping", "no labels", "--keep labels"});
  expect_refused("dataset none -o set", 4, {"none"});
  expect_refused("dataset survey -o set --share 0", 2, {"--share = 0"});
  expect_refused("dataset survey -o set --share 1.5", 2, {"--share = 1.5"});
  expect_refused("dataset survey -o set --split 80:20", 2, {"--split"});
  expect_refused("dataset survey -o set --stuff gold", 2, {"--stuff = gold", "sand"});
  expect_refused("dataset survey -o set --columns 3", 2, {"--columns"});
  expect_refused("dataset survey -o harbour.ply", 4, {"harbour.ply"});
  // Looking away: masks are empty.
  succeed(
      "ping harbour.ply --sonar p900-45 --set sonar.beams=32 --pose=0,0,-3,0,-89,0 --range 2:4 --no-picture -q "
      "--keep contributors -o away");
  expect_refused("dataset away -o set", 3, {"no pixel of 1 images shows a surface"});
  write("bad.toml", mission("keep = [\"paths\"]\n"));
  expect_refused("survey bad.toml -o bad", 3, {"bad.toml", "keep", "paths"});
  write("noise.toml", replaced(mission(), "source_level_db = 3", "noise_db = 3"));
  expect_refused("survey noise.toml -o noise", 3, {"noise.toml", "noise_db", "self_noise_db"});
  write("less.toml", replaced(mission(), "source_level_db = 3", "source_level_db = -3"));
  expect_refused("survey less.toml -o less", 3, {"less.toml:", "source_level_db = -3", "at least 0"});
}

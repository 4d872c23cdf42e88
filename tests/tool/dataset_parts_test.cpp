// SPDX-License-Identifier: BSD-3-Clause
// Data sets of scenes of parts: objects are the parts, drawn anew for every ping or every few.
#include <cmath>
#include <map>
#include <set>

#include "tool/dataset/dataset.hpp"
#include "tool/dataset_fixture.hpp"

namespace {

/// Lines of JSON.
std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<nlohmann::json> all;
  for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
  return all;
}

/// Pots and drums scattered over a plane, seen by eight pings of a head that stands still.
class DatasetOfParts : public DatasetRun {
 protected:
  void SetUp() override {
    have("plane.ply", "make-scene plane --size 24,24 --points 60000");
    have("pot.ply", "make-object drum --set upright=1");
    have("ball.ply", "make-object sphere --set diameter_m=0.8");
  }
  void survey_of(const std::string& scatter_more, const std::string& randomise) const {
    write("scene.toml",
          "schema = 1\n[[part]]\nfile = \"plane.ply\"\n[[scatter]]\nfiles = [\"pot.ply\", \"ball.ply\"]\n"
          "count = [1, 3]\narea_m = [[5, -3], [11, -3], [11, 3], [5, 3]]\nmin_distance_m = 1.5\nyaw_deg = 180\n" +
              scatter_more);
    write("mission.toml",
          "schema = 1\n[survey]\nscene = \"scene.toml\"\nseed = 4\n[trajectory]\nwaypoints_m = [[0, 0, 4], [0.008, 0, "
          "4]]\n"
          "speed_m_s = 0.001\n[[head]]\nname = \"fls\"\nsonar = \"p900-45\"\nset = [\"sonar.beams=96\"]\nrange = "
          "\"2:14\"\npitch_deg = -25\nrate_hz = 1\n[randomise]\n" +
              randomise + "[ping]\nkeep = [\"contributors\"]\n");
    succeed("survey mission.toml -q -o survey");
  }
  std::vector<nlohmann::json> meta() const { return json_lines(read("set/meta.jsonl")); }
};

/// Returns true if a box lies in another one that is `more` pixels wider on each side.
bool lies_in(const nlohmann::json& box, const nlohmann::json& whole, int more) {
  for (std::size_t k : {0U, 1U}) {
    const int low = box[k], high = low + box[k + 2].get<int>(), first = whole[k],
              last = first + whole[k + 2].get<int>();
    if (low < first - more || high > last + more) return false;
  }
  return true;
}

}  // namespace

TEST_F(DatasetOfParts, has_each_part_as_an_object_with_its_class_pose_and_boxes) {
  survey_of("", "scene = \"ping\"\n");
  succeed("dataset survey -o set --split 100:0:0 --least-pixels 4 --min-contrast=-1000");
  std::map<std::string, nlohmann::json> meta_of;
  std::set<std::string> layouts;
  for (const nlohmann::json& image : meta()) {
    meta_of[image["name"]] = image;
    layouts.insert(image["objects"].dump());
  }
  EXPECT_EQ(meta_of.size(), 8U);
  EXPECT_EQ(layouts.size(), meta_of.size());  // drawn anew for every ping
  std::size_t seen = 0;
  for (const char* form : {"polar", "fan"}) {
    const nlohmann::json all = coco(form);
    std::map<int, std::string> class_of, image_of;
    for (const auto& c : all["categories"]) class_of[c["id"]] = c["name"];
    for (const auto& i : all["images"]) image_of[i["id"]] = i["file_name"];
    for (const auto& a : all["annotations"]) {
      if (!a.contains("part")) continue;
      ++seen;
      const std::string file = image_of[a["image_id"]];
      const nlohmann::json& objects = meta_of.at(file.substr(0, file.size() - 4))["objects"];
      const auto object = std::find_if(objects.begin(), objects.end(), [&](auto& o) { return o["part"] == a["part"]; });
      ASSERT_NE(object, objects.end());
      const std::string part = a["part"];
      EXPECT_EQ(part.substr(0, part.rfind('-')), class_of[a["category_id"]]);
      EXPECT_EQ((*object)["class"], class_of[a["category_id"]]);
      EXPECT_EQ((*object)["instance"], a["instance"]);
      EXPECT_EQ((*object)["visible_share"], a["visible_share"]);
      EXPECT_EQ((*object)[std::string(form) + "_bbox_whole"], a["bbox_whole"]);
      EXPECT_GT(a["visible_share"].get<double>(), 0);
      EXPECT_LE(a["visible_share"].get<double>(), 1);
      // The whole of a fan is the outline itself; pixels lie up to a beam's width beside it.
      EXPECT_TRUE(lies_in(a["bbox"], a["bbox_whole"], form == std::string("fan") ? 12 : 6))
          << file << " " << part << a["bbox"] << a["bbox_whole"];
      const GreyPicture instances = png(std::string(form) + "/instances/" + file);
      EXPECT_EQ((instances.value == a["instance"].get<std::uint16_t>()).count(), a["area"].get<std::ptrdiff_t>());
    }
  }
  EXPECT_GT(seen, 20U);
  EXPECT_GT(read("set/sheet.png").size(), 1000U);
}

// The box of the whole is that of the outline where the fan draws it, not of the sector of its azimuths and ranges.
TEST_F(DatasetOfParts, has_the_box_of_the_drawn_outline_and_the_size_of_a_ball) {
  survey_of("scale = [0.7, 1.3]\n", "scene = \"ping\"\n");
  succeed("dataset survey -o set --split 100:0:0");
  const nlohmann::json mapping = read_json("set/fan_mapping.json").at(0);
  const double metres = mapping["metres_per_pixel"], column = mapping["head_column"], row = mapping["head_row"];
  std::size_t balls = 0, aside = 0;
  for (const nlohmann::json& image : meta())
    for (const nlohmann::json& object : image["objects"]) {
      if (object["class"] != "ball" || object["fan_bbox_whole"].is_null()) continue;
      Eigen::Matrix4d head, part;
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
          head(r, c) = image["world_from_head"][r][c], part(r, c) = object["world_from_part"][r][c];
      const double scale = object["scale"], radius = 0.4 * scale;
      EXPECT_NEAR(object["size_m"][2].get<double>(), 2 * radius, 1e-6);
      EXPECT_NEAR(object["size_m"][0].get<double>(), 2 * radius, 0.02);  // of the polyhedron
      const Eigen::Vector3d middle = (head.inverse() * part * Eigen::Vector4d(0, 0, radius, 1)).head<3>();
      const double bearing = std::abs(std::atan2(middle.y(), middle.x()));
      if (bearing > radians(19)) continue;                 // some of it is beside the fan
      double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};  // columns and rows
      for (int i = 0; i < 20000; ++i) {
        const double z = 1 - (i + 0.5) / 10000, turn = 2.399963 * i, r = std::sqrt(1 - z * z);
        const Eigen::Vector3d normal(r * std::cos(turn), r * std::sin(turn), z), position = middle + radius * normal;
        if (normal.dot(position) > 0) continue;
        // A line array receives cones: the range and the way to port are those of the position.
        const Eigen::Vector2d drawn =
            Eigen::Vector2d(std::sqrt(position.squaredNorm() - position.y() * position.y()), position.y()) / metres;
        const double at[2] = {column - drawn.y(), row - drawn.x()};
        for (int k : {0, 1}) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
      }
      ++balls, aside += bearing > radians(6);
      const nlohmann::json box = object["fan_bbox_whole"];
      for (std::size_t k : {0U, 1U}) {
        EXPECT_NEAR(box[k].get<double>(), low[k] - 0.5, 2.5) << object["part"] << image["name"];
        EXPECT_NEAR(box[k].get<double>() + box[k + 2].get<double>(), high[k] + 0.5, 2.5) << object["part"];
      }
    }
  EXPECT_GT(balls, 3U);
  EXPECT_GT(aside, 1U);
}

TEST_F(DatasetOfParts, has_the_extents_that_the_pose_of_a_ball_has) {
  survey_of("", "scene = \"ping\"\n");
  succeed("dataset survey -o set --split 100:0:0");
  std::size_t balls = 0;
  for (const nlohmann::json& image : meta())
    for (const nlohmann::json& object : image["objects"]) {
      if (object["class"] != "ball") continue;
      ++balls;
      Eigen::Matrix4d head, part;
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
          head(r, c) = image["world_from_head"][r][c], part(r, c) = object["world_from_part"][r][c];
      // A ball of 0.4 m about a point 0.4 m above the origin of its axes.
      const Eigen::Vector3d middle = (head.inverse() * part * Eigen::Vector4d(0, 0, 0.4, 1)).head<3>();
      const double range = middle.norm(), azimuth = std::atan2(middle.y(), middle.x());
      const double half = std::asin(0.4 / middle.head<2>().norm());
      EXPECT_NEAR(object["range_m"][0].get<double>(), range - 0.4, 0.02);
      EXPECT_NEAR(object["azimuth_rad"][0].get<double>(), azimuth - half, 0.01);
      EXPECT_NEAR(object["azimuth_rad"][1].get<double>(), azimuth + half, 0.01);
    }
  EXPECT_GT(balls, 3U);
}

TEST_F(DatasetOfParts, has_empty_images_and_splits_by_draws) {
  survey_of("empty_share = 0.5\n", "scene = 2\n");
  succeed("dataset survey -o set --split 50:25:25 --split-by draw");
  std::map<std::int64_t, std::set<std::string>> splits_of_draw;
  std::size_t empty = 0;
  for (const nlohmann::json& image : meta()) {
    splits_of_draw[image["ping"].get<std::int64_t>() / 2].insert(image["split"].get<std::string>());
    empty += image["objects"].empty();
  }
  EXPECT_EQ(splits_of_draw.size(), 4U);
  std::set<std::string> used;
  for (const auto& [draw, splits] : splits_of_draw) {
    EXPECT_EQ(splits.size(), 1U) << draw;
    used.insert(*splits.begin());
  }
  EXPECT_EQ(used, (std::set<std::string>{"test", "train", "val"}));
  EXPECT_GE(empty, 1U);
  EXPECT_LE(empty, 7U);
}

// The shares hold for the images of each class, too: no class is in train alone.
TEST(DatasetSplit, divides_classes_by_the_shares) {
  std::vector<insonify::tool::DatasetSource> sources(40);
  for (std::size_t d = 0; d < sources.size(); ++d) {
    sources[d].run = "run" + std::to_string(d), sources[d].run_index = d;
    sources[d].draw_key = "scene 1 " + std::to_string(d);
    sources[d].track.resize(1);
    sources[d].shows = {{d % 10 == 0 ? "rare" : d % 2 == 0 ? "even" : "odd"}};
  }
  insonify::tool::split_pings(sources, "draw", {50, 25, 25});
  std::map<std::string, std::map<std::string, int>> count;
  for (const auto& source : sources) ++count[*source.shows[0].begin()][source.split.at(0)];
  EXPECT_EQ(count["rare"], (std::map<std::string, int>{{"train", 2}, {"val", 1}, {"test", 1}}));
  EXPECT_EQ(count["odd"], (std::map<std::string, int>{{"train", 10}, {"val", 5}, {"test", 5}}));
  EXPECT_EQ(count["even"], (std::map<std::string, int>{{"train", 8}, {"val", 4}, {"test", 4}}));
}

// Runs of single pings are of the draws that they were made with.
TEST_F(DatasetOfParts, splits_single_pings_by_their_draws) {
  survey_of("", "scene = \"ping\"\n");
  std::string runs;
  for (const int run : {0, 1, 2, 3}) {
    const std::string name = "draw" + std::to_string(run);
    succeed("ping scene.toml --sonar p900-45 --set sonar.beams=48 --pose=0," + std::to_string(run % 2) +
            ",4,0,25,0 --range 2:14 --no-picture -q --keep contributors --draw " + std::to_string(run / 2) + " -o " +
            name);
    runs += name + " ";
  }
  const auto said = nlohmann::json::parse(
      succeed("dataset " + runs + "-o set --split 50:50:0 --split-by draw --least-pixels 4 --json -q"));
  const std::vector<nlohmann::json> images = meta();
  EXPECT_EQ(images[0]["split"], images[1]["split"]);
  EXPECT_EQ(images[2]["split"], images[3]["split"]);
  EXPECT_NE(images[0]["split"], images[2]["split"]);
  std::size_t polar = 0;
  for (const auto& [name, parts] : said["boxes_by_class"].items())
    for (const auto& [split, forms] : parts.items()) polar += forms["polar"].get<std::size_t>();
  EXPECT_EQ(polar, said["boxes"]["polar"].get<std::size_t>());
  EXPECT_GT(polar, 0U);
  // Checks what an image says beside its objects: azimuths, widths and the names of all parts.
  EXPECT_EQ(images[0]["azimuths_deg"].size(), 48U);
  EXPECT_NEAR(images[0]["field_of_view_deg"].get<double>(), 45, 1.5);
  EXPECT_GT(images[0]["elevation_width_deg"].get<double>(), 5);
  std::vector<std::string> names;
  for (const auto& part : images[0]["parts"]) names.push_back(part["part"]);
  EXPECT_EQ(names, (std::vector<std::string>{"plane", "ball-1", "ball-2", "ball-3", "pot-1", "pot-2", "pot-3"}));
  // Without a file of the scene it is known by its own text alone, which is said once.
  std::filesystem::rename(path("pot.ply"), path("elsewhere.ply"));
  const nlohmann::json less = json_of("dataset " + runs + "-o less --least-pixels 4 -q");
  EXPECT_THAT(less["notes"].dump(), testing::HasSubstr("the scene is known by scene.toml alone"));
  EXPECT_EQ(std::ranges::count_if(less["notes"],
                                  [](const nlohmann::json& note) {
                                    return note.get<std::string>().find("is known by") != std::string::npos;
                                  }),
            1);
}

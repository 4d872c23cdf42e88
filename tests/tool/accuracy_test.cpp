// SPDX-License-Identifier: BSD-3-Clause
// insonify accuracy: what it writes, and what it refuses. The sizes here are the hidden --quick ones: times mean nothing.
#include <nlohmann/json.hpp>

#include "support/test.hpp"
#include "tool/tool_runner.hpp"

using nlohmann::json;
using testing::StartsWith;

namespace {

constexpr const char* columns =
    "method,precision,scatterers,beams,elements,bins,tolerance,kernel_width,error,local_error,seconds,seconds_min,"
    "seconds_max,peak_mib";

class AccuracyVerb : public ToolTest {
 protected:
  bool has(const std::string& name) const { return std::filesystem::exists(path(name)); }
};

double number(const std::string& text) { return std::stod(text); }

}  // namespace

TEST_F(AccuracyVerb, writes_sweep_with_the_agreed_columns_pictures_and_manifest) {
  have("run", "accuracy --quick");
  EXPECT_THAT(read("run/sweep.csv"), StartsWith(std::string(columns) + ","));
  const json manifest = manifest_of("run");
  for (const char* key : {"cpu", "cores", "compiler", "flags", "commit", "load_average"})
    EXPECT_TRUE(manifest["machine"].contains(key)) << key;
  EXPECT_GE(manifest["threads"], 1);
  EXPECT_EQ(manifest["summary"]["promise"].size(), 4u);  // 1e-2, 1e-4, 1e-6, 1e-12
  for (const std::string name : manifest["pictures"]) EXPECT_TRUE(has("run/" + name)) << name;
  for (const char* name : {"work_precision.png", "crossover.png", "promise.png", "sampling.png"})
    EXPECT_TRUE(has(std::string("run/") + name)) << name;
  EXPECT_TRUE(has("run/sampling.csv"));
}

TEST_F(AccuracyVerb, every_row_is_complete_and_every_promise_kept) {
  have("run", "accuracy --quick");
  std::map<std::string, int> methods;
  for (auto& row : rows_of(read("run/sweep.csv"))) {
    ++methods[row["method"]];
    if (!row["refused"].empty()) {
      EXPECT_EQ(row["sweep"], "stability") << row["task"] << ": " << row["refused"];
      continue;
    }
    EXPECT_GT(number(row["seconds"]), 0);
    EXPECT_LE(number(row["seconds_min"]), number(row["seconds"]));
    EXPECT_GE(number(row["seconds_max"]), number(row["seconds"]));
    EXPECT_GT(number(row["peak_mib"]), 1);
    EXPECT_GT(number(row["elements"]), 0);
    if (row["method"] == "gridded") {
      EXPECT_LE(number(row["error"]), number(row["tolerance"])) << row["sweep"];
      if (row["task"].empty()) {
        EXPECT_GT(number(row["kernel_width"]), 1);
      }
    }
    // The referee itself: sums of a few hundred terms in double.
    if (row["method"] == "direct") {
      EXPECT_LE(number(row["error"]), 1e-12);
    }
    // Demands that a method with short cuts keeps their error.
    if (row["method"] == "nearest-bin") {
      EXPECT_GT(number(row["error"]), 0.05);
    }
  }
  for (const char* method : {"gridded", "direct", "spectrum", "windowed-direct", "nearest-bin", "pattern-cut"})
    EXPECT_GE(methods[method], 1) << method;
}

TEST_F(AccuracyVerb, errors_do_not_depend_on_threads) {
  for (const char* threads : {"1", "2"})
    succeed(std::string("accuracy --quick -q --no-picture --methods gridded --repeats 1 -j ") + threads + " -o j" +
            threads);
  std::vector<std::string> errors[2];
  for (int i = 0; i < 2; ++i)
    for (auto& row : rows_of(read(i == 0 ? "j1/sweep.csv" : "j2/sweep.csv")))
      if (row["sweep"] != "threads") errors[i].push_back(row["error"]);
  EXPECT_EQ(errors[0], errors[1]);
}

TEST_F(AccuracyVerb, methods_and_tolerances_can_be_chosen) {
  const std::string out = succeed("accuracy --quick --no-picture --methods gridded,direct --tolerances 1e-3 -o run");
  EXPECT_THAT(out, HasSubstr("tolerance 1e-03"));
  for (auto& row : rows_of(read("run/sweep.csv"))) {
    EXPECT_TRUE(row["method"] == "gridded" || row["method"] == "direct") << row["method"];
    if (row["method"] == "gridded") {
      EXPECT_EQ(row["tolerance"], "0.001");
    }
  }
}

TEST_F(AccuracyVerb, measures_on_the_users_own_ping) {
  have("sphere.ply", "make-scene sphere --points 500");
  const json manifest = json::parse(succeed(
      "accuracy --quick -q --no-picture --json --scene sphere.ply --sonar p900-45 --pose=0,0,0,0,0,0 --range 2:8 "
      "--set sonar.beams=24 --methods gridded --tolerances 1e-4 --repeats 1 -o run"));
  EXPECT_EQ(manifest["scene"], "sphere.ply");
  for (auto& row : rows_of(read("run/sweep.csv"))) {
    EXPECT_LE(number(row["error"]), number(row["tolerance"]));
    EXPECT_EQ(row["beams"], rows_of(read("run/sweep.csv"))[0]["beams"]);
  }
}

// Two triangles 400 m wide: their overview has 36 surfels in the swath, the ping's own samples thousands.
TEST_F(AccuracyVerb, samples_a_mesh_as_a_ping_does) {
  write("bed.obj", "v -200 -200 0\nv 200 -200 0\nv 200 200 0\nv -200 200 0\nf 1 2 3 4\n");
  succeed(
      "accuracy --quick -q --no-picture --scene bed.obj --sonar em2040 --set sonar.beams=16 --pose=0,0,20,0,0,0 "
      "--range 19:21 --methods gridded --tolerances 1e-3 --repeats 1 -o run");
  EXPECT_GT(number(rows_of(read("run/sweep.csv")).at(0)["scatterers"]), 1000);
}

TEST_F(AccuracyVerb, refuses_what_it_cannot_do_before_it_works) {
  expect_refused("accuracy --quick --methods magic -o run", 2,
                 {"--methods", "'magic' is unknown", "gridded, true-delays"});
  expect_refused("accuracy --quick --tolerances 2 -o run", 2, {"--tolerances", "2", "[1e-13, 1)"});
  expect_refused("accuracy --quick --tolerances fine -o run", 2, {"--tolerances", "'fine' is not a number"});
  expect_refused("accuracy --quick --repeats 0 -o run", 2, {"--repeats = 0"});
  expect_refused("accuracy --quick --sonar p900-45 -o run", 2, {"--scene"});
  expect_refused("accuracy --quick --scene a.ply -o run", 2, {"--sonar", "--pose"});
  expect_refused("accuracy --quick -j 5000 -o run", 2, {"5000"});
  expect_refused("accuracy --quick --scene none.ply --sonar p900-45 --pose=0,0,0,0,0,0 -o run", 4, {"none.ply"});
  std::filesystem::create_directory(path("there"));
  expect_refused("accuracy --quick -o there", 4, {"there"});
}

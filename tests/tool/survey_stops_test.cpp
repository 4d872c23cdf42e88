// SPDX-License-Identifier: BSD-3-Clause
// Surveys that are killed, interrupted or without space, and blocks that are missing or wrong.
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/test.hpp"
#include "tool/survey_fixture.hpp"

namespace fs = std::filesystem;

namespace {

class SurveyStops : public SurveyTest {};

/// Starts the program itself and ends it by `signal` once `enough()`; returns its exit code, or -1.
int started_and_ended(const std::string& folder, int signal, const std::function<bool()>& enough) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.c_str()) == 0)
      execl(INSONIFY_TOOL, INSONIFY_TOOL, "survey", "m.toml", "-q", "-j2", "--pings-per-block", "3", "-o", "run",
            static_cast<char*>(nullptr));
    _exit(99);
  }
  while (!enough() && waitpid(child, nullptr, WNOHANG) == 0) usleep(2000);
  kill(child, signal);
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_F(SurveyStops, killed_at_any_time_it_goes_on_and_leaves_nothing_over) {
  const auto whole = expected();
  const auto blocks = names_in("whole/fls/blocks");
  const fs::path run = path("run/fls/blocks");
  for (const std::string done : {"000000.h5", "000000.done", "000002.h5"})
    started_and_ended(folder_.string(), SIGKILL, [&] { return fs::exists(run / done); });
  ASSERT_TRUE(fs::exists(run / "000000.done"));
  const auto made = fs::last_write_time(run / "000000.h5");
  survey("run");
  EXPECT_EQ(fs::last_write_time(run / "000000.h5"), made) << "a finished block is not made again";
  EXPECT_EQ(merged("run"), whole);
  EXPECT_EQ(names_in("run/fls/blocks"), blocks);
}

TEST_F(SurveyStops, interrupted_it_keeps_every_finished_ping) {
  const auto whole = expected();
  const int code =
      started_and_ended(folder_.string(), SIGINT, [&] { return fs::exists(path("run/fls/blocks/000000.done")); });
  const auto status = read_json("run/status.json");
  EXPECT_EQ(code, status["state"] == "done" ? 0 : 130);
  const auto result = nlohmann::json::parse(succeed("survey m.toml --pings-per-block 3 -o run --json -q"));
  EXPECT_EQ(result["made"].get<int>(), 26 - status["done"].get<int>()) << "no finished ping is made twice";
  EXPECT_EQ(merged("run"), whole);
  EXPECT_EQ(names_in("run/turning/blocks"), names_in("whole/turning/blocks"));
  EXPECT_EQ(read_json("run/status.json")["state"], "done");
}

// Lays out the files that a block leaves that was interrupted after all of its pings.
TEST_F(SurveyStops, interrupted_blocks_are_read_and_not_pinged_again) {
  const auto whole = expected();
  survey("run");
  const std::string block = path("run/fls/blocks/000001");
  fs::remove(block + ".done");
  fs::rename(block + ".h5", block + ".partial.h5");
  fs::rename(block + ".ply", block + ".partial.ply");
  EXPECT_EQ(nlohmann::json::parse(succeed("survey m.toml -o run --json -q"))["made"], 0);
  EXPECT_EQ(merged("run"), whole);
  EXPECT_EQ(names_in("run/fls/blocks"), names_in("whole/fls/blocks"));
}

TEST_F(SurveyStops, what_is_damaged_is_named_and_made_again) {
  const auto whole = expected();
  survey("run");
  const std::string block = path("run/fls/blocks/000001");
  fs::remove(block + ".done");
  fs::rename(block + ".h5", block + ".partial.h5");
  fs::rename(block + ".ply", block + ".partial.ply");
  fs::resize_file(block + ".partial.h5", 3000);
  const ToolResult again = run("survey m.toml -o run");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, testing::AllOf(testing::HasSubstr("000001.partial.h5"),
                                        testing::HasSubstr(": the pings in it are made again")));
  EXPECT_EQ(merged("run"), whole);
}

// A limit of the size of files refuses to write as a full disk does.
TEST_F(SurveyStops, on_a_full_disk_it_ends_and_goes_on_when_there_is_space) {
  const auto whole = expected();
  const int status = std::system(("cd " + folder_.string() +
                                  " && trap '' XFSZ && ulimit -f 100 && " INSONIFY_TOOL
                                  " survey m.toml -o run -q --pings-per-block 3 2>/dev/null")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_THAT(names_in("run/fls/blocks"), testing::IsEmpty());
  survey("run");
  EXPECT_EQ(merged("run"), whole);
}

// Goes on with as many pings a block as the folder has: the same survey, however it was begun.
TEST_F(SurveyStops, it_goes_on_in_blocks_of_the_size_it_was_begun_with) {
  survey("run", "--shard 0/2");
  succeed("survey m.toml -q -o run");
  EXPECT_EQ(merged("run"), expected());
  expect_refused("survey m.toml -o run --pings-per-block 8", 2,
                 {"run: blocks of head fls hold 3 pings, not 8 as asked for", "leave the number out"});
}

TEST_F(SurveyStops, names_missing_and_changed_blocks) {
  survey("run", "--shard 0/2");
  expect_refused("merge run", 3, {"run: 5 of 10 blocks are not done: fls/blocks/000001 (pings 3 to 5)", "again"});
  survey("run", "--shard 1/2");
  std::ofstream(path("run/fls/blocks/000001.h5"), std::ios::app) << "x";
  expect_refused("merge run", 3, {"run/fls/blocks/000001.h5: was changed since it was made"});
}

// Cuts or blanks the mark of a block, as a loss of power leaves it on some disks.
TEST_F(SurveyStops, a_block_whose_mark_is_not_whole_is_made_again) {
  const auto whole = expected();
  survey("run");
  const std::string mark = "run/fls/blocks/000001.done", text = read(mark);
  const auto digest = text.find("cube_sha256");
  for (const std::string& left : {std::string(), text.substr(0, digest), std::string(text.size(), '\0')}) {
    write(mark, left);
    expect_refused("merge run", 3, {"run: 1 of 10 blocks are not done: fls/blocks/000001 (pings 3 to 5)", "again"});
    EXPECT_EQ(json_of("info run")["heads"][0]["blocks_done"], 4);
    EXPECT_EQ(json_of("survey m.toml -o run -q")["made"], 3);
  }
  EXPECT_EQ(merged("run"), whole);
  EXPECT_EQ(names_in("run/fls/blocks"), names_in("whole/fls/blocks"));
}

TEST_F(SurveyStops, a_block_of_another_mission_is_refused) {
  survey("run", "--shard 0/2");
  write("m.toml", survey_mission + "threshold_db = 12\n");
  survey("other", "--shard 1/2");
  for (const auto& entry : fs::directory_iterator(path("other/fls/blocks")))
    fs::copy(entry.path(), path("run/fls/blocks") / entry.path().filename());
  expect_refused("merge run", 3, {"run/fls/blocks/000001.done: is of another mission", "remove it and its block"});
  write("m.toml", survey_mission);
  expect_refused("survey m.toml --pings-per-block 3 -o run", 3, {"run/fls/blocks/000001.done: is of another mission"});
}

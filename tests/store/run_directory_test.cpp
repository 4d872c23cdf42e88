// SPDX-License-Identifier: BSD-3-Clause
#include "store/run_directory.hpp"

#include "support/test.hpp"

namespace fs = std::filesystem;

namespace {

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Returns the manifest of a run with `word`.
std::string manifest_with(const std::string& word) {
  return "{\"insonify_version\": \"1\", \"word\": \"" + word + "\"}";
}

void make_run(const std::string& path, const std::string& word, bool force = false) {
  RunDirectory run(path, force);
  write_file(run.file("manifest.json"), manifest_with(word));
  run.commit();
}

std::string word_of(const std::string& run) {
  const std::string manifest = read_text_file(run + "/manifest.json");
  const std::size_t at = manifest.rfind(": \"") + 3;
  return manifest.substr(at, manifest.size() - at - 2);
}

}  // namespace

TEST(RunDirectory, appears_complete_on_commit_and_not_before) {
  const std::string out = own_path("out");
  {
    RunDirectory run(out, false);
    write_file(run.file("a.txt"), "a");
    write_file(run.file("b.txt"), "b");
    EXPECT_FALSE(fs::exists(out));
    run.commit();
  }
  EXPECT_EQ(names_in(out), (std::set<std::string>{"a.txt", "b.txt"}));
  EXPECT_EQ(names_in(fs::path(out).parent_path()), (std::set<std::string>{"out"}));
}

TEST(RunDirectory, leaves_nothing_behind_without_commit) {
  const std::string out = own_path("out");
  {
    RunDirectory run(out, false);
    write_file(run.file("a.txt"), "a");
    EXPECT_TRUE(fs::exists(run.file("a.txt")));
  }
  EXPECT_TRUE(names_in(fs::path(out).parent_path()).empty());
}

TEST(RunDirectory, refuses_an_existing_folder_and_names_force) {
  const std::string out = own_path("out");
  make_run(out, "old");
  EXPECT_EQ(error_with_kind([&] { RunDirectory(out, false); }),
            "file: " + out + ": exists already; give --force to replace it, or another name");
  EXPECT_EQ(word_of(out), "old");
}

TEST(RunDirectory, with_force_replaces_a_run_but_keeps_it_until_commit) {
  const std::string out = own_path("out");
  make_run(out, "old");
  { RunDirectory abandoned(out, true); }
  EXPECT_EQ(word_of(out), "old");
  make_run(out + "/", "new", true);  // a slash at the end means the same folder
  EXPECT_EQ(word_of(out), "new");
  EXPECT_EQ(names_in(out), (std::set<std::string>{"manifest.json"}));
  EXPECT_EQ(names_in(fs::path(out).parent_path()), (std::set<std::string>{"out"}));
}

TEST(RunDirectory, force_does_not_replace_what_is_no_run) {
  const std::string home = own_path("home");
  fs::create_directory(home);
  write_file(home + "/thesis.tex", "years of work");
  EXPECT_EQ(error_with_kind([&] { RunDirectory(home, true); }),
            "file: " + home +
                ": holds what no run of insonify wrote, or what was changed since: thesis.tex; --force replaces only "
                "what manifest.json lists; move these files, remove the folder yourself, or give another name");
  EXPECT_EQ(read_text_file(home + "/thesis.tex"), "years of work");
  const std::string file = own_file("file", "text");
  EXPECT_THAT(error_with_kind([&] { RunDirectory(file, true); }), HasSubstr("is not a folder of an earlier run"));
}

TEST(RunDirectory, keeps_what_came_into_the_old_run_meanwhile) {
  const std::string out = own_path("out");
  make_run(out, "old");
  {
    RunDirectory run(out, true);
    write_file(run.file("manifest.json"), manifest_with("new"));
    write_file(out + "/thesis.tex", "years of work");
    EXPECT_THAT(error_with_kind([&] { run.commit(); }), HasSubstr("thesis.tex"));
  }
  EXPECT_EQ(word_of(out), "old");
  EXPECT_EQ(read_text_file(out + "/thesis.tex"), "years of work");
  EXPECT_EQ(names_in(fs::path(out).parent_path()), (std::set<std::string>{"out"}));
}

TEST(RunDirectory, does_not_overwrite_what_appeared_meanwhile) {
  const std::string out = own_path("out");
  RunDirectory run(out, false);
  make_run(out, "the other one's");
  EXPECT_THAT(error_with_kind([&] { run.commit(); }), HasSubstr("exists already"));
  EXPECT_EQ(word_of(out), "the other one's");
}

TEST(RunDirectory, needs_a_parent_folder_and_a_name) {
  const std::string out = own_path("missing/out");
  EXPECT_EQ(error_with_kind([&] { RunDirectory(out, false); }),
            "file: " + out + ": folder " + own_path("missing") + " does not exist; create it first");
  for (const char* name : {"", "/", ".", ".."})
    EXPECT_EQ(error_with_kind([&] { RunDirectory(name, true); }),
              "file: \"" + std::string(name) + "\": is not a valid name for a new folder");
}

TEST(TextFile, comes_back_as_written_and_replaces_an_old_one) {
  const std::string path = own_path("a.txt");
  const std::string text = std::string("one\r\ntwo\0three", 14) + "\n";
  write_file(path, "old, and longer than the new text will be");
  write_file(path, text);
  EXPECT_EQ(read_text_file(path), text);
  write_file(path, "");
  EXPECT_EQ(read_text_file(path), "");
  EXPECT_EQ(names_in(fs::path(path).parent_path()), (std::set<std::string>{"a.txt"}));
}

TEST(TextFile, errors_name_the_path) {
  const std::string missing = own_path("no/a.txt");
  EXPECT_EQ(error_with_kind([&] { read_text_file(missing); }), "file: " + missing + ": no such file; check the path");
  EXPECT_EQ(error_with_kind([&] { write_file(missing, "x"); }),
            "file: " + missing + ": folder " + own_path("no") + " does not exist; create it first");
  const std::string folder = fs::path(own_path("x")).parent_path().string();
  EXPECT_EQ(error_with_kind([&] { read_text_file(folder); }), "file: " + folder + ": is a folder, must be a file");
  EXPECT_EQ(error_with_kind([&] { write_file(folder, "x"); }),
            "file: " + folder + ": is not a valid name for an output file");
}

// SPDX-License-Identifier: BSD-3-Clause
#include "files/pending_path.hpp"

#include <csignal>
#include <fstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "files/final_names.hpp"
#include "files/pending_file.hpp"
#include "support/test.hpp"

namespace fs = std::filesystem;

namespace {

// Returns the number of a process that has ended.
pid_t ended_process() {
  const pid_t process = fork();
  if (process == 0) _exit(0);
  waitpid(process, nullptr, 0);
  return process;
}

// Returns the temporary name of another process.
std::string name_of(const std::string& target, const char* kind, pid_t process) {
  std::string name = sibling_name(target, kind);
  const std::string own = "-" + std::to_string(getpid()) + "@";
  return name.replace(name.rfind(own), own.size(), "-" + std::to_string(process) + "@");
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const std::string& path, const char* text) { std::ofstream(path) << text; }

}  // namespace

TEST(PendingPath, removes_what_ended_processes_left_and_nothing_else) {
  const std::string out = own_path("out");
  const std::string left = name_of(out, "tmp", ended_process()), living = name_of(out, "tmp", getppid());
  const std::string of_other_host = left + "-elsewhere",
                    of_other_target = name_of(own_path("outer"), "tmp", ended_process());
  fs::create_directories(left + "/deep");
  for (const std::string& path : {left + "/deep/cube.h5", living, of_other_host, of_other_target})
    write_text(path, "half");
  { const PendingPath pending(out); }
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(living));
  EXPECT_TRUE(fs::exists(of_other_host));
  EXPECT_TRUE(fs::exists(of_other_target));
}

TEST(PendingPath, gives_an_output_its_name_back_if_the_process_that_replaced_it_ended) {
  const std::string out = own_path("out"), old = name_of(out, "old", ended_process());
  write_text(old, "complete");
  { const PendingPath pending(out); }
  EXPECT_EQ(text_of(out), "complete");
  write_text(old, "older");
  { const PendingPath pending(out); }
  EXPECT_EQ(text_of(out), "complete");
  EXPECT_FALSE(fs::exists(old));
}

TEST(PendingPath, of_two_writers_of_one_output_have_two_names) {
  const PendingPath one(own_path("out")), two(own_path("out"));
  EXPECT_NE(one.temporary(), two.temporary());
}

TEST(PendingPath, folder_is_not_committed_over_what_appeared_meanwhile) {
  PendingPath pending(own_path("out"));
  fs::create_directory(pending.temporary());
  fs::create_directory(own_path("out"));
  EXPECT_THAT(error_with_kind([&] { pending.commit(); }), HasSubstr("out: cannot be written: File exists"));
}

TEST(PendingPath, folder_takes_the_place_of_another) {
  const std::string out = own_path("out");
  fs::create_directory(out);
  write_text(out + "/a", "old");
  {
    PendingPath pending(out);
    fs::create_directory(pending.temporary());
    write_text(pending.temporary() + "/b", "new");
    pending.commit_in_place_of_folder([](const std::string&) {});
  }
  EXPECT_FALSE(fs::exists(out + "/a"));
  EXPECT_EQ(text_of(out + "/b"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(out).parent_path()), {}), 1);
}

TEST(PendingPath, files_that_are_one_output_get_their_names_together) {
  write_text(own_path("old"), "old");
  const auto write_pair = [](bool whole) {
    PendingPath old(own_path("old")), fresh(own_path("fresh")), last(own_path("last"));
    for (const PendingPath* path : {&old, &fresh, &last}) write_text(path->temporary(), "new");
    if (!whole) fs::remove(last.temporary());
    PendingPath::commit_together({&old, &fresh, &last});
  };
  EXPECT_THAT(error_with_kind([&] { write_pair(false); }), HasSubstr("last: cannot be written: No such file"));
  EXPECT_EQ(text_of(own_path("old")), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(own_folder()), {}), 1);
  write_pair(true);
  for (const char* name : {"old", "fresh", "last"}) EXPECT_EQ(text_of(own_path(name)), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(own_folder()), {}), 3);
}

TEST(PendingFile, several_files_are_written_or_none) {
  write_text(own_path("a"), "old");
  EXPECT_THAT(error_with_kind([] {
                write_files({{own_path("a"), "new"}, {own_path("none/b"), "new"}});
              }),
              HasSubstr("file: "));
  EXPECT_EQ(text_of(own_path("a")), "old");
  write_files({{own_path("a"), "new"}, {own_path("b"), "two"}});
  EXPECT_EQ(text_of(own_path("a")) + text_of(own_path("b")), "newtwo");
}

TEST(PendingPath, messages_name_outputs_as_they_are_called_in_the_end) {
  for (const std::string start : {"", "/tmp/", "runs/", "see runs/"})
    for (const int count : {0, 3}) {
      const std::string temporary = start + sibling_name("out", "tmp", count);
      EXPECT_EQ(with_final_names(temporary + "/cube.h5: full, " + temporary),
                start + "out/cube.h5: full, " + start + "out");
    }
  EXPECT_EQ(with_final_names(sibling_name("runs/my out") + ": full"), "runs/my out: full");
  for (const char* other : {"a.tmp-1", "a.tmp-12@", ".a.tmp-12@elsewhere/b: full", ".tmp-"})
    EXPECT_EQ(with_final_names(other), other);
}

TEST(PendingPath, refuses_names_that_no_file_may_have) {
  const std::string longest(255, 'n'), too_long(256, 'n');
  write_file(own_path(longest.c_str()), "text");
  EXPECT_EQ(text_of(own_path(longest.c_str())), "text");
  EXPECT_THAT(error_with_kind([&] { PendingPath pending(own_path(too_long.c_str())); }),
              AllOf(HasSubstr("file: "), HasSubstr("cannot be written: File name too long")));
}

// A thread goes on writing while the process ends by a signal.
TEST(PendingPath, discarded_leaves_nothing_and_commits_nothing) {
  const std::string out = own_path("out");
  const pid_t process = fork();
  if (process == 0) {
    PendingPath pending(out);
    fs::create_directory(pending.temporary());
    std::jthread writer([&] {
      for (int i = 0; i < 2000; ++i) write_text(pending.temporary() + "/" + std::to_string(i), "x");
      try {
        pending.commit();
      } catch (const Error&) {  // there is nothing left of it
      }
    });
    while (!fs::exists(pending.temporary() + "/100")) std::this_thread::yield();
    discard_pending_paths();
    _exit(7);
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_TRUE(fs::is_empty(fs::path(out).parent_path()));
}

// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C and kill at any stage: the prompt is back within a second, and nothing is left that was not complete. The second
// is measured as processor time of two threads, so that other work on the machine does not count.
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/stop_watch.hpp"
#include "tool/tool_runner.hpp"

namespace fs = std::filesystem;
using namespace insonify;

namespace {

struct Ended {
  int exit_code;
  double seconds;            ///< time from the signal to the end [s]
  double processor_seconds;  ///< processor time of all threads in these seconds [s]
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Processor time of all threads of a process and of its ended children until now [s], by proc(5).
double processor_time(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string field;
  while (file >> field && field.back() != ')') {
  }
  for (int skipped = 0; skipped < 11; ++skipped) file >> field;
  long long ticks = 0;
  for (int kind = 0; kind < 4; ++kind) {  // user and kernel, own and of the children
    long long of_kind = 0;
    file >> of_kind;
    ticks += of_kind;
  }
  return static_cast<double>(ticks) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

class Interrupt : public ToolTest {
 protected:
  // Starts `insonify ARGUMENTS`, and sends `signal` after a time [s], or up to ten seconds later, once it is ready.
  Ended interrupted(
      const std::string& arguments, double after, int signal = SIGINT,
      const std::function<bool()>& ready = [] { return true; }) const {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(SIGINT, SIG_DFL);  // a test that runs in the background ignores it
      const std::string line =
          "cd '" + folder_.string() + "' && exec " INSONIFY_TOOL " " + arguments + " >/dev/null 2>err";
      execl("/bin/sh", "sh", "-c", line.c_str(), static_cast<char*>(nullptr));
      _exit(99);
    }
    usleep(static_cast<useconds_t>(after * 1e6));
    for (int k = 0; k < 1000 && !ready(); ++k) usleep(10000);
    const double before = processor_time(child);
    StopWatch watch;
    kill(child, signal);
    int status = -1;
    rusage used{};
    wait4(child, &status, 0, &used);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), watch.lap(),
            seconds_of(used.ru_utime) + seconds_of(used.ru_stime) - before};
  }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename().string());
    names.erase("err");
    return names;
  }
};

}  // namespace

TEST_F(Interrupt, ends_every_verb_within_a_second_and_leaves_nothing) {
  have("harbour.ply", "make-scene harbour --points 300000");
  {
    std::ofstream points(path("points.xyz"));
    for (int i = 0; i < 200000; ++i)
      points << 0.02 * (i % 500) << ' ' << 0.02 * (i / 500) << ' ' << 0.1 * std::sin(0.05 * (i % 500)) << '\n';
  }
  have("run", "ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 1:12 --no-picture --keep contributors");
  const std::set<std::string> before = names();
  const std::string long_ping =
      "ping harbour.ply --sonar oculus-m750d --pose=0,0,-3,0,10,0 --range 0.5:40 --method direct -o out";
  for (const auto& [command, times] : std::vector<std::pair<std::string, std::vector<double>>>{
           {long_ping, {0.02, 0.3, 1.5}},
           {"prepare points.xyz -o prepared.ply", {0.05, 0.4}},
           {"prepare points.xyz -o prepared.tiles", {0.05, 0.4}},
           {"make-scene harbour --points 20000000 -o big.ply", {0.05, 0.5}},
           {"make-scene harbour --points 20000000 -o big.tiles", {0.05, 0.5}},
           {"merge run run run run -o merged", {0.01, 0.05}},
           {"export run -o exported", {0.02, 0.1}},
           {"accuracy --scene harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 -o report", {0.1, 0.8}}})
    for (const double after : times) {
      const Ended ended = interrupted(command, after);
      EXPECT_LT(ended.processor_seconds, 2) << command << " after " << after << " s";
      EXPECT_LT(ended.seconds, 10) << command << " after " << after << " s";
      // It may have finished, or not have begun.
      if (ended.exit_code == 0) {
        for (const char* made : {"merged", "exported"}) fs::remove_all(path(made));
      } else if (ended.exit_code != -SIGINT || after >= 1) {
        EXPECT_EQ(ended.exit_code, 130) << command << " after " << after << " s: " << read("err");
        EXPECT_EQ(read("err"), "insonify: interrupted; nothing was written\n") << command;
      }
      EXPECT_EQ(names(), before) << command << " after " << after << " s";
    }
}

TEST_F(Interrupt, is_ignored_where_the_caller_says_so) {
  have("harbour.ply", "make-scene harbour --points 300000");
  std::signal(SIGHUP, SIG_IGN);
  const Ended ended = interrupted(
      "ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 1:12 --no-picture -q -o out", 0.05, SIGHUP);
  std::signal(SIGHUP, SIG_DFL);
  EXPECT_EQ(ended.exit_code, 0) << read("err");
}

TEST_F(Interrupt, kill_leaves_what_the_next_run_removes) {
  have("harbour.ply", "make-scene harbour --points 300000");
  const std::string ping = "ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --no-picture -o out --range 1:";
  const std::size_t before = names().size();
  interrupted(ping + "30 --method direct", 0.1, SIGKILL, [&] { return names().size() > before; });
  EXPECT_EQ(names().size(), before + 1) << "a hidden folder";
  EXPECT_EQ(run(ping + "5").exit_code, 0);
  EXPECT_EQ(names().size(), before + 1) << "out";
  EXPECT_TRUE(names().contains("out"));
}

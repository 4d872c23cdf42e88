// SPDX-License-Identifier: BSD-3-Clause
// Makes every call by which a verb writes fail, one at a time and in every way, or kills the verb there or at a random time.
// An error must be one line and exit code 4, the old output as it was, and no other file there; success in spite of it, as
// after a short write, must give the bytes of an undisturbed run. After a kill the old or the new output must be whole, and
// the next run must leave nothing else.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include "faults/failing_calls.hpp"
#include "tool/command/command_line.hpp"

namespace fs = std::filesystem;
using insonify::Failure;

namespace {

using Files = std::map<std::string, std::string>;  // bytes of all files below a folder; a folder's are "/"

// A command that replaces `output`, and the one that wrote what it replaces.
struct Case {
  const char *verb, *output, *before, *command;
  bool resumes = false;  // keeps what is done, and completes it when it is run again
};

const char* const ping = "ping poles.ply --no-picture -q --sonar p900-45 --set sonar.beams=4 --pose=0,0,0,0,0,0 ";
const char* const side_ping =
    "ping poles.ply --no-picture -q --sonar starfish-450 --set sonar.range_resolution_m=0.05 --pose=0,0,0,0,0,0 ";

std::vector<Case> cases() {
  static const std::string old_ping = std::string(ping) + "--range 3:4 -o out",
                           new_ping = std::string(ping) + "--range 3:5 --layers --keep contributors -o out --force";
  return {
      {"make-scene", "a.ply", "make-scene poles --points 50 -o a.ply", "make-scene poles --points 60 -o a.ply --force"},
      {"make-scene", "a.pcd", "make-scene poles --points 50 -o a.pcd", "make-scene poles --points 60 -o a.pcd --force"},
      {"make-scene", "a.tiles", "make-scene poles --points 50 -o a.tiles",
       "make-scene poles --points 60 -o a.tiles --force"},
      {"prepare", "p.ply", "prepare small.ply -o p.ply", "prepare poles.ply -o p.ply --force"},
      {"prepare", "p.tiles", "prepare small.ply -o p.tiles", "prepare poles.ply -o p.tiles --force"},
      {"ping", "out", old_ping.c_str(), new_ping.c_str()},
      {"merge", "both", "merge run -o both", "merge run run -o both --force"},
      {"export", "vtk", "export short -o vtk", "export run -o vtk --force"},
      {"export", "b.las", "export short --to las --utm 32N -o b.las", "export run --to las --utm 32N -o b.las --force"},
      {"export", "b.csv", "export short --to csv -o b.csv", "export run --to csv -o b.csv --force"},
      {"export", "b.tif", "export short --to geotiff --cell 0.1 --utm 32N -o b.tif",
       "export run --to geotiff --cell 0.1 --utm 32N -o b.tif --force"},
      {"export", "b.gsf", "export short --to gsf --anchor 54,8,90 -o b.gsf",
       "export run --to gsf --anchor 54,8,90 -o b.gsf --force"},
      {"export", "b.mcap", "export short --to mcap -o b.mcap", "export run --to mcap -o b.mcap --force"},
      {"export", "b.xtf", "export short-side --to xtf --anchor 54,8 -o b.xtf",
       "export side --to xtf --anchor 54,8 -o b.xtf --force"},
      {"survey", "survey", "", "survey mission.toml --pings-per-block 2 -j 1 -o survey", true},
  };
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().lexically_relative(folder).string()] = entry.is_directory() ? "/" : bytes_of(entry.path());
  return files;
}

// Runs `insonify COMMAND -q` in this folder, in a process of its own.
struct Ended {
  int status;
  std::string said;

  int code() const { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }
};

Ended run_apart(const std::string& command, double kill_after = -1) {
  const std::string said = "../said";
  const pid_t child = fork();
  if (child == 0) {
    alarm(120);
    wordexp_t words;
    if (wordexp(("insonify " + command + (command.find(" -q") == command.npos ? " -q" : "")).c_str(), &words,
                WRDE_NOCMD) != 0)
      _exit(99);
    const int to = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), nowhere = ::open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO), dup2(to, STDERR_FILENO);
    const int code = insonify::tool::run_tool(static_cast<int>(words.we_wordc), words.we_wordv);
    std::fflush(nullptr);
    _exit(code);
  }
  if (kill_after >= 0) {
    usleep(static_cast<useconds_t>(1e6 * kill_after));
    kill(child, SIGKILL);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return {status, bytes_of(said)};
}

// Run times, peak memory and dates are in manifest.json and in blocks' marks; these are compared by their end alone.
bool same(const Files& a, const Files& b) {
  if (a.size() != b.size()) return false;
  for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y) {
    if (x->first != y->first) return false;
    const std::string name = fs::path(x->first).filename().string();
    const bool timed = name == "manifest.json" || name.ends_with(".json") || name.ends_with(".jsonl");
    if (timed ? x->second.empty() || x->second.back() != y->second.back() : x->second != y->second) return false;
  }
  return true;
}

std::string difference(const Files& found, const Files& expected) {
  std::string text;
  for (const auto& [name, bytes] : found)
    if (!expected.contains(name)) text += " +" + name;
  for (const auto& [name, bytes] : expected)
    if (!found.contains(name))
      text += " -" + name;
    else if (found.at(name) != bytes)
      text += " ~" + name;
  return text;
}

// One case with its files before, and after an undisturbed run.
class Sweep {
 public:
  Sweep(const Case& each, const fs::path& kept, const fs::path& work) : case_(each), kept_(kept), work_(work) {
    if (*each.before && run_apart(each.before).code() != 0) std::printf("%s fails\n", each.before);
    fs::remove_all(kept_);
    fs::copy(work_, kept_, fs::copy_options::recursive);
    before_ = files_in(work_);
    insonify::fail_call(work_.string(), 0, Failure::none);
    const Ended whole = run_apart(each.command);
    calls = insonify::counted_calls();
    if (whole.code() != 0) std::printf("%s fails: %s\n", each.command, whole.said.c_str());
    after_ = files_in(work_);
    restore();
  }

  // True if the answer to the failure of call `number` is good.
  bool holds(long number, Failure failure, const char* name) {
    insonify::fail_call(work_.string(), number, failure);
    const Ended ended = run_apart(case_.command);
    const bool failed = insonify::has_failed();
    insonify::fail_call(work_.string(), 0, Failure::none);
    const std::string problem = failure == Failure::kill ? after_kill() : after_failure(ended);
    restore();
    if (failed || !problem.empty()) ++tried;
    if (problem.empty()) return true;
    std::printf("%s -o %s: call %ld of %ld, %s: %s; exit %d: %s\n", case_.verb, case_.output, number, calls, name,
                problem.c_str(), ended.code(), ended.said.c_str());
    return false;
  }

  // The same of a kill after a time.
  bool survives_kill(double seconds) {
    run_apart(case_.command, seconds);
    const std::string problem = after_kill();
    restore();
    ++tried;
    if (!problem.empty())
      std::printf("%s -o %s: killed after %g s: %s\n", case_.verb, case_.output, seconds, problem.c_str());
    return problem.empty();
  }

  long calls = 0, tried = 0;

 private:
  std::string after_failure(const Ended& ended) {
    const Files found = files_in(work_);
    if (ended.code() == 0) return same(found, after_) ? "" : "success with other files:" + difference(found, after_);
    if (ended.code() != 4 && !(case_.resumes && ended.code() == 5)) return "exit code is not 4";
    if (std::count(ended.said.begin(), ended.said.end(), '\n') != 1) return "not one line";
    if (case_.resumes) return completed();
    // The last step: the name is there, but the disk does not confirm it.
    if (ended.said.find("is complete, but") != std::string::npos && same(found, after_)) return "";
    return same(found, before_) ? "" : "other files:" + difference(found, before_);
  }

  std::string after_kill() {
    const Files found = visible(files_in(work_));
    if (!case_.resumes && !same(found, before_) && !same(found, after_))
      return "neither old nor new:" + difference(found, before_);
    return completed();
  }

  // What the next run leaves.
  std::string completed() {
    const Ended again = run_apart(case_.command);
    if (again.code() != 0) return "the next run ends with " + std::to_string(again.code()) + ": " + again.said;
    const Files found = files_in(work_);
    return same(found, after_) ? "" : "the next run leaves" + difference(found, after_);
  }

  static Files visible(Files files) {
    std::erase_if(files, [](const auto& file) { return file.first.starts_with("."); });
    return files;
  }

  void restore() {
    const Files now = files_in(work_);
    if (now == before_) return;
    for (const auto& entry : fs::directory_iterator(work_)) fs::remove_all(entry.path());
    fs::copy(kept_, work_, fs::copy_options::recursive);
  }

  const Case& case_;
  fs::path kept_, work_;
  Files before_, after_;
};

// What the cases start from.
void make_inputs() {
  const std::string to_run = std::string(ping) + "--range 3:5 -o run",
                    to_short = std::string(ping) + "--range 3:4 -o short",
                    to_side = std::string(side_ping) + "--range 3:5 -o side",
                    to_short_side = std::string(side_ping) + "--range 3:4 -o short-side";
  for (const std::string& command :
       {std::string("make-scene poles --points 50 -o small.ply"),
        std::string("make-scene poles --points 4000 -o poles.ply"), to_run, to_short, to_side, to_short_side,
        std::string("make-mission lawnmower --scene poles.ply --sonar p900-45 --range 3:5 --centre 0,0,0 --size 2,1 "
                    "--spacing 4 --rate 2 -o mission.toml")})
    if (const Ended made = run_apart(command); made.code() != 0)
      std::printf("%s fails: %s\n", command.c_str(), made.said.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: fault_sweep faults VERB|all STEP\n       fault_sweep kills VERB|all COUNT [SEED]\n");
    return 2;
  }
  const bool kills = std::strcmp(argv[1], "kills") == 0;
  const std::string verb = argv[2];
  const long number = std::max(1L, std::atol(argv[3]));
  char folder[] = "/tmp/insonify-faults-XXXXXX";
  if (!mkdtemp(folder)) return 2;
  const fs::path top = folder, work = top / "work";
  fs::create_directory(work);
  fs::current_path(work);
  make_inputs();
  static constexpr std::pair<Failure, const char*> failures[] = {
      {Failure::no_space, "ENOSPC"},   {Failure::io_error, "EIO"},      {Failure::no_access, "EACCES"},
      {Failure::interrupted, "EINTR"}, {Failure::short_write, "short"}, {Failure::kill, "kill"}};
  std::mt19937_64 random(argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1);
  long bad = 0, tried = 0, turn = 0;
  std::printf("| verb | output | calls | tried | bad |\n|---|---|---|---|---|\n");
  for (const Case& each : cases()) {
    if (verb != "all" && verb != each.verb) continue;
    Sweep sweep(each, top / "kept", work);
    long wrong = 0;
    if (kills) {
      for (long i = 0; i < number; ++i) wrong += !sweep.survives_kill(std::uniform_real_distribution<>(0, 0.3)(random));
    } else {
      for (long call = 1; call <= sweep.calls; ++call)
        for (const auto& [failure, name] : failures)
          if (turn++ % number == 0) wrong += !sweep.holds(call, failure, name);
    }
    std::printf("| %s | %s | %ld | %ld | %ld |\n", each.verb, each.output, sweep.calls, sweep.tried, wrong);
    std::fflush(stdout);
    bad += wrong, tried += sweep.tried;
  }
  fs::current_path("/");
  fs::remove_all(top);
  std::printf("%ld tried, %ld bad\n", tried, bad);
  return bad == 0 && tried > 0 ? 0 : 1;
}

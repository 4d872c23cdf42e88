// SPDX-License-Identifier: BSD-3-Clause
// Makes every call by which a verb writes fail, one at a time and in every way, or kills the verb there or at a random
// time, or runs it on a disk that is full after some bytes. An error must be one line and exit code 4, the old output
// as it was, and no other file there; success in spite of it, as after a short write, must give the bytes of an
// undisturbed run. After a kill the old or the new output must be whole, and the next run must leave nothing else.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include "faults/failing_calls.hpp"
#include "faults/fault_cases.hpp"
#include "faults/files_below.hpp"
#include "tool/command/program.hpp"
#include "tool/verbs_in_help.hpp"

namespace fs = std::filesystem;
using namespace insonify;

namespace {

// Result of `insonify COMMAND -q` in this folder, in a process of its own.
struct Ended {
  int status;
  std::string said, printed;

  int code() const { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }
};

Ended run_apart(const std::string& command, double kill_after = -1) {
  const std::string outside = fs::current_path().parent_path(), said = outside + "/said",
                    printed = outside + "/printed";
  const pid_t child = fork();
  if (child == 0) {
    const rlimit seconds{120, 120};
    setrlimit(RLIMIT_CPU, &seconds);
    alarm(1200);  // if it waits: beside others it may take long
    wordexp_t words;
    if (wordexp(("insonify " + command + (command.find(" -q") == command.npos ? " -q" : "")).c_str(), &words,
                WRDE_NOCMD) != 0)
      _exit(99);
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    dup2(::open(printed.c_str(), flags, 0600), STDOUT_FILENO);
    dup2(::open(said.c_str(), flags, 0600), STDERR_FILENO);
    const int code = tool::run_tool(static_cast<int>(words.we_wordc), words.we_wordv);
    std::fflush(nullptr);
    _exit(code);
  }
  if (kill_after >= 0) {
    usleep(static_cast<useconds_t>(1e6 * kill_after));
    kill(child, SIGKILL);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return {status, bytes_of(said), bytes_of(printed)};
}

// One case with its files before, and after an undisturbed run.
class Sweep {
 public:
  Sweep(const FaultCase& each, const fs::path& kept, const fs::path& work) : case_(each), kept_(kept), work_(work) {
    if (!each.before.empty()) require_good(each.before, run_apart(each.before));
    fs::remove_all(kept_);
    fs::copy(work_, kept_, fs::copy_options::recursive);
    before_ = files_in(work_);
    fail_call(work_.string(), 0, Failure::none);
    require_good(each.command, run_apart(each.command));
    calls = counted_calls(), bytes = counted_bytes();
    after_ = files_in(work_);
    restore();
  }

  // Returns true if the answer to the failure of call `number`, or to a disk that is full after so many bytes, is good.
  bool holds(long number, Failure failure, const char* name) {
    fail_call(work_.string(), number, failure);
    const Ended ended = run_apart(case_.command);
    const bool failed = has_failed();
    fail_call(work_.string(), 0, Failure::none);
    const std::string problem = failure == Failure::kill ? after_kill() : after_failure(ended, failure);
    restore();
    if (failed || !problem.empty()) ++tried;
    if (problem.empty()) return true;
    std::printf("%s -o %s: %ld of %ld calls, %ld bytes, %s: %s; exit %d: %.600s\n", case_.verb.c_str(),
                case_.output.c_str(), number, calls, bytes, name, problem.c_str(), ended.code(), ended.said.c_str());
    return false;
  }

  // Returns true if the answer to a kill after a time is good.
  bool survives_kill(double seconds) {
    run_apart(case_.command, seconds);
    const std::string problem = after_kill();
    restore();
    ++tried;
    if (!problem.empty())
      std::printf("%s -o %s: killed after %g s: %s\n", case_.verb.c_str(), case_.output.c_str(), seconds,
                  problem.c_str());
    return problem.empty();
  }

  long calls = 0, bytes = 0, tried = 0;
  bool begins_well = true;  // true: the commands succeed undisturbed

 private:
  using Kind = FaultCase::Kind;

  void require_good(const std::string& command, const Ended& ended) {
    if (ended.code() == 0) return;
    std::printf("%s fails: %s\n", command.c_str(), ended.said.c_str());
    begins_well = false;
  }

  bool is_new(const Files& found) const { return same(found, after_, case_.kind); }

  std::string after_failure(const Ended& ended, Failure failure) {
    const Files found = files_in(work_);
    if (ended.code() == 0) return is_new(found) ? "" : "success with other files:" + difference(found, after_);
    if (ended.code() != 4 && !(case_.kind == Kind::resumes && ended.code() == 5)) return "exit code is not 4";
    if (std::count(ended.said.begin(), ended.said.end(), '\n') != 1) return "not one line";
    if (failure == Failure::full_disk)
      for (const std::string& part : {std::string("No space left on device"), fs::path(case_.output).stem().string()})
        if (ended.said.find(part) == std::string::npos) return "does not say " + part;
    if (case_.kind == Kind::resumes) return completed();
    // In the last step the name exists, but the disk does not confirm it.
    if (ended.said.find("is complete, but") != std::string::npos && is_new(found)) return "";
    return same(found, before_, case_.kind) ? "" : "other files:" + difference(found, before_);
  }

  std::string after_kill() {
    const Files found = visible(files_in(work_));
    bool whole = case_.kind == Kind::resumes || same(found, before_, case_.kind) || is_new(found);
    if (case_.kind == Kind::pair)
      whole = std::ranges::all_of(found, [&](const auto& file) {
        return file.second == before_[file.first] || file.second == after_[file.first];
      });
    return whole ? completed() : "neither old nor new:" + difference(found, before_);
  }

  // Completes the work by another run, and returns the files that it leaves.
  std::string completed() {
    const Ended again = run_apart(case_.command);
    if (again.code() != 0) return "the next run ends with " + std::to_string(again.code()) + ": " + again.said;
    const Files found = files_in(work_);
    return is_new(found) ? "" : "the next run leaves" + difference(found, after_);
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

  const FaultCase& case_;
  fs::path kept_, work_;
  Files before_, after_;
};

// Makes the inputs of the cases.
void make_inputs() {
  std::ofstream("echoes.csv") << "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n3.5,0,0,0.01,0.6,-0.3\n";
  for (const std::string& command : commands_for_inputs())
    if (const Ended made = run_apart(command); made.code() != 0)
      std::printf("%s fails: %s\n", command.c_str(), made.said.c_str());
}

// Returns the number of verbs that have --output and no case.
long verbs_without_case(const std::vector<FaultCase>& cases) {
  long without = 0;
  for (const std::string& verb : verbs_in(run_apart("--help").printed)) {
    const bool writes = run_apart(verb + " --help").printed.find("--output") != std::string::npos;
    if (!writes || std::ranges::any_of(cases, [&](const FaultCase& each) { return each.verb == verb; })) continue;
    std::printf("%s has --output and no case\n", verb.c_str());
    ++without;
  }
  return without;
}

constexpr std::pair<Failure, const char*> failures[] = {
    {Failure::no_space, "ENOSPC"},   {Failure::io_error, "EIO"},      {Failure::no_access, "EACCES"},
    {Failure::interrupted, "EINTR"}, {Failure::short_write, "short"}, {Failure::kill, "kill"}};
constexpr long disk_sizes = 30;

// A way to disturb each case. The functions return the number of wrong answers.
struct Sweeping {
  std::string mode;
  long number;  // every such failure or size of all cases; of kills the count of each case
  std::mt19937_64 random;
  long failure_turn = 0, size_turn = 0;

  long kills(Sweep& sweep, long count) {
    std::uniform_real_distribution<> moment(0, 0.3);
    long bad = 0;
    for (long i = 0; i < count; ++i) bad += !sweep.survives_kill(moment(random));
    return bad;
  }
  long full_disks(Sweep& sweep, long step) {
    long bad = 0;
    for (long size = 0; size < disk_sizes; ++size)
      if (size_turn++ % step == 0)
        bad += !sweep.holds(size * sweep.bytes / disk_sizes, Failure::full_disk, "full disk");
    return bad;
  }
  long faults(Sweep& sweep, long step) {
    long bad = 0;
    for (long call = 1; call <= sweep.calls; ++call)
      for (const auto& [failure, name] : failures)
        if (failure_turn++ % step == 0) bad += !sweep.holds(call, failure, name);
    return bad;
  }
  long bad_of(Sweep& sweep) {
    if (mode == "kills") return kills(sweep, number);
    if (mode == "disk") return full_disks(sweep, number);
    if (mode == "faults") return faults(sweep, number);
    return faults(sweep, number) + full_disks(sweep, disk_sizes - 1) + kills(sweep, 1);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(
        stderr,
        "usage: fault_sweep faults|disk|sample VERB|all STEP\n       fault_sweep kills VERB|all COUNT [SEED]\n");
    return 2;
  }
  const std::string verb = argv[2];
  Sweeping sweeping{argv[1], std::max(1L, std::atol(argv[3])),
                    std::mt19937_64(argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1)};
  char folder[] = "/tmp/insonify-faults-XXXXXX";
  if (!mkdtemp(folder)) return 2;
  const fs::path top = folder, work = top / "work";
  fs::create_directory(work);
  fs::current_path(work);
  make_inputs();
  const std::vector<FaultCase> cases = fault_cases();
  long bad = verbs_without_case(cases), tried = 0;
  std::printf("| verb | output | calls | bytes | tried | bad |\n|---|---|---|---|---|---|\n");
  for (const FaultCase& each : cases) {
    if (verb != "all" && verb != each.verb) continue;
    Sweep sweep(each, top / "kept", work);
    const long wrong = sweeping.bad_of(sweep) + !sweep.begins_well;
    std::printf("| %s | %s | %ld | %ld | %ld | %ld |\n", each.verb.c_str(), each.output.c_str(), sweep.calls,
                sweep.bytes, sweep.tried, wrong);
    std::fflush(stdout);
    bad += wrong, tried += sweep.tried;
  }
  fs::current_path("/");
  fs::remove_all(top);
  std::printf("%ld tried, %ld bad\n", tried, bad);
  return bad == 0 && tried > 0 ? 0 : 1;
}

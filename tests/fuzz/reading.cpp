// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/reading.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/stop_watch.hpp"
#include "fuzz/structured.hpp"
#include "tool/command/program.hpp"
#include "tool/command/reader_server.hpp"

namespace fs = std::filesystem;

namespace insonify {
namespace {

constexpr double most_seconds = 5, most_mib = 1024;

/// Returns how many times its CPU time a process may take on a loaded machine.
double beside_others() {
  double load = 0;
  getloadavg(&load, 1);
  return std::max(5.0, 5 * load / static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN)));
}

void start_alarm() { alarm(static_cast<unsigned>(2 * beside_others() * most_seconds)); }

std::string said_of(const fs::path& path) { return path.string() + ".said"; }

/// Prints to the file of what is said of `path` from now on.
void print_beside(const fs::path& path) {
  const int to = open(said_of(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(to, STDOUT_FILENO), dup2(to, STDERR_FILENO);
  close(to);
}

/// Calls `run` in a process of its own, which ends with the code that it returns. Returns how that process ended.
template <typename Run>
Reading in_a_process(Run&& run) {
  std::fflush(nullptr);  // else the child may write it again
  StopWatch watch;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int code = run();
    std::fflush(stderr);
    _exit(code);
  }
  int status = -1;
  rusage used{};
  wait4(child, &status, 0, &used);
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
          seconds_of(used.ru_utime) + seconds_of(used.ru_stime),
          watch.lap(),
          static_cast<double>(used.ru_maxrss) / 1024,
          {}};
}

int run_reader(const FuzzedReader& reader, const fs::path& path) {
  return tool::run_program([&] { return reader.read(path.string()), 0; }, "");
}

// Notes of a process that reads several files, one for each.
struct Note {
  bool done = false;
  int exit_code = 0;
  double seconds = 0, waited = 0;
};

/// Returns the processor time of a process and of its children that ended [s].
double processor_time(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  file.ignore(std::numeric_limits<std::streamsize>::max(), ')');
  std::string other;
  for (int i = 0; i < 11; ++i) file >> other;
  double ticks = 0, all = 0;
  for (int i = 0; i < 4 && file >> ticks; ++i) all += ticks;
  return all / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Reads `first` by this process, then the files, and notes how.
void read_and_note(const FuzzedReader& reader, const fs::path& first, const std::vector<fs::path>& paths,
                   std::size_t begin, Note* notes) {
  start_alarm();
  std::optional<tool::ReaderServer> server;
  if (reader.apart) run_reader(reader, first), server.emplace();
  const auto used = [&] { return processor_time(getpid()) + (server ? processor_time(server->process()) : 0); };
  double before = used();
  for (std::size_t i = begin; i < paths.size(); ++i) {
    print_beside(paths[i]);
    start_alarm();
    StopWatch watch;
    const int code = run_reader(reader, paths[i]);
    std::fflush(stderr);
    const double now = used();
    notes[i] = {true, code, now - before, watch.lap()};
    before = now;
  }
}

}  // namespace

bool Reading::good() const {
  const bool code = exit_code == 0 || (exit_code >= 2 && exit_code <= 5);
  const auto lines = std::count(said.begin(), said.end(), '\n');
  return code && seconds < most_seconds && waited < beside_others() * most_seconds && mib < most_mib &&
         lines == (exit_code == 0 ? 0 : 1);
}

Reading read_alone(const FuzzedReader& reader, const fs::path& path) {
  Reading reading = in_a_process([&] {
    start_alarm();
    print_beside(path);
    std::optional<tool::ReaderServer> server;
    if (reader.apart) server.emplace();
    return run_reader(reader, path);
  });
  reading.said = bytes_of(said_of(path));
  return reading;
}

std::vector<Reading> read_in_turn(const FuzzedReader& reader, const fs::path& first,
                                  const std::vector<fs::path>& paths) {
  const std::size_t bytes = paths.size() * sizeof(Note);
  void* const page = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) std::abort();
  auto* const notes = static_cast<Note*>(page);
  std::vector<Reading> readings;
  while (readings.size() < paths.size()) {
    const std::size_t begin = readings.size();
    const Reading all = in_a_process([&] { return read_and_note(reader, first, paths, begin, notes), 0; });
    Note last{false, all.exit_code, all.seconds, all.waited};  // of the file that ended the process, if one did
    for (std::size_t i = begin; i < paths.size(); ++i) {
      const Note& note = notes[i].done ? notes[i] : last;
      readings.push_back({note.exit_code, note.seconds, note.waited, all.mib, bytes_of(said_of(paths[i]))});
      if (!note.done) break;
      last.seconds -= note.seconds, last.waited -= note.waited;
    }
  }
  munmap(page, bytes);
  return readings;
}

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
// Damages small valid files at random and reads each in a process of its own, as the tool does: it must end with 0, 2,
// 3, 4 or 5, by no signal, within 5 s of processor and 1 GB, and say at most one line. Files that were found so once
// are read first, whole.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/stop_watch.hpp"
#include "fuzz/readers.hpp"
#include "fuzz/structured.hpp"
#include "tool/command/program.hpp"
#include "tool/command/reader_server.hpp"

namespace fs = std::filesystem;
using namespace insonify;

namespace {

constexpr double most_seconds = 5, most_mib = 1024;

/// Returns how many times its CPU time a process may take on a loaded machine.
double beside_others() {
  double load = 0;
  getloadavg(&load, 1);
  return std::max(5.0, 5 * load / static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN)));
}

// Damage of one file.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t end) {
    return end ? std::uniform_int_distribution<std::size_t>(0, end - 1)(random_) : 0;
  }

  /// Returns a damaged seed, mostly with the reader's own damage, if it has one.
  std::string mutant(const FuzzedReader& reader, const std::vector<std::string>& seeds) {
    std::string bytes = seeds[below(seeds.size())];
    if (reader.damage && below(8) > 0)
      return reader.damage(bytes, {[this](std::size_t end) { return below(end); },
                                   [this](std::string part) {
                                     damage(part, part);
                                     return part;
                                   }});
    for (std::size_t left = 1 + below(4); left > 0; --left) damage(bytes, seeds[below(seeds.size())]);
    return bytes;
  }

 private:
  void damage(std::string& bytes, const std::string& other) {
    if (bytes.empty()) bytes = "0";
    const std::size_t at = below(bytes.size()), length = 1 + below(std::min<std::size_t>(64, bytes.size() - at));
    switch (below(10)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 4:
        bytes.resize(at);
        break;
      case 5:
        bytes.insert(at, other.substr(below(other.size()), length));
        break;
      case 6:
        put_integer(bytes, at);
        break;
      case 7:
        bytes = bytes.substr(0, at) + other.substr(std::min(at, other.size()));
        break;
      default:
        replace_number(bytes, at);
    }
  }

  // Writes an integer that is a count too large, or negative, of 1 to 8 bytes in either order.
  void put_integer(std::string& bytes, std::size_t at) {
    static constexpr std::uint64_t values[] = {0,
                                               1,
                                               0x7f,
                                               0xff,
                                               0x7fff,
                                               0xffff,
                                               0x7fffffff,
                                               0xffffffff,
                                               1u << 30,
                                               0x7fffffffffffffff,
                                               0xffffffffffffffff,
                                               1ull << 40};
    const std::uint64_t value = values[below(std::size(values))];
    const std::size_t size = std::min(std::size_t{1} << below(4), bytes.size() - at);
    const bool swapped = below(2) == 1;
    for (std::size_t i = 0; i < size; ++i) bytes[at + (swapped ? size - 1 - i : i)] = static_cast<char>(value >> 8 * i);
  }

  // Replaces the next number by another text.
  void replace_number(std::string& bytes, std::size_t at) {
    static const char* const texts[] = {"0",
                                        "-1",
                                        "1",
                                        "nan",
                                        "inf",
                                        "1e308",
                                        "-1e308",
                                        "2147483647",
                                        "4294967295",
                                        "4294967296",
                                        "9223372036854775807",
                                        "18446744073709551615",
                                        "1e-320",
                                        "x",
                                        "",
                                        "999999999",
                                        "0.1.2",
                                        "3",
                                        "100000"};
    const char* digits = "0123456789";
    const std::size_t begin = bytes.find_first_of(digits, at);
    if (begin == bytes.npos) return;
    const std::size_t end = std::min(bytes.find_first_not_of("0123456789.eE+-", begin), bytes.size());
    bytes.replace(begin, end - begin, texts[below(std::size(texts))]);
  }

  std::mt19937_64 random_;
};

// The reading of one file.
struct Outcome {
  int exit_code = 0;
  double seconds = 0, waited = 0, mib = 0;  // of processor, and of the clock
  std::string said;

  bool good() const {
    const bool code = exit_code == 0 || (exit_code >= 2 && exit_code <= 5);
    const auto lines = std::count(said.begin(), said.end(), '\n');
    return code && seconds < most_seconds && waited < beside_others() * most_seconds && mib < most_mib &&
           lines == (exit_code == 0 ? 0 : 1);
  }
};

Outcome outcome_of(const FuzzedReader& reader, const fs::path& path) {
  const fs::path said = path.parent_path() / "said";
  std::fflush(nullptr);  // else the child may write it again
  StopWatch watch;
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(2 * beside_others() * most_seconds));
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int to = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(to, STDOUT_FILENO), dup2(to, STDERR_FILENO);
    const int code = tool::run_program(
        [&] {
          std::optional<tool::ReaderServer> server;
          if (reader.apart) server.emplace();
          reader.read(path.string());
          return 0;
        },
        "");
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
          seconds_of(used.ru_utime) + seconds_of(used.ru_stime), watch.lap(),
          static_cast<double>(used.ru_maxrss) / 1024, bytes_of(said)};
}

// Results of a reader for all its files.
struct Tally {
  std::size_t read = 0, refused = 0, bad = 0;
  double slowest = 0, largest = 0;

  void take(const Outcome& outcome) {
    ++read;
    refused += outcome.exit_code != 0;
    slowest = std::max(slowest, outcome.seconds);
    largest = std::max(largest, outcome.mib);
  }
};

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const fs::path& path : paths) files.push_back(bytes_of(path));
  return files;
}

Tally try_reader(const FuzzedReader& reader, const fs::path& seed_folder, const fs::path& regressions,
                 std::size_t mutants, std::uint64_t seed, const fs::path& work) {
  Tally tally;
  const fs::path path = work / ("mutant" + reader.extension);
  const auto try_bytes = [&](const std::string& bytes, const char* kind) {
    write_bytes(path, bytes);
    const Outcome outcome = outcome_of(reader, path);
    tally.take(outcome);
    const bool whole = std::strcmp(kind, "seed") != 0 || outcome.exit_code == 0;
    if (outcome.good() && whole) return;
    const std::string kept = reader.name + "-" + std::to_string(std::hash<std::string>{}(bytes)) + reader.extension;
    write_bytes(kept, bytes);
    std::printf("%s %s: exit %d, %.1f s, %.0f MiB, kept as %s: %s\n", reader.name.c_str(), kind, outcome.exit_code,
                outcome.seconds, outcome.mib, kept.c_str(), outcome.said.c_str());
    ++tally.bad;
  };
  const std::vector<std::string> seeds = files_in(seed_folder / reader.name);
  if (seeds.empty()) {
    std::printf("%s: has no seed in %s\n", reader.name.c_str(), seed_folder.c_str());
    ++tally.bad;
    return tally;
  }
  // Copy the files that those of the reader name.
  if (const fs::path beside = seed_folder / (reader.name + ".beside"); fs::exists(beside)) fs::copy(beside, work);
  for (const std::string& bytes : seeds) try_bytes(bytes, "seed");
  for (const std::string& bytes : files_in(regressions / reader.name)) try_bytes(bytes, "regression");
  Mutator mutator(seed);
  for (std::size_t i = 0; i < mutants; ++i) try_bytes(mutator.mutant(reader, seeds), "mutant");
  return tally;
}

}  // namespace

int main(int argc, char** argv) {
  const bool all_apart = argc == 7 && std::strcmp(argv[6], "apart") == 0;
  if (argc != 6 && !all_apart) {
    std::fprintf(stderr, "usage: fuzz_mutants READER|all SEEDS REGRESSIONS MUTANTS[,MUTANTS] SEED [apart]\n");
    return 2;
  }
  const std::string name = argv[1];
  char* after = nullptr;
  const std::size_t mutants = std::strtoull(argv[4], &after, 10), seed = std::strtoull(argv[5], nullptr, 10);
  const std::size_t with_damage = *after == ',' ? std::strtoull(after + 1, nullptr, 10) : mutants;
  // Work in memory if there is such a folder; otherwise each run of a mutant waits for the disk.
  std::string work = std::string(fs::is_directory("/dev/shm") ? "/dev/shm" : "/tmp") + "/insonify-mutants-XXXXXX";
  if (!mkdtemp(work.data())) return 2;
  std::size_t bad = 0, tried = 0;
  std::printf(
      "| reader | files | refused | bad | slowest [s of processor] | largest [MiB] |\n|---|---|---|---|---|---|\n");
  for (FuzzedReader reader : fuzzed_readers()) {
    if (name != "all" && name != reader.name) continue;
    reader.apart = reader.apart || all_apart;
    const Tally t = try_reader(reader, argv[2], argv[3], reader.damage ? with_damage : mutants, seed, work);
    std::printf("| %s | %zu | %zu | %zu | %.2f | %.0f |\n", reader.name.c_str(), t.read, t.refused, t.bad, t.slowest,
                t.largest);
    std::fflush(stdout);
    bad += t.bad, tried += t.read;
  }
  fs::remove_all(work);
  if (tried == 0) std::fprintf(stderr, "fuzz_mutants: no reader is called %s\n", name.c_str());
  return bad == 0 && tried > 0 ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
// Damages small valid files at random and reads them as the tool does: each must end with 0, 2, 3, 4 or 5, by no signal,
// within 5 s of processor and 1 GB, and say at most one line. Files that were found so once are read first, whole.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fuzz/mutator.hpp"
#include "fuzz/reading.hpp"
#include "fuzz/structured.hpp"

namespace fs = std::filesystem;
using namespace insonify;

namespace {

// Results of a reader for all its files.
struct Tally {
  std::size_t read = 0, refused = 0, bad = 0;
  double slowest = 0, largest = 0;

  void take(const Reading& reading) {
    ++read;
    refused += reading.exit_code != 0;
    slowest = std::max(slowest, reading.seconds);
    largest = std::max(largest, reading.mib);
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

// Reads files by a reader, and keeps those whose reading does not end as it must.
class Trial {
 public:
  Trial(const FuzzedReader& reader, fs::path work) : reader_(reader), work_(std::move(work)) {}

  const Tally& tally() const { return tally_; }

  /// Reads a file by a process of its own. A seed must be read, too.
  void read(const std::string& bytes, const char* kind) {
    const fs::path path = write(bytes, 0);
    judge(bytes, kind, read_alone(reader_, path), std::strcmp(kind, "seed") == 0);
  }

  /// Reads mutants in turn by one process, and again by one of its own what ends badly.
  void read_mutants(const std::string& seed, const std::vector<std::string>& mutants) {
    const fs::path first = work_ / ("first" + reader_.extension);
    write_bytes(first, seed);
    std::vector<fs::path> paths;
    for (const std::string& bytes : mutants) paths.push_back(write(bytes, paths.size()));
    const std::vector<Reading> readings = read_in_turn(reader_, first, paths);
    for (std::size_t i = 0; i < mutants.size(); ++i) {
      Reading reading = readings[i].good() ? readings[i] : read_alone(reader_, paths[i]);
      if (readings[i].exit_code < 0) reading.exit_code = readings[i].exit_code;  // after others alone
      judge(mutants[i], "mutant", reading, false);
    }
  }

 private:
  fs::path write(const std::string& bytes, std::size_t number) const {
    const fs::path path = work_ / ("mutant" + std::to_string(number) + reader_.extension);
    write_bytes(path, bytes);
    return path;
  }

  void judge(const std::string& bytes, const char* kind, const Reading& reading, bool whole) {
    tally_.take(reading);
    if (reading.good() && !(whole && reading.exit_code != 0)) return;
    const std::string kept = reader_.name + "-" + std::to_string(std::hash<std::string>{}(bytes)) + reader_.extension;
    write_bytes(kept, bytes);
    std::printf("%s %s: exit %d, %.1f s, %.0f MiB, kept as %s: %s\n", reader_.name.c_str(), kind, reading.exit_code,
                reading.seconds, reading.mib, kept.c_str(), reading.said.c_str());
    ++tally_.bad;
  }

  const FuzzedReader& reader_;
  fs::path work_;
  Tally tally_;
};

Tally try_reader(const FuzzedReader& reader, const fs::path& seed_folder, const fs::path& regressions,
                 std::size_t mutants, std::uint64_t seed, const fs::path& work) {
  constexpr std::size_t in_turn = 250;
  const std::vector<std::string> seeds = files_in(seed_folder / reader.name);
  if (seeds.empty()) {
    std::printf("%s: has no seed in %s\n", reader.name.c_str(), seed_folder.c_str());
    return {.bad = 1};
  }
  // Copy the files that those of the reader name.
  if (const fs::path beside = seed_folder / (reader.name + ".beside"); fs::exists(beside)) fs::copy(beside, work);
  Trial trial(reader, work);
  for (const std::string& bytes : seeds) trial.read(bytes, "seed");
  for (const std::string& bytes : files_in(regressions / reader.name)) trial.read(bytes, "regression");
  Mutator mutator(seed);
  for (std::size_t left = mutants; left > 0;) {
    std::vector<std::string> some(std::min(left, in_turn));
    for (std::string& bytes : some) bytes = mutator.mutant(reader, seeds);
    left -= some.size();
    // Readers with damage of their own run whole verbs.
    if (!reader.damage)
      trial.read_mutants(seeds.front(), some);
    else
      for (const std::string& bytes : some) trial.read(bytes, "mutant");
  }
  return trial.tally();
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

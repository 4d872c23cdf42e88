// SPDX-License-Identifier: BSD-3-Clause
// One target for libFuzzer; the name of the program, fuzz_pcd, says which reader it tries. An Error is the answer that
// is wanted; any other exception ends the program, as a crash does.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include "core/error.hpp"
#include "fuzz/readers.hpp"

namespace {

const insonify::FuzzedReader* tried = nullptr;
std::string tried_path;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments) {
  const std::string program = std::filesystem::path((*arguments)[0]).filename().string();
  for (const insonify::FuzzedReader& reader : insonify::fuzzed_readers())
    if (program == "fuzz_" + reader.name) tried = &reader;
  if (!tried) {
    std::fprintf(stderr, "%s: no such reader\n", program.c_str());
    std::exit(2);
  }
  const char* folder = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
  tried_path = std::string(folder) + "/insonify-" + program + "-" + std::to_string(getpid()) + tried->extension;
  std::atexit([] { std::remove(tried_path.c_str()); });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (std::FILE* file = std::fopen(tried_path.c_str(), "wb")) {
    std::fwrite(bytes, 1, size, file);
    std::fclose(file);
  }
  try {
    tried->read(tried_path);
  } catch (const insonify::Error&) {
  }
  return 0;
}

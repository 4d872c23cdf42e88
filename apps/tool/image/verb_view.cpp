// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "core/error.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

/// Replaces this process by insonify-view, the program beside this one. Throws Error(runtime) if that fails.
void view(const std::vector<std::string>& arguments) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  std::string viewer = error ? "insonify-view" : (self.parent_path() / "insonify-view").string();
  std::vector<char*> argv{viewer.data()};
  std::vector<std::string> own = arguments;
  for (std::string& argument : own) argv.push_back(argument.data());
  argv.push_back(nullptr);
  // libucs, which VTK 9.3 loads by way of MPI, else answers a crash for lack of memory with pages of its own.
  setenv("UCX_ERROR_SIGNALS", "", 0);
  execvp(viewer.c_str(), argv.data());  // returns only if it failed
  fail(ErrorKind::runtime, "cannot start ", viewer, ": ", std::strerror(errno),
       "; it belongs beside insonify, where `cmake --build --preset release --target insonify-view` puts it");
}

}  // namespace

Verb view_verb() {
  return {"view", "the interactive viewer: a run, or a scene before any ping; see insonify view --help", {}, {}, view};
}

}  // namespace insonify::tool

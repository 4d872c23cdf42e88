// SPDX-License-Identifier: BSD-3-Clause
#include "tool/tool_runner.hpp"

#include <cstdio>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include "support/test.hpp"
#include "tool/command/program.hpp"

namespace fs = std::filesystem;

std::string ToolTest::read(const std::string& name) const {
  EXPECT_TRUE(fs::exists(path(name))) << name << " is missing";
  return insonify::file_bytes(path(name));
}

// The tool runs in a fork of this process, which has loaded its hundred libraries already. The process itself must not use
// OpenMP before (PCL does, where it estimates normals): its threads do not survive the fork.
ToolResult ToolTest::run(const std::string& arguments) const {
  // stdout and stderr go beside the folder, so that they do not count as output of the tool.
  const std::string out = folder_.string() + ".out", err = folder_.string() + ".err";
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    wordexp_t words;
    if (chdir(folder_.c_str()) != 0 || !std::freopen(out.c_str(), "w", stdout) ||
        !std::freopen(err.c_str(), "w", stderr) || wordexp(("insonify " + arguments).c_str(), &words, WRDE_NOCMD) != 0)
      _exit(99);
    const int code = insonify::tool::run_tool(static_cast<int>(words.we_wordc), words.we_wordv);
    std::fflush(nullptr);
    _exit(code);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, insonify::file_bytes(out), insonify::file_bytes(err)};
}

std::string ToolTest::succeed(const std::string& arguments) const {
  const ToolResult result = run(arguments);
  EXPECT_EQ(result.exit_code, 0) << "insonify " << arguments << "\n" << result.err;
  return result.out;
}

void ToolTest::have(const std::string& name, const std::string& command) const {
  const std::string line = command + " -o " + name;
  const fs::path kept = folder_.parent_path() / ("kept" + std::to_string(std::hash<std::string>{}(line)));
  if (!fs::exists(kept)) {
    succeed(line + " -q");
    fs::copy(folder_ / name, kept, fs::copy_options::recursive);
  } else {
    fs::copy(kept, folder_ / name, fs::copy_options::recursive);
  }
}

void ToolTest::expect_refused(const std::string& arguments, int exit_code,
                              const std::vector<std::string>& parts) const {
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) names.insert(entry.path().string());
    return names;
  };
  const auto before = files();
  const ToolResult result = run(arguments + " -q");
  EXPECT_EQ(result.exit_code, exit_code) << "insonify " << arguments << "\n" << result.err;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) EXPECT_THAT(result.err, HasSubstr(part)) << arguments;
  EXPECT_EQ(files(), before) << arguments << " left something behind";
}

std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv) {
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = row.at(i);
  }
  return rows;
}

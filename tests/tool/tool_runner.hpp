// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "store/cube.hpp"
#include "support/test.hpp"

/// True if the tool was built with GDAL.
#ifdef INSONIFY_TEST_GDAL
inline constexpr bool with_gdal = true;
#else
inline constexpr bool with_gdal = false;
#endif

/// A run of the tool that has ended: its exit code, and what it printed on stdout and stderr.
struct ToolResult {
  int exit_code = -1;
  std::string out, err;
};

/// Each test in an empty folder of its own, with the tool at hand.
class ToolTest : public testing::Test {
 protected:
  /// Runs `insonify ARGUMENTS`, split as a shell does, in the folder.
  ToolResult run(const std::string& arguments) const;
  /// Runs and demands success; returns what came out on stdout.
  std::string succeed(const std::string& arguments) const;
  /// The file or folder `name` that `insonify COMMAND -o name` writes, computed once per program.
  void have(const std::string& name, const std::string& command) const;
  /// Demands an exit code, exactly one line on stderr holding every part, and no file beside those there before.
  void expect_refused(const std::string& arguments, int exit_code, const std::vector<std::string>& parts) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& content) const { insonify::own_file(name, content); }
  std::string read(const std::string& name) const;
  nlohmann::json read_json(const std::string& name) const { return nlohmann::json::parse(read(name)); }
  /// Runs a verb with --json, demands success, and returns the value that it prints.
  nlohmann::json json_of(const std::string& arguments) const {
    return nlohmann::json::parse(succeed(arguments + " --json"));
  }
  /// Reads the manifest, the cube or the first ping of a run.
  nlohmann::json manifest_of(const std::string& run) const { return read_json(run + "/manifest.json"); }
  insonify::Cube cube_of(const std::string& run) const { return insonify::read_cube(path(run + "/cube.h5")); }
  insonify::Ping ping_of(const std::string& run) const { return cube_of(run).pings.at(0); }

  const std::filesystem::path folder_ = insonify::own_folder();
};

/// Rows of a CSV by the names of its header, without lines that begin with #.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv);

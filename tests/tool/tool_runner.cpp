#include "tool/tool_runner.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

void ToolTest::SetUp() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = fs::path(testing::TempDir()) / ("insonify_" + std::string(test->name()) + "_" + std::to_string(getpid()));
  fs::create_directories(folder_);
}

void ToolTest::TearDown() { fs::remove_all(folder_); }

void ToolTest::write(const std::string& name, const std::string& content) const {
  std::ofstream(folder_ / name, std::ios::binary) << content;
}

std::string ToolTest::read(const std::string& name) const {
  std::ifstream file(folder_ / name, std::ios::binary);
  EXPECT_TRUE(file) << name << " is missing";
  return {std::istreambuf_iterator<char>(file), {}};
}

ToolResult ToolTest::run(const std::string& arguments) const {
  // stdout and stderr go beside the folder, so that they do not count as output of the tool.
  const std::string out = folder_.string() + ".out", err = folder_.string() + ".err";
  const std::string command =
      "cd '" + folder_.string() + "' && '" INSONIFY_TOOL "' " + arguments + " >'" + out + "' 2>'" + err + "'";
  const int status = std::system(command.c_str());
  const auto slurp = [](const std::string& file) {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const ToolResult result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
  fs::remove(out);
  fs::remove(err);
  return result;
}

std::string ToolTest::succeed(const std::string& arguments) const {
  const ToolResult result = run(arguments);
  EXPECT_EQ(result.exit_code, 0) << "insonify " << arguments << "\n" << result.err;
  return result.out;
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
  for (const std::string& part : parts) EXPECT_THAT(result.err, testing::HasSubstr(part)) << arguments;
  EXPECT_EQ(files(), before) << arguments << " left something behind";
}

// SPDX-License-Identifier: BSD-3-Clause
// Products of 10 000 pings take the memory of those of 1 000: pings stream.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "formats/gsf_decoder.hpp"
#include "formats/las_decoder.hpp"
#include "store/cube.hpp"
#include "support/sanitizers.hpp"
#include "tool/tool_runner.hpp"

namespace {

constexpr std::size_t few_pings = 1000, many_pings = 10000;

/// A head that looks straight down on a level bed, with an echo in each of its four narrow beams, along a line.
Cube swath_cube(std::size_t pings) {
  Cube cube;
  cube.sound_speed = 1500, cube.centre_frequency = 4e5, cube.bandwidth = 2e4, cube.sonar = "small";
  cube.insonify_version = "1";
  Ping ping;
  ping.fan = make_fan(4, radians(4), radians(1), radians(1));
  ping.gate = {2, 3, 0.03};
  ping.pressure = ComplexGridF::Constant(4, static_cast<Eigen::Index>(ping.gate.bins()), std::complex<float>(1e-4F));
  for (Eigen::Index b = 0; b < 4; ++b) ping.pressure(b, 16 + b) = 1;
  for (std::size_t p = 0; p < pings; ++p) {
    ping.number = static_cast<std::int64_t>(p);
    ping.time = 0.1 * static_cast<double>(p);
    ping.world_from_head = pose_from_yaw_pitch_roll({0.05 * static_cast<double>(p), 0, -1}, 0, pi / 2, 0);
    cube.pings.push_back(ping);
  }
  return cube;
}

/// Runs the tool as a process of its own; returns its largest resident set [MiB].
double peak_of_tool(const std::string& folder, const std::vector<std::string>& words) {
  std::vector<char*> arguments{const_cast<char*>("insonify")};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.c_str()) == 0) execv(INSONIFY_TOOL, arguments.data());
    _exit(99);
  }
  int status = -1;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << words[3];
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

class ExportMemory : public ToolTest {};

TEST_F(ExportMemory, of_ten_thousand_pings_is_that_of_a_thousand) {
  if (sanitized) GTEST_SKIP() << "what has been freed is kept";
  write_cube(path("few.h5"), swath_cube(few_pings));
  write_cube(path("many.h5"), swath_cube(many_pings));
  const auto exported = [&](const std::string& cube, const std::string& to) {
    return peak_of_tool(folder_.string(),
                        {"export", cube + ".h5", "--to", to, "--anchor", "54.1,7.9", "-q", "-o", cube + "." + to});
  };
  for (const char* to : {"gsf", "las", "csv", "mcap"}) {
    const double few = exported("few", to), many = exported("many", to);
    RecordProperty(to, std::to_string(few) + " and " + std::to_string(many) + " MiB");
    EXPECT_LT(many, few + 8) << to;
  }
  EXPECT_EQ(decode::read_las(read("many.las")).size(), 4 * many_pings);
  EXPECT_EQ(decode::read_gsf(read("many.gsf")).swaths.size(), many_pings);
}

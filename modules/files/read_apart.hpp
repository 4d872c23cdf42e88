// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>

#include "files/child_arrays.hpp"

namespace insonify {

/// Limits of the process that reads a file, if a process of its own does.
struct ReadLimits {
  std::size_t memory = std::size_t{1} << 30;  ///< address space beyond that of an idle process [bytes]
  unsigned seconds = 60;                      ///< processor time; the limit of wall time is five times this [s]
  std::size_t sent = std::size_t{1} << 38;    ///< largest result, if the user's limits leave twice that [bytes]
};

/// Returns the limits for a library that reads a file of `bytes` bytes.
ReadLimits limits_of_file(std::size_t bytes);

/// The reading of a file of others. Processes that were forked from one program can call the function and pass its
/// arguments, which no closure could.
struct ReadTask {
  using Send = std::function<void(ArraySender&)>;  ///< sends arguments

  std::string path;  ///< with which messages begin
  ReadLimits limits;
  void (*read)(ArrayReceiver& arguments, ArraySender& to) = nullptr;  ///< sends what it found

  /// Calls `read` with the arguments that `memory` holds; what it sends, at most `most` bytes, takes their place.
  /// Throws what `read` throws: Error and std::bad_alloc as they are, others as Error(content).
  void run(const std::shared_ptr<SharedMemory>& memory, const std::size_t& most = ArraySender::all_of_it) const;
  /// Leaves in `memory` what `arguments` sends.
  static void send(const Send& arguments, const SharedMemory& memory);
};

/// A process that reads files for this one. A program that reads files of strangers sets one (set_reader_process),
/// since damaged files can make HDF5, GDAL, libpng and VTK crash, or search and take memory without end.
struct ReaderProcess {
  /// Returns the memory in which task.read sent its values, for the arguments that `arguments` sends. Throws what it
  /// threw, or an Error if the process ended otherwise.
  std::function<std::shared_ptr<SharedMemory>(const ReadTask& task, const ReadTask::Send& arguments)> run{};
  /// Called there, by expect_from_file, if a file will rightly take so many bytes more.
  std::function<void(double bytes)> expect{};
};

/// Makes `process` read files from now on; an empty one: this process, as at the start. Returns what did before. Call
/// it before any thread reads.
ReaderProcess set_reader_process(ReaderProcess process);

/// Returns what a task sends, by the reader process, else from this process. Throws as ReadTask::run and
/// ReaderProcess::run.
ArrayReceiver read_apart(const ReadTask& task, const ReadTask::Send& arguments);

/// Returns what read(to, arguments...) sends, as above. `read` is a lambda without captures: another process may call
/// it with copies of the arguments, which are values that an ArraySender sends.
template <typename Read, typename... Arguments>
ArrayReceiver read_apart(const std::string& path, const ReadLimits& limits, Read, const Arguments&... arguments) {
  static_assert(std::is_empty_v<Read>, "captures do not reach another process");
  const auto call = [](ArrayReceiver& from, ArraySender& to) {
    std::tuple<Arguments...> values;
    std::apply([&](auto&... value) { from(value...), Read{}(to, value...); }, values);
  };
  return read_apart({path, limits, call}, [&](ArraySender& to) { to(arguments...); });
}

/// A number of values that a file announces.
struct Announced {
  double count;
  const char* what;  ///< pixels, cells, samples
  double bytes;      ///< that each takes in memory
  const char* remedy = "copy or export it again";
};

/// Throws Error(content) if a file of `bytes` announces more than 64 MiB and 1032 times its size, the largest factor of
/// zlib: the file is damaged, or made to exhaust memory. In a reader process, limits grow by the announced memory.
void expect_from_file(const std::string& path, std::size_t bytes, const Announced& announced);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#include "files/read_apart.hpp"

#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "core/error.hpp"

namespace insonify {
namespace {

ReaderProcess reader_process;

std::shared_ptr<SharedMemory> read_here(const ReadTask& task, const ReadTask::Send& arguments) {
  auto memory = std::make_shared<SharedMemory>(task.limits.sent);
  ReadTask::send(arguments, *memory);
  task.run(memory);
  return memory;
}

}  // namespace

ReadLimits limits_of_file(std::size_t bytes) {
  // Allows for VTK, which makes larger numbers of text, and for GDAL, which loads seventy libraries.
  constexpr std::size_t memory_per_byte = 40, memory_at_least = std::size_t{768} << 20;
  constexpr std::size_t bytes_per_second = 1 << 20;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::size_t seconds_at_least = 20;
#else
  constexpr std::size_t seconds_at_least = 2;
#endif
  return {memory_per_byte * bytes + memory_at_least,
          static_cast<unsigned>(bytes / bytes_per_second + seconds_at_least)};
}

void ReadTask::send(const Send& arguments, const SharedMemory& memory) {
  ArraySender sender(memory);
  arguments(sender);
}

void ReadTask::run(const std::shared_ptr<SharedMemory>& memory, const std::size_t& most) const {
  ArrayReceiver arguments(path, memory);
  ArraySender to(*memory, most);
  try {
    read(arguments, to);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    fail(ErrorKind::content, path, ": cannot be read (", error.what(),
         "); it is damaged or cut off: copy or export it again");
  }
}

ReaderProcess set_reader_process(ReaderProcess process) { return std::exchange(reader_process, std::move(process)); }

ArrayReceiver read_apart(const ReadTask& task, const ReadTask::Send& arguments) {
  const auto memory = reader_process.run ? reader_process.run(task, arguments) : read_here(task, arguments);
  memory->keep_sent();
  return {task.path, memory};
}

void expect_from_file(const std::string& path, std::size_t bytes, const Announced& announced) {
  constexpr double least = 0x1p26, per_byte = 1032, mib = 0x1p20;
  const double wanted = announced.count * announced.bytes, most = least + per_byte * static_cast<double>(bytes);
  if (!(wanted <= most))
    fail(ErrorKind::content, path, ": its header announces ", announced.count, " ", announced.what, ", ", wanted / mib,
         " MiB of memory; a file of ", bytes, " bytes may take ", std::floor(most / mib), " MiB at most; ",
         announced.remedy);
  if (reader_process.expect) reader_process.expect(wanted);
}

}  // namespace insonify

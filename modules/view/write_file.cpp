#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/error.hpp"
#include "view/write_file_internal.hpp"

namespace insonify {

void write_file_atomically(const std::string& path, const unsigned char* bytes, std::size_t count, const char* who) {
  const std::string part = path + ".tmp";
  std::error_code trouble;
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    if (!file) fail(ErrorKind::file, who, ": cannot write ", path, "; does its folder exist, and may you write there?");
    file.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
    file.close();
    if (!file) {
      std::filesystem::remove(part, trouble);
      fail(ErrorKind::file, who, ": cannot write all of ", path, " (", count, " bytes); is the disk full?");
    }
  }
  std::filesystem::rename(part, path, trouble);
  if (trouble) {
    const std::string reason = trouble.message();
    std::filesystem::remove(part, trouble);
    fail(ErrorKind::file, who, ": cannot write ", path, ": ", reason);
  }
}

}  // namespace insonify

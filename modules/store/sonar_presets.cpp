// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <dlfcn.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/path_status.hpp"
#include "store/nearest_word.hpp"
#include "store/sonar_file.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

bool is_data_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "sonars", ignored);
}

/// Returns the folder of the program, or of the library of Python's module, that this code is part of.
fs::path folder_of_this_code() {
  Dl_info found{};
  return dladdr(reinterpret_cast<void*>(&is_data_folder), &found) ? fs::path(found.dli_fname).parent_path()
                                                                  : fs::path();
}

std::vector<std::string> preset_names() {
  const fs::path folder = fs::path(data_folder()) / "sonars";
  std::vector<std::string> names;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  });
  std::sort(names.begin(), names.end());
  return names;
}

std::string preset_path(const std::string& name) {
  return (fs::path(data_folder()) / "sonars" / (name + ".toml")).string();
}

// Returns the names that contain the word ("oculus" matches six presets), or else the nearest one by spelling.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string wanted = lower_case(word);
  std::vector<std::string> with_it;
  std::copy_if(names.begin(), names.end(), std::back_inserter(with_it),
               [&](const std::string& name) { return !wanted.empty() && name.find(wanted) != std::string::npos; });
  const std::string list = with_it.empty() ? nearest_word(wanted, names) : joined(with_it);
  return list.empty() ? "." : "; did you mean " + list + "?";
}

}  // namespace

std::string data_folder() {
  if (const char* chosen = std::getenv("INSONIFY_DATA"); chosen && *chosen) {
    if (!is_data_folder(chosen))
      fail(ErrorKind::file, "INSONIFY_DATA = ", chosen, ": is not a folder with sonars/ in it");
    return chosen;
  }
  // A wheel of Python contains its data. An installed program has ../share/insonify beside it, a program in
  // build/<preset>/bin the source tree.
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& folder :
       {folder_of_this_code() / "data", program / "../share/insonify", program / "../../../data",
        fs::path(INSONIFY_INSTALL_DATA), fs::path(INSONIFY_SOURCE_DATA),
        fs::path("/usr/share/insonify")})  // folder of Debian's package, for users of the library
    if (is_data_folder(folder)) return folder.lexically_normal().string();
  fail(ErrorKind::file, "data files (sonars/, materials.toml) found neither beside the program nor in ",
       INSONIFY_INSTALL_DATA, "; set INSONIFY_DATA to their folder");
}

SonarFile find_sonar(const std::string& name_or_path) {
  if (fs::path(name_or_path).extension() == ".toml") return load_sonar_file(name_or_path);
  const std::vector<std::string> names = preset_names();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end())
    fail(ErrorKind::argument, "sonar '", name_or_path, "' is not a preset", suggestion(name_or_path, names),
         " `insonify sonars` lists all; a path ending in .toml is read as a file");
  return load_sonar_file(preset_path(name_or_path));
}

std::vector<SonarFile> list_sonars() {
  std::vector<SonarFile> sonars;
  for (const std::string& name : preset_names()) sonars.push_back(load_sonar_file(preset_path(name)));
  return sonars;
}

}  // namespace insonify

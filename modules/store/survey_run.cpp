// SPDX-License-Identifier: BSD-3-Clause
#include "store/survey_run.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "files/sha256.hpp"
#include "store/run_directory.hpp"
#include "store/toml_tree.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

namespace fs = std::filesystem;

namespace {

constexpr int survey_schema = 1;
constexpr const char* end_of_mark = "# end of the mark\n";

std::string description_path(const std::string& folder) { return (fs::path(folder) / "survey.toml").string(); }

/// Waits until a file, or the names in a folder, are on disk.
void sync_to_disk(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && (::fsync(file) == 0 || errno == EINVAL);  // EINVAL: nothing to wait for
  const int reason = errno;
  if (file >= 0) ::close(file);
  if (!synced) fail(ErrorKind::file, path, ": cannot be put on disk: ", std::generic_category().message(reason));
}

std::int64_t count_in(const std::string& path, const TomlValue& table, const char* key, double least) {
  const double value = toml_number(path, table, key), most = most_survey_pings;
  if (!(value >= least && value <= most && value == std::floor(value)))
    fail_in_file(path, table.line, key, " = ", value, ", must be a whole number from ", least, " to ", most);
  return static_cast<std::int64_t>(value);
}

SurveyRunHead head_in(const std::string& path, const TomlValue& table, const std::vector<SurveyRunHead>& before) {
  const std::string name = toml_text(path, table, "name");
  const auto is_called_so = [&](const SurveyRunHead& head) { return head.name == name; };
  if (!is_plain_name(name) || std::any_of(before.begin(), before.end(), is_called_so))
    fail_in_file(path, table.line, "name = ", as_toml(name), ", must be a name of its own, of letters, digits, '-', ",
                 "'_' and '.'");
  return {name, static_cast<std::size_t>(count_in(path, table, "pings", 1)),
          static_cast<std::size_t>(count_in(path, table, "pings_per_block", 1))};
}

/// Returns the names of the entries of a folder, sorted.
std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
  });
  std::sort(names.begin(), names.end());
  return names;
}

/// Throws Error(file) for a folder that is no survey. Files that another shard writes as it starts are allowed.
void require_new(const std::string& folder) {
  if (!path_exists(folder)) return;
  if (!is_folder(folder)) fail(ErrorKind::file, folder, ": is a file, must be a folder of a survey, or a new one");
  for (const std::string& name : names_in(folder))
    if (!name.starts_with(".survey.toml.") && name != "survey.toml")
      fail(ErrorKind::file, folder, ": holds ", name, " but no survey.toml, so it is no survey; choose another folder");
}

/// Throws Error for blocks of another size, and for a survey.toml that was changed.
void require_same_blocks(const std::string& folder, const SurveyRun& there, const SurveyRun& run) {
  for (std::size_t h = 0; h < std::min(there.heads.size(), run.heads.size()); ++h)
    if (const std::size_t held = there.heads[h].pings_per_block; held != run.heads[h].pings_per_block)
      fail(ErrorKind::argument, folder, ": blocks of head ", there.heads[h].name, " hold ", held, " pings, not ",
           run.heads[h].pings_per_block, " as asked for; leave the number out to go on, or choose another folder");
  if (there.heads != run.heads)
    fail(ErrorKind::content, description_path(folder), ": lists heads or pings that its mission does not have; ",
         "choose another folder");
}

std::string description_of(const SurveyRun& run) {
  std::string text = "# A survey: blocks of pings in NAME/blocks, joined by `insonify merge`.\nschema = " +
                     std::to_string(survey_schema) + "\nmission_sha256 = \"" + run.mission_sha256 + "\"\n";
  for (const SurveyRunHead& head : run.heads)
    text += "\n[[head]]\nname = " + as_toml(head.name) + "\npings = " + std::to_string(head.pings) +
            "\npings_per_block = " + std::to_string(head.pings_per_block) + "\n";
  return text;
}

}  // namespace

bool is_survey_run(const std::string& folder) { return path_exists(description_path(folder)); }

bool is_of_survey(const std::string& folder, const std::string& name) {
  const fs::path path(name);
  if (path.has_parent_path()) return is_folder(fs::path(folder) / *path.begin() / "blocks");
  constexpr std::array stems = {"survey", "mission", "manifest", "returns", "coverage", "mosaic", "track", "scene"};
  return name.starts_with("status") || std::find(stems.begin(), stems.end(), path.stem().string()) != stems.end();
}

void open_survey_run(const std::string& folder, const SurveyRun& run) {
  std::error_code error;
  if (!is_survey_run(folder)) {
    require_new(folder);
    fs::create_directories(folder, error);
    if (error) fail(ErrorKind::file, folder, ": cannot be created: ", error.message());
    write_file(description_path(folder), description_of(run));
  }
  const SurveyRun there = load_survey_run(folder);
  if (there.mission_sha256 != run.mission_sha256)
    fail(ErrorKind::content, folder, ": holds a survey of another mission, or of this one with other inputs (SHA-256 ",
         there.mission_sha256.substr(0, 12), ", not ", run.mission_sha256.substr(0, 12), "); choose another folder");
  require_same_blocks(folder, there, run);
  for (const SurveyRunHead& head : run.heads) {
    fs::create_directories(block_files(folder, head.name, 0).folder, error);
    if (error) fail(ErrorKind::file, folder, ": cannot be created: ", error.message());
  }
}

SurveyRun load_survey_run(const std::string& folder) {
  if (!is_survey_run(folder)) fail(ErrorKind::file, folder, ": is not the folder of a survey (no survey.toml in it)");
  const std::string path = description_path(folder);
  const TomlValue document = load_toml(path);
  if (const double schema = toml_number(path, document, "schema"); schema != survey_schema)
    fail_in_file(path, 1, "schema = ", schema, ", this version reads schema ", survey_schema);
  SurveyRun run;
  run.mission_sha256 = toml_text(path, document, "mission_sha256");
  if (const TomlValue* heads = document.find("head"))
    for (const TomlValue& head : heads->items) run.heads.push_back(head_in(path, head, run.heads));
  if (run.heads.empty()) fail_in_file(path, 1, "lists no [[head]], must list at least one");
  return run;
}

BlockFiles block_files(const std::string& run_folder, const std::string& head, std::int64_t block) {
  const fs::path folder = fs::path(run_folder) / head / "blocks";
  const std::string stem = (folder / printed("%06lld", static_cast<long long>(block))).string();
  return {folder.string(), stem + ".h5",         stem + ".ply",        stem + ".coverage.ply",
          stem + ".done",  stem + ".partial.h5", stem + ".partial.ply"};
}

void finish_block(const BlockFiles& files, const std::string& mission_sha256, const std::vector<FailedPing>& failed) {
  std::string text = "mission_sha256 = \"" + mission_sha256 + "\"\n";
  if (path_exists(files.cube)) {
    for (const std::string& path : {files.cube, files.returns}) sync_to_disk(path);
    text += "cube_sha256 = \"" + sha256_of_file(files.cube) + "\"\nreturns_sha256 = \"" +
            sha256_of_file(files.returns) + "\"\n";
  }
  if (path_exists(files.coverage)) {
    sync_to_disk(files.coverage);
    text += "coverage_sha256 = \"" + sha256_of_file(files.coverage) + "\"\n";
  }
  for (const FailedPing& ping : failed)
    text += "\n[[failed]]\nping = " + std::to_string(ping.number) + "\nreason = " + as_toml(ping.reason) + "\n";
  text += end_of_mark;
  sync_to_disk(files.folder);
  write_file(files.mark, text);
  sync_to_disk(files.mark);
  sync_to_disk(files.folder);
  remove_leftovers(files);
}

std::optional<BlockMark> find_mark(const BlockFiles& files, const std::string& mission_sha256) {
  if (!path_exists(files.mark)) return std::nullopt;
  // After a loss of power a file may be empty, cut short, or zeros.
  const std::string text = read_text_file(files.mark);
  if (!text.ends_with(end_of_mark) || text.find('\0') != text.npos) return std::nullopt;
  const TomlValue document = load_toml(files.mark);
  BlockMark mark;
  mark.mission_sha256 = toml_text(files.mark, document, "mission_sha256");
  if (mark.mission_sha256 != mission_sha256)
    fail(ErrorKind::content, files.mark, ": is of another mission (SHA-256 ", mark.mission_sha256.substr(0, 12),
         ", not ", mission_sha256.substr(0, 12), "); remove it and its block");
  if (document.find("cube_sha256")) {
    mark.cube_sha256 = toml_text(files.mark, document, "cube_sha256");
    mark.returns_sha256 = toml_text(files.mark, document, "returns_sha256");
  }
  if (document.find("coverage_sha256")) mark.coverage_sha256 = toml_text(files.mark, document, "coverage_sha256");
  if (const TomlValue* failed = document.find("failed"))
    for (const TomlValue& ping : failed->items)
      mark.failed.push_back({count_in(files.mark, ping, "ping", 0), toml_text(files.mark, ping, "reason")});
  return mark;
}

std::vector<StoredBlock> stored_blocks(const std::string& folder, const SurveyRun& run, const SurveyRunHead& head) {
  std::vector<StoredBlock> blocks;
  const std::string beside = block_files(folder, head.name, 0).folder;
  if (!path_exists(beside)) return blocks;
  for (const std::string& name : names_in(beside)) {
    std::size_t number = 0;
    const auto end = std::from_chars(name.data(), name.data() + name.size(), number);
    if (end.ec != std::errc{} || number >= head.blocks()) continue;
    const BlockFiles files = block_files(folder, head.name, static_cast<std::int64_t>(number));
    if (fs::path(files.mark).filename() != name) continue;
    if (auto mark = find_mark(files, run.mission_sha256)) blocks.push_back({number, files, std::move(*mark)});
  }
  std::sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return blocks;
}

std::vector<StoredBlock> all_blocks(const std::string& folder, const SurveyRun& run, const SurveyRunHead& head) {
  std::vector<StoredBlock> blocks = stored_blocks(folder, run, head);
  std::size_t next = 0;
  while (next < blocks.size() && blocks[next].number == next) ++next;
  if (next < head.blocks())
    fail(ErrorKind::content, folder, ": block ", next, " of head ", head.name,
         " is not done; run the survey (or its missing shards) again");
  return blocks;
}

void remove_leftovers(const BlockFiles& files) {
  const std::string begin = "." + fs::path(files.mark).stem().string() + ".";
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(files.folder, ignored))
    if (entry.path().filename().string().starts_with(begin)) fs::remove(entry.path(), ignored);
  for (const std::string& path : {files.partial_cube, files.partial_returns})
    if (path_exists(files.mark)) fs::remove(path, ignored);
}

void require_unchanged(const BlockFiles& files, const BlockMark& mark) {
  for (const auto& [path, digest] :
       {std::pair(files.cube, mark.cube_sha256), std::pair(files.returns, mark.returns_sha256),
        std::pair(files.coverage, mark.coverage_sha256)})
    if (!digest.empty() && sha256_of_file(path) != digest)
      fail(ErrorKind::content, path, ": was changed since it was made (its SHA-256 is not that of ", files.mark,
           "); remove the mark and run the survey again");
}

}  // namespace insonify

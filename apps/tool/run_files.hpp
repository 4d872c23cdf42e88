#pragma once
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "returns/ping.hpp"
#include "returns/quantise.hpp"
#include "store/cube.hpp"
#include "store/run_directory.hpp"
#include "tool/head_setup.hpp"
#include "tool/options.hpp"
#include "tool/progress.hpp"
#include "view/picture.hpp"

namespace insonify::tool {

/// Writes cube.h5, run.toml, fan.png (unless refused) and manifest.json into `directory`. `manifest` is completed with
/// version, sonar, water, gate, counts of samples and peak memory.
void write_run(const RunDirectory& directory, const CommonOptions& common, const RunOptions& run,
               const HeadSetup& setup, const Ping& ping, const std::string& run_toml_head,
               nlohmann::ordered_json& manifest, Progress& progress);

/// Levels of a ping as they are drawn: with `tvg` unless absent.
LevelImage level_image(const Ping& ping, const std::optional<Tvg>& tvg);

/// Title of a picture.
std::string picture_title(const std::string& sonar, const Ping& ping);

/// Largest resident set so far [MiB].
double peak_memory_mib();

/// A string as a TOML literal with quotes and escapes.
std::string toml_text(const std::string& text);

}  // namespace insonify::tool

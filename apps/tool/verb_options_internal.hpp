#pragma once
#include <CLI/CLI.hpp>

#include "tool/options.hpp"

/// How the verbs and their options are spelled, and what --help says of them.
namespace insonify::tool {

/// All options of all verbs; lives as long as the command that runs.
struct AllOptions {
  CommonOptions common;
  InfoOptions info;
  PrepareOptions prepare;
  MakeSceneOptions make_scene;
  SonarsOptions sonars;
  PingOptions ping;
  SynthesizeOptions synthesize;
  ImageOptions image;
  ExportOptions exporting;
  MergeOptions merge;
  BeamPatternOptions beampattern;
  AccuracyOptions accuracy;
};

// Options that several verbs share.
void add_common(CLI::App& verb, CommonOptions& options, bool json);
void add_work(CLI::App& verb, CommonOptions& options);
void add_scene(CLI::App& verb, SceneOptions& options);
void add_sonar(CLI::App& verb, CommonOptions& common, RunOptions& options);
void add_run(CLI::App& verb, CommonOptions& common, RunOptions& options);

// The verbs.
void add_info(CLI::App& app, AllOptions& all);
void add_prepare(CLI::App& app, AllOptions& all);
void add_make_scene(CLI::App& app, AllOptions& all);
void add_sonars(CLI::App& app, AllOptions& all);
void add_plan(CLI::App& app, AllOptions& all);
void add_ping(CLI::App& app, AllOptions& all);
void add_synthesize(CLI::App& app, AllOptions& all);
void add_image(CLI::App& app, AllOptions& all);
void add_export(CLI::App& app, AllOptions& all);
void add_merge(CLI::App& app, AllOptions& all);
void add_beampattern(CLI::App& app, AllOptions& all);
void add_accuracy(CLI::App& app, AllOptions& all);

}  // namespace insonify::tool

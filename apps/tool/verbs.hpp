#pragma once
#include "tool/options.hpp"

/// The verbs of the tool. Results go to stdout, everything else to stderr; errors are thrown as insonify::Error.
namespace insonify::tool {

void info(const CommonOptions& common, const InfoOptions& options);
void prepare(const CommonOptions& common, const PrepareOptions& options);
void make_scene(const CommonOptions& common, const MakeSceneOptions& options);
void sonars(const CommonOptions& common, const SonarsOptions& options);
void plan(const CommonOptions& common, const PingOptions& options);
void ping(const CommonOptions& common, const PingOptions& options);
void synthesize(const CommonOptions& common, const SynthesizeOptions& options);
void beampattern(const CommonOptions& common, const BeamPatternOptions& options);
void accuracy(const CommonOptions& common, const AccuracyOptions& options);
void merge(const CommonOptions& common, const MergeOptions& options);
void image(const CommonOptions& common, const ImageOptions& options);
void export_run(const CommonOptions& common, const ExportOptions& options);

/// Becomes insonify-view, the program beside this one, with these arguments. Comes back only by Error(runtime).
void view(const std::vector<std::string>& arguments);

}  // namespace insonify::tool

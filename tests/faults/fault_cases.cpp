// SPDX-License-Identifier: BSD-3-Clause
#include "faults/fault_cases.hpp"

namespace insonify {
namespace {

const std::string of_four_beams = "--sonar p900-45 --set sonar.beams=4 --pose=0,0,0,0,0,0 ";
const std::string ping = "ping poles.ply --no-picture " + of_four_beams;
const std::string side_ping =
    "ping poles.ply --no-picture --sonar starfish-450 --set sonar.range_resolution_m=0.05 --pose=0,0,0,0,0,0 ";
const std::string mission = "make-mission lawnmower --scene poles.ply --sonar p900-45 --range 3:5 --centre 0,0,0 ";
const std::string accuracy = "accuracy --scene poles.ply " + of_four_beams + "--methods gridded --repeats 1 ";
const std::string synthesize = "synthesize echoes.csv --sonar p900-45 --set sonar.beams=4 ";

/// Returns a case whose new output is made from `run`, the old one from `short`, or from a variant of each that is
/// named here.
FaultCase of_runs(const std::string& verb, const std::string& output, const std::string& how = "",
                  const std::string& variant = "") {
  const std::string rest = variant + " " + how + " -o " + output;
  return {verb, output, verb + " short" + rest, verb + " run" + rest + " --force"};
}

FaultCase replaced(const std::string& verb, const std::string& output, const std::string& before,
                   const std::string& after, FaultCase::Kind kind = FaultCase::Kind::whole) {
  return {verb, output, before + " -o " + output, after + " -o " + output + " --force", kind};
}

}  // namespace

std::vector<FaultCase> fault_cases() {
  std::vector<FaultCase> cases;
  const std::string scene = "make-scene poles --points ";
  for (const char* output : {"a.ply", "a.pcd", "a.tiles"})
    cases.push_back(replaced("make-scene", output, scene + "50", scene + "60"));
  for (const char* output : {"p.ply", "p.pcd", "p.tiles"})
    cases.push_back(replaced("prepare", output, "prepare small.ply", "prepare poles.ply"));
  cases.push_back(replaced("make-object", "o.ply", "make-object tyre", "make-object tyre --set diameter_m=0.7"));
  cases.push_back(
      replaced("make-mission", "m.toml", mission + "--size 2,1 --spacing 4", mission + "--size 3,1 --spacing 4"));
  cases.push_back(replaced("materials", "m.png", "materials sand", "materials medium-sand"));
  cases.push_back(replaced("beampattern", "b.png", "beampattern p900-45", "beampattern p900-45 --steer 10"));
  cases.push_back(replaced("ping", "out", ping + "--range 3:4",
                           ping + "--range 3:5 --layers --keep contributors,insonification,paths,elements"));
  cases.push_back(replaced("ping", "drawn", ping + "--range 3:4", "ping poles.ply " + of_four_beams + "--range 3:5"));
  cases.push_back(replaced("synthesize", "syn", synthesize + "--range 3:4 --no-picture", synthesize + "--range 3:5"));
  cases.push_back(
      {"survey", "survey", "", "survey mission.toml --pings-per-block 2 -j 1 -o survey", FaultCase::Kind::resumes});
  cases.push_back(replaced("merge", "both", "merge run", "merge run run"));
  cases.push_back(replaced("merge", "kept-both", "merge kept", "merge kept kept"));
  for (const char* view : {"fan", "grey"})
    cases.push_back(of_runs("image", std::string(view) + ".png", std::string("--view ") + view));
  cases.push_back(of_runs("image", "grey.pgm", "--view grey"));
  cases.push_back(of_runs("image", "frames", "--animate"));
  cases.push_back(replaced("image", "water.png", "image two --view waterfall", "image two --view waterfall --dark"));
  cases.push_back(replaced("image", "scene.png", "image small.ply --view scene", "image poles.ply --view scene"));
  cases.push_back(replaced("image", "labels.png", "image kept --view labels --min-level 40", "image kept --view labels",
                           FaultCase::Kind::pair));
  cases.push_back(of_runs("export", "vtk"));
  cases.push_back(of_runs("export", "pictures", "--to png"));
  cases.push_back(of_runs("export", "b.csv", "--to csv"));
  cases.push_back(of_runs("export", "b.las", "--to las --utm 32N"));
  cases.push_back(of_runs("export", "b.tif", "--to geotiff --cell 0.1 --utm 32N"));
  cases.push_back(of_runs("export", "b.gsf", "--to gsf --anchor 54,8,90"));
  cases.push_back(of_runs("export", "b.mcap", "--to mcap"));
  cases.push_back(of_runs("export", "b.xtf", "--to xtf --anchor 54,8", "-side"));
  cases.push_back(replaced("compare", "page", "compare run short", "compare run run"));
  cases.push_back(replaced("dataset", "data", "dataset kept --polygons", "dataset kept kept --polygons"));
  cases.push_back(replaced("accuracy", "acc", accuracy + "--range 3:4 --tolerances 1e-3 --no-picture",
                           accuracy + "--range 3:4 --tolerances 1e-3,1e-4", FaultCase::Kind::timed));
  return cases;
}

std::vector<std::string> commands_for_inputs() {
  return {"make-scene poles --points 50 -o small.ply",
          "make-scene poles --points 4000 -o poles.ply",
          ping + "--range 3:5 -o run",
          ping + "--range 3:4 -o short",
          ping + "--range 3:4 --keep contributors -o kept",
          side_ping + "--range 3:5 -o run-side",
          side_ping + "--range 3:4 -o short-side",
          "merge run run -o two",
          mission + "--size 2,1 --spacing 4 --rate 2 -o mission.toml"};
}

}  // namespace insonify

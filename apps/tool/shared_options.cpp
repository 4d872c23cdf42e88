#include <cstdlib>

#include "tool/verb_options_internal.hpp"

namespace insonify::tool {

void add_common(CLI::App& verb, CommonOptions& o, bool json) {
  verb.add_flag("-q,--quiet", o.quiet, "errors only");
  verb.add_flag("-v,--verbose", o.verbose, "say each step");
  if (json) verb.add_flag("--json", o.json, "result as JSON on stdout");
}

void add_work(CLI::App& verb, CommonOptions& o) {
  verb.add_option("-j,--threads", o.threads, "threads, at most 1024; 0: all cores (results do not depend on it)")
      ->check([](const std::string& text) {
        const int threads = std::atoi(text.c_str());
        return threads >= 0 && threads <= 1024 ? "" : text + " must be within 0 and 1024";
      });
  verb.add_option("--seed", o.seed, "of all random numbers; same seed, same bytes");
}

void add_scene(CLI::App& verb, SceneOptions& o) {
  verb.add_option("SCENE", o.path, "cloud or mesh: .pcd .ply .obj .stl .vtk .vtp .xyz .txt .csv; or .tiles")
      ->required();
  verb.add_option("--viewpoint", o.viewpoint, "x,y,z [m] where the capture stood; orients estimated normals");
  verb.add_option("--materials", o.materials_file, "TOML table of materials for the labels of the cloud");
  verb.add_option("--material-field", o.material_field, "field of the cloud that means materials, e.g. classification");
  verb.add_option("--material", o.material, "one material for everything, by name, e.g. sand");
  verb.add_option("--unit", o.unit, "of the file: m, mm, cm, km, ft, or metres per unit");
  verb.add_option("--mesh-spacing", o.mesh_spacing, "[m] between surfels of a mesh; 0: about 200 000 surfels");
}

void add_sonar(CLI::App& verb, CommonOptions& common, RunOptions& o) {
  verb.add_option("--sonar", o.sonar, "preset (see `insonify sonars`), a .toml file, or the run.toml of a run")
      ->required();
  verb.add_option("--range", o.range, "min:max [m]; default: the sonar's");
  verb.add_option("--tolerance", o.tolerance, "relative error of the synthesis");
  verb.add_option("--method", o.method,
                  "gridded, direct: the slow referee, element-exact: true delays per element, or incoherent: the "
                  "expected level, no speckle")
      ->check(CLI::IsMember({"gridded", "direct", "element-exact", "incoherent"}))
      ->option_text("WORD");
  verb.add_option("--environment", o.environment,
                  "TOML file: [water] [surface] [bottom] [volume] [wind] [noise] [profile], or the run.toml of a run");
  verb.add_option("--profile", o.profile,
                  "CSV depth_m,sound_speed (or depth_m,temperature_c,salinity_psu): bends rays");
  verb.add_option("--set", common.settings, "SECTION.KEY=VALUE of sonar or environment, e.g. water.temperature_c=4")
      ->allow_extra_args(false);
}

void add_run(CLI::App& verb, CommonOptions& common, RunOptions& o) {
  add_sonar(verb, common, o);
  verb.add_option("-o,--output", o.output, "run directory to make")->required();
  verb.add_flag("--force", o.force, "replace an existing run directory");
  verb.add_flag("--no-picture", o.no_picture, "do not draw fan.png");
}

}  // namespace insonify::tool

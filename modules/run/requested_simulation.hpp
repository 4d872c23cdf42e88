// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/text.hpp"
#include "run/options.hpp"

/// Options of the command line, or settings of a file, as options of the library.
namespace insonify {

/// Outputs that Run::keep names by one word, beside "contributors" and "paths".
inline constexpr Named<bool OutputSettings::*> kept_outputs[] = {{"elements", &OutputSettings::elements},
                                                                 {"mask", &OutputSettings::mask},
                                                                 {"labels", &OutputSettings::labels},
                                                                 {"insonification", &OutputSettings::scatterers}};

/// Returns the options that a simulator is asked for; the plan of a ping decides the rest.
SimulationOptions requested_simulation(const Run& run);

/// Records in `run` what was decided of SamplingSettings::detail, if it is not what was asked: with or without the
/// stage, as run.toml has it.
void record_detail(Choice requested, Choice decided, Run& run);

/// Returns true if --keep names `what`.
bool keeps(const Run& run, const std::string& what);

/// The name of a setting in messages: --detail-width, or detail_width.
enum class NamedBy { option, keyword };

/// Throws Error(argument) for a problem of `simulation`, which was made of `run`. The message names the option of the
/// command line, "--detail-width = -1, must be within 0 and 4", or the keyword of Python, "detail_width = -1, ...".
void require_valid_settings(const Run& run, const SimulationOptions& simulation, NamedBy by = NamedBy::option);

/// Throws Error(content) for a problem of the settings that the run.toml or mission at `path` holds in [ping]. The
/// message names line and key: "run.toml:7: ping.detail_width = -1, must be within 0 and 4".
void require_valid_file(const std::string& path, const Run& run);

}  // namespace insonify

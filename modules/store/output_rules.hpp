// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Files and folders that a call reads. Names that do not exist, of presets for instance, are passed over.
using InputPaths = std::vector<std::string>;

/// Throws Error(file) unless the file `output` may be written: it must not exist, or with `force` be a file that is no
/// input, by whatever name, and no file of a run or survey among the inputs.
void require_free_file(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) unless the folder `output` may be made: it must not exist, or with `force` be empty or hold
/// nothing but what its manifest.json lists, unchanged, and neither be nor hold an input, by whatever name.
void require_free_folder(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) naming what stands in `folder` that no run wrote. `called`: its name in the message.
void require_run_alone(const std::string& folder, const std::string& called);

}  // namespace insonify

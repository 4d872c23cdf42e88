// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Files and folders that a call reads. Names that do not exist are ignored; they may be names of presets.
using InputPaths = std::vector<std::string>;

/// Throws Error(file) unless the file `output` may be written. It may if it does not exist. With `force` it may also be
/// an existing file, except an input under any name, or a file of a run or survey among the inputs.
void require_free_file(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) unless the folder `output` may be made. It may if it does not exist. With `force` it may also be
/// an existing folder that is empty, or that holds only files that its manifest.json lists, unchanged. The folder must
/// neither be nor contain an input, under any name.
void require_free_folder(const std::string& output, bool force, const InputPaths& inputs);

/// Throws Error(file) if `folder` holds anything that no run wrote, naming that. `called` is the name of the folder in
/// the message.
void require_run_alone(const std::string& folder, const std::string& called);

}  // namespace insonify

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// A command that replaces `output`, and the one that wrote what it replaces.
struct FaultCase {
  std::string verb, output, before, command;
  enum class Kind {
    whole,    ///< the old output or the new one, and the same bytes in every run
    resumes,  ///< keeps what is done, and completes it when it is run again
    pair,     ///< two files, between whose names a kill may fall
    timed     ///< holds times of the run: the bytes differ
  } kind = Kind::whole;
};

/// The cases, at least one for each verb that has --output.
std::vector<FaultCase> fault_cases();

/// The commands that make what the cases start from.
std::vector<std::string> commands_for_inputs();

}  // namespace insonify

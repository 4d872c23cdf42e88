// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// A command that replaces `output`, and the command that wrote the old output.
struct FaultCase {
  std::string verb, output, before, command;
  enum class Kind {
    whole,    ///< leaves the old output or the new one, with the same bytes in every run
    resumes,  ///< keeps finished work, and completes it when it is run again
    pair,     ///< writes two files, between whose renames a kill may fall
    timed     ///< holds times of the run: the bytes differ
  } kind = Kind::whole;
};

/// Returns the cases, at least one for each verb that has --output.
std::vector<FaultCase> fault_cases();

/// Returns the commands that make the inputs of the cases.
std::vector<std::string> commands_for_inputs();

}  // namespace insonify

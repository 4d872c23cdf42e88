// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "returns/ping.hpp"
#include "run/ping_setup.hpp"
#include "run/run_observer.hpp"
#include "store/cube.hpp"

namespace insonify {

/// A note of pings for a machine: kind, text, pings, first_ping; of a survey the name of its head, too.
nlohmann::ordered_json note_json(const PingNote& note, const std::string& head = "");

/// Draws a picture that a run may lack: where there is no OpenGL, or no memory for it, the data are written all the
/// same, and a note that begins with `lacks` says why. An error of any other kind, such as a full disk, ends the run.
void draw_if_possible(const std::string& lacks, const std::function<void()>& draw, nlohmann::ordered_json& manifest,
                      RunObserver& observer);

/// The text of a run.toml, with `settings` as from settings_as_toml.
std::string run_toml(const PingSetup& setup, const std::string& settings);

/// A cube of simulated pings of one head, at least one; its water is that of the first.
Cube cube_of(std::vector<Ping> pings, const PingSetup& setup);

/// Title of the picture of a ping: sonar, number, range.
std::string picture_title(const std::string& sonar, const Ping& ping);

}  // namespace insonify

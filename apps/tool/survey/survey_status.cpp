// SPDX-License-Identifier: BSD-3-Clause
#include "tool/survey/survey_status.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "files/pending_file.hpp"

namespace insonify::tool {
SurveyStatus::SurveyStatus(Progress& progress, std::string path, std::string shard, std::size_t pings, std::size_t done)
    : progress_(progress), path_(std::move(path)), shard_(std::move(shard)), pings_(pings), done_before_(done) {}

void SurveyStatus::ping_done(const PingOutcome* made) {
  const std::scoped_lock lock(guard_);
  ++(made ? made_ : done_before_);
  failed_ += made && !made->failure.empty();
  const std::size_t done = done_before_ + made_;
  seconds_ += watch_.lap();
  const double left =
      seconds_ * static_cast<double>(pings_ - done) / static_cast<double>(std::max<std::size_t>(1, made_));
  progress_.show(static_cast<double>(done) / static_cast<double>(pings_),
                 fmt::format("ping {} of {}, {} left", done, pings_, time_text(left)));
  if (seconds_ - written_ >= 1) write_locked("running");
}

void SurveyStatus::write(const std::string& state) {
  const std::scoped_lock lock(guard_);
  write_locked(state);
}

void SurveyStatus::write_locked(const std::string& state) {
  seconds_ += watch_.lap();
  written_ = seconds_;
  const std::size_t left = pings_ - done_before_ - made_;
  nlohmann::ordered_json status = {{"schema", 1},           {"state", state},      {"shard", shard_},
                                   {"process", ::getpid()}, {"pings", pings_},     {"done", done_before_ + made_},
                                   {"failed", failed_},     {"seconds", written_}, {"seconds_left", nullptr}};
  if (made_ > 0) status["seconds_left"] = written_ * static_cast<double>(left) / static_cast<double>(made_);
  write_file(path_, status.dump(2) + "\n");
}

}  // namespace insonify::tool

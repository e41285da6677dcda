#include "cli/output/study_words.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/as_number.h"
#include "base/fault.h"

namespace reachlab::cli {
namespace {

std::optional<int> fromEnvironment(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? std::nullopt : asNumber<int>(text);
}

// Tasks are numbered as the user likes; the share is the task's place among them.
study::Shard shardOfSlurm() {
  const auto id = fromEnvironment("SLURM_ARRAY_TASK_ID"), count = fromEnvironment("SLURM_ARRAY_TASK_COUNT");
  if (!id || !count) return {};
  const int least = fromEnvironment("SLURM_ARRAY_TASK_MIN").value_or(1), step = fromEnvironment("SLURM_ARRAY_TASK_STEP").value_or(1);
  const study::Shard shard{step > 0 ? (*id - least) / step + 1 : 0, *count};
  if (*count < 1 || shard.index < 1 || shard.index > shard.of || (*id - least) % step != 0)
    throw FaultError(Fault{"SLURM_ARRAY_TASK_ID",
                           fmt::format("is {} of {} tasks from {} by {}, which is no share", *id, *count, least, step),
                           "an array without gaps, or --shard I/N"});
  return shard;
}

}  // namespace

study::Shard shardOf(const std::string& text) {
  if (text.empty()) return shardOfSlurm();
  const std::size_t slash = text.find('/');
  const auto index = slash == std::string::npos ? std::nullopt : asNumber<int>(std::string_view(text).substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : asNumber<int>(std::string_view(text).substr(slash + 1));
  if (!index || !of || *of < 1 || *index < 1 || *index > *of) throw FaultError(Fault{"--shard", "is " + text, "I/N with 1 <= I <= N"});
  return {*index, *of};
}

std::string describeSeconds(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

std::string describeProgress(const study::StudyProgress& progress) {
  return fmt::format("{} of {} trials, {:.0f} a second, {} left", progress.trialsDone, progress.trials, progress.rate(),
                     describeSeconds(progress.secondsLeft()));
}

}  // namespace reachlab::cli

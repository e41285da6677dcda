#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "sim/session/recorded_session.h"
#include "tests/haptics/scripted_device.h"
#include "tests/record/made_run.h"

namespace reachlab::session::test {

inline constexpr const char* kEasy =
    R"({ "schema_version": 1, "name": "easy", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "point", "masses_kg": [0.5], "stiffness_n_per_m": [] },
  "coupling": { "stiffness_n_per_m": 900, "damping_n_s_per_m": 40 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 0.4, "timeout_s": 0.1, "rest_s": 0,
            "tolerance": { "position_m": 0.05, "velocity_m_per_s": 5, "time_s": 0.3 } } })";

inline const std::atomic<bool> kNeverStop{false};

/// A hand that moves by tick count.
inline std::unique_ptr<haptics::test::ScriptedDevice> handTo(double to) {
  auto hand = std::make_unique<haptics::test::ScriptedDevice>(-0.1, to, 300);
  hand->about.version = "7";
  hand->about.maxForce = 9;
  return hand;
}
inline std::unique_ptr<haptics::HapticDevice> goodHand() { return handTo(0.1); }
/// Every trial of it is aborted: no onset.
inline std::unique_ptr<haptics::HapticDevice> stillHand() { return handTo(-0.1); }

/// The logs of a session, by run number.
inline std::vector<record::RunLog> logsIn(const SessionPlace& place) {
  std::vector<record::RunLog> logs;
  for (const RunOnDisk& run : recordedRuns(place)) logs.push_back(record::RunLog::open(run.path));
  return logs;
}

/// What a log's events of this kind say, in their order.
inline std::vector<std::string> eventsOf(const record::RunLog& log, record::EventKind kind) {
  std::vector<std::string> texts;
  for (const record::RecordedEvent& event : log.events())
    if (event.kind == kind) texts.push_back(event.text);
  return texts;
}

/// A dataset of its own, and three trials of an easy reach on the virtual clock.
class Recorded : public testing::Test {
 protected:
  Recorded() {
    request_.place.data = folder_ / "data";
    request_.device = "scripted";
    request_.trials = 3;
    request_.seed = 1;
    request_.fast = true;
  }
  BlockToRun block() const { return planSession(request_, easy_).blocks.at(0); }
  RecordedRunOptions options() const {
    RecordedRunOptions options;
    options.place = request_.place;
    options.numberAskedFor = request_.run.has_value();
    options.virtualClock = request_.fast;
    return options;
  }
  std::vector<record::RunLog> logs() const { return logsIn(request_.place); }

  TemporaryFolder folder_;
  SessionRequest request_;
  Programme easy_ = programmeOf(experiment::openExperimentText(kEasy, "easy.json"));
};

}  // namespace reachlab::session::test

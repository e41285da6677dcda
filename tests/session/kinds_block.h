#pragma once
#include <string>
#include <vector>

#include "tests/session/recorded_runs.h"

namespace reachlab::session::test {

/// A plan of one block with three kinds of trials, recorded with a scripted hand.
class Kinds : public Recorded {
 protected:
  Kinds() {
    request_.trials.reset();
    folder_.write("easy.json", kEasy);
    folder_.write("plan.json", R"({ "schema_version": 1, "blocks": [ { "experiment": "easy.json", "trials": 12,
      "kinds": { "thin": {}, "thick": { "object.viscosity_n_s_per_m": 8 }, "soft": { "coupling.stiffness_n_per_m": 300 } },
      "mix": [{ "kind": "thin", "count": 3 }, { "kind": "thick", "count": 2 }, { "kind": "soft" }],
      "order": "shuffled-cycles", "not_first": ["soft"], "not_twice": ["soft", "thick"] } ] })");
    programme_ = readProgramme(folder_ / "plan.json");
  }
  /// Does so many trials, or all. True when nothing is left.
  bool record(int trials = 1000) {
    RecordedSession session(programme_, request_, [](const auto&, auto, auto) { return goodHand(); });
    std::atomic<bool> stop{false};
    SessionWords words;
    words.opened = words.logClosed = [](const RecordedRun&) {};
    words.closed = [] {};
    words.ended = [&](const RecordedRun&, const haptics::ConductedTrial&) { stop = --trials == 0; };
    return conduct(session, stop, words);
  }
  static std::vector<std::string> kindsOf(const record::RunLog& log) {
    std::vector<std::string> kinds;
    for (const record::RecordedTrial& trial : log.trials()) kinds.push_back(record::sceneOf(log.configuration(), trial.planned)->kind);
    return kinds;
  }
  Programme programme_;
};

}  // namespace reachlab::session::test

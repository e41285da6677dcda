#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "network/station/station_run.h"
#include "sim/dynamics/shared_plant.h"

namespace reachlab::network {

/// What an observer has seen since the last look.
struct ObserverNews {
  std::vector<LinkEvent> ended;  // how a station's trial ended
  bool finished = false;         // the conductor said that no more trials follow
  std::string problem;           // in vain: no station was heard, the endpoint has ended; once
};

/// A station without a hand: no copy, nothing sent and nothing recorded; the others do not wait for it, nor know of it. Never waits; `poll` it
/// often. Every call from one thread at a time.
class Observer {
 public:
  /// Starts the endpoint. Throws FaultError, RefusedError: an experiment that stations cannot share; ResourceError.
  Observer(const StationSetup& setup, const experiment::CompiledExperiment& experiment);

  ObserverNews poll();
  /// The newest that came of every station, from 0; a sample with sequence number 0: nothing yet.
  const std::array<HeardState, kMaxStations>& newest() const { return newest_; }
  /// How far a station's copy is from that of the first that was heard, each as it came last [m].
  double apart(int station) const;
  /// For a picture: the conductor's copy (the first station's that is heard, until one says that it conducts), with hand 1 for its own; null while
  /// nothing has come. The other hands stand in `hands`.
  const haptics::TickState* state() const { return shown_ < 0 ? nullptr : state_.get(); }
  const OtherHands& hands() const { return hands_; }
  StationLink& link() { return *link_; }

 private:
  bool isHeard(int station) const { return newest_[static_cast<std::size_t>(station)].sample.sequence != 0; }
  void take(ObserverNews& news);
  void show();

  StationSetup setup_;
  std::unique_ptr<dynamics::SharedPlant> plant_;
  std::unique_ptr<StationLink> link_;
  std::array<HeardState, kMaxStations> newest_{};
  std::unique_ptr<haptics::TickState> state_;
  OtherHands hands_;
  int shown_ = -1;     // the station, from 0, whose copy is shown
  int first_ = -1;     // the first that was heard, from 0
  double begun_;       // [s]
  bool told_ = false;  // what went wrong
};

/// Of every station that was heard a line `key=value …` of the newest that came, and how far its copy was then from the first's.
/// `now`: of the samples' clock [s].
std::string describeNewest(const Observer& observer, double now);

}  // namespace reachlab::network

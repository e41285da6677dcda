#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "network/station/station_run.h"
#include "sim/dynamics/shared_plant.h"

namespace reachlab::network {

/// The observations since the last call.
struct ObserverNews {
  std::vector<LinkEvent> ended;  // how a station's trial ended
  bool finished = false;         // the conductor said that no more trials follow
  std::string problem;           // the reason why observing is in vain (no station was heard, the endpoint has ended); reported once
};

/// A station without a hand. It has no copy, and it sends and records nothing. The other stations do not wait for it and do not know of it.
/// It never waits. Call `poll` often. Every call comes from one thread at a time.
class Observer {
 public:
  /// Starts the endpoint. Throws FaultError. Throws RefusedError for an experiment that stations cannot share. Throws ResourceError.
  Observer(const StationSetup& setup, const experiment::CompiledExperiment& experiment);

  ObserverNews poll();
  /// The newest sample of every station, from 0. A sample with sequence number 0 means that no sample has come yet.
  const std::array<HeardState, kMaxStations>& newest() const { return newest_; }
  /// The distance [m] between a station's copy and the copy of the first station that was heard, by their latest samples.
  double apart(int station) const;
  /// For a picture: the conductor's copy, with hand 1 as its hand. Until a station says that it conducts, it is the copy of the first
  /// station that was heard. Null while no sample has come. The other hands are in `hands`.
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
  int first_ = -1;     // the first station that was heard, from 0
  double begun_;       // [s]
  bool told_ = false;  // a problem was reported
};

/// One line `key=value …` for every station that was heard: its newest sample, and the distance of its copy from the first station's. `now`
/// [s] is on the samples' clock.
std::string describeNewest(const Observer& observer, double now);

}  // namespace reachlab::network

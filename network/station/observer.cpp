#include "network/station/observer.h"

#include <fmt/format.h>

#include "base/system/os.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

double secondsNow() { return static_cast<double>(os::now()) * 1e-9; }

StationSetup observing(StationSetup setup, const experiment::Experiment& experiment) {
  setup.link.station = 0;
  setup.link.stations = static_cast<int>(experiment.hands.size());
  return setup;
}

}  // namespace

Observer::Observer(const StationSetup& setup, const experiment::CompiledExperiment& experiment)
    : setup_(observing(setup, experiment.experiment())),
      plant_(dynamics::makeSharedPlant(experiment.experiment(), experiment.constraint())),
      link_(std::make_unique<StationLink>(setup_.link, sharedHash(experiment.experiment()))),
      state_(std::make_unique<haptics::TickState>()), begun_(secondsNow()) {}

ObserverNews Observer::poll() {
  ObserverNews news;
  link_->look();
  take(news);
  if (shown_ >= 0) show();
  if (told_) return news;
  news.problem = link_->endpointFault();
  if (news.problem.empty() && first_ < 0 && secondsNow() - begun_ > setup_.wait)
    news.problem = fmt::format("no station was heard within {:.0f} s", setup_.wait);
  told_ = !news.problem.empty();
  return news;
}

void Observer::take(ObserverNews& news) {
  LinkMemory& memory = link_->memory();
  for (int i = 0; i < setup_.link.stations; ++i) {
    const auto index = static_cast<std::size_t>(i);
    while (memory.in[index].tryPop(newest_[index])) {}
    if (!isHeard(i)) continue;
    if (first_ < 0) first_ = i;
    if (shown_ < 0 || link_->isConductor(static_cast<std::uint32_t>(i + 1)).value_or(false)) shown_ = i;
    hands_.place[index] = newest_[index].sample.hand;
    hands_.known[index] = i > 0;
  }
  LinkEvent event;
  while (memory.eventsIn.tryPop(event)) {
    if (event.kind == LinkEvent::Kind::Finish) news.finished = true;
    if (event.kind == LinkEvent::Kind::Ended) news.ended.push_back(event);
  }
}

void Observer::show() {
  const HeardState& heard = newest_[static_cast<std::size_t>(shown_)];
  plant_->show({heard.sample.places.data(), static_cast<std::size_t>(plant_->placeCount())},
               {heard.sample.rates.data(), static_cast<std::size_t>(plant_->rateCount())});
  haptics::TickState& state = *state_;
  ++state.tick;
  haptics::HandState& first = state.hands[0];
  first.hip = {isHeard(0) ? newest_[0].sample.hand : plant_->fixedPoint(0), {}, true};
  first.device.valid = true;
  state.trial = heard.trial;
  state.phase = static_cast<trial::Phase>(heard.phase);
  state.massCount = plant_->massCount();
  plant_->observe(first.hip, std::span(state.masses).first(static_cast<std::size_t>(state.massCount)));
  state.body = plant_->body();
}

double Observer::apart(int station) const {
  if (first_ < 0 || !isHeard(station)) return 0;
  const auto count = static_cast<std::size_t>(plant_->placeCount());
  return plant_->distanceBetween({newest_[static_cast<std::size_t>(first_)].sample.places.data(), count},
                                 {newest_[static_cast<std::size_t>(station)].sample.places.data(), count});
}

std::string describeNewest(const Observer& observer, double now) {
  constexpr std::array kPhases{"idle", "waiting", "armed", "moving", "done"};
  std::string text;
  int station = -1;
  for (const HeardState& state : observer.newest()) {
    ++station;
    const CopySample& sample = state.sample;
    if (sample.sequence == 0) continue;
    const bool first = text.empty();
    text += fmt::format("station={} trial={} phase={} age_s={:.3f} hand_m={:.5f},{:.5f},{:.5f} work_j={:.5f}", station + 1, state.trial,
                        state.phase < kPhases.size() ? kPhases[state.phase] : "unknown", now - sample.time, sample.hand.x, sample.hand.y,
                        sample.hand.z, sample.work);
    if (!first) text += fmt::format(" apart_m={:.6f}", observer.apart(station));
    text += '\n';
  }
  return text;
}

}  // namespace reachlab::network

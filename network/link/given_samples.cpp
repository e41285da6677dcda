#include "network/link/given_samples.h"

#include <algorithm>

#include "base/fault.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {

void GivenSample::giveTo(CoupledCopy& copy) const noexcept {
  if (peer == kFrequency) return copy.setFrequency(roundTrip);
  if (peer == kBrokenOff) return copy.breakOff(static_cast<int>(roundTrip));
  if (peer >= 0 && peer < copy.peerCount()) copy.take(peer, sample, roundTrip);
}

namespace {

// The bytes of a sample in their order, read or written: `each` is called with every number.
template <class Each>
void visit(GivenSample& given, std::uint32_t places, std::uint32_t rates, Each&& each) {
  CopySample& s = given.sample;
  each(given.tick), each(given.peer), each(given.roundTrip), each(s.sequence), each(s.time);
  for (Vec3* v : {&s.hand, &s.handVelocity}) each(v->x), each(v->y), each(v->z);
  each(s.work);
  for (std::uint32_t i = 0; i < places; ++i) each(s.places[i]);
  for (std::uint32_t i = 0; i < rates; ++i) each(s.rates[i]);
}

}  // namespace

std::vector<std::uint8_t> encodeGiven(GivenRecord record) {
  record::ByteWriter out;
  for (const auto number :
       {static_cast<std::uint32_t>(record.samples.size()), static_cast<std::uint32_t>(record.own), record.places, record.rates})
    out.put(number);
  for (GivenSample& given : record.samples) visit(given, record.places, record.rates, [&](auto number) { out.put(number); });
  return {out.bytes().begin(), out.bytes().end()};
}

GivenRecord decodeGiven(std::span<const std::uint8_t> payload) {
  record::ByteReader in(payload);
  GivenRecord record;
  record.samples.resize(std::min<std::size_t>(in.get<std::uint32_t>(), payload.size()));
  record.own = static_cast<int>(std::min<std::uint32_t>(in.get<std::uint32_t>(), kMaxStations));
  record.places = in.get<std::uint32_t>(), record.rates = in.get<std::uint32_t>();
  if (record.places > kMaxCoordinates || record.rates > kMaxCoordinates) throw FaultError(Fault{.what = "peer record of an unknown form"});
  for (GivenSample& given : record.samples)
    visit(given, record.places, record.rates, [&]<class Number>(Number& number) { number = in.get<Number>(); });
  if (!in.ok() || in.left() != 0) throw FaultError(Fault{.what = "peer record of an unknown form"});
  return record;
}

bool isOfStation(const record::RunLog& log) {
  return recordedValues(log.configuration()).hands.size() > static_cast<std::size_t>(log.configuration().table.hands);
}

GivenRecord readGiven(const record::RunLog& log) {
  GivenRecord all;
  record::LogReader reader(log.path());
  record::RecordView view;
  while (reader.goodEnd() < log.goodBytes() && reader.next(view)) {
    if (view.type != record::RecordType::PeerTicks) continue;
    const GivenRecord one = decodeGiven(view.payload);
    all.own = one.own, all.places = one.places, all.rates = one.rates;
    all.samples.insert(all.samples.end(), one.samples.begin(), one.samples.end());
  }
  return all;
}

std::vector<GivenSample> givenSamples(const record::RunLog& log) {
  std::vector<GivenSample> given = readGiven(log).samples;
  std::erase_if(given, [](const GivenSample& one) { return one.peer < 0; });
  return given;
}

}  // namespace reachlab::network

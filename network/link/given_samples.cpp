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

void beginGiven(record::ByteWriter& out, int own, std::uint32_t places, std::uint32_t rates) {
  out.put(std::uint32_t{0}), out.put(static_cast<std::uint32_t>(own)), out.put(places), out.put(rates);
}

void addGiven(record::ByteWriter& out, const GivenSample& given, std::uint32_t places, std::uint32_t rates) {
  const CopySample& s = given.sample;
  out.put(given.tick), out.put(given.peer), out.put(given.roundTrip), out.put(s.sequence), out.put(s.time);
  for (const Vec3& v : {s.hand, s.handVelocity}) out.put(v.x), out.put(v.y), out.put(v.z);
  out.put(s.work);
  for (std::uint32_t i = 0; i < places; ++i) out.put(s.places[i]);
  for (std::uint32_t i = 0; i < rates; ++i) out.put(s.rates[i]);
}

void endGiven(record::ByteWriter& out, std::uint32_t count) { out.overwrite(0, count); }

GivenRecord decodeGiven(std::span<const std::uint8_t> payload) {
  record::ByteReader in(payload);
  GivenRecord record;
  record.samples.resize(std::min<std::size_t>(in.get<std::uint32_t>(), payload.size()));
  record.own = static_cast<int>(std::min<std::uint32_t>(in.get<std::uint32_t>(), kMaxStations));
  record.places = in.get<std::uint32_t>(), record.rates = in.get<std::uint32_t>();
  if (record.places > kMaxCoordinates || record.rates > kMaxCoordinates) throw FaultError(Fault{.what = "peer record of an unknown form"});
  const auto vector = [&](Vec3& v) { v.x = in.get<double>(), v.y = in.get<double>(), v.z = in.get<double>(); };
  for (GivenSample& given : record.samples) {
    given.tick = in.get<std::uint64_t>();
    given.peer = in.get<std::int32_t>();
    given.roundTrip = in.get<double>();
    CopySample& s = given.sample;
    s.sequence = in.get<std::uint32_t>();
    s.time = in.get<double>();
    vector(s.hand), vector(s.handVelocity);
    s.work = in.get<double>();
    for (std::size_t i = 0; i < record.places; ++i) s.places[i] = in.get<double>();
    for (std::size_t i = 0; i < record.rates; ++i) s.rates[i] = in.get<double>();
  }
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

int recordedStation(const record::RunLog& log) { return readGiven(log).own + 1; }

std::vector<GivenSample> givenSamples(const record::RunLog& log) {
  std::vector<GivenSample> given = readGiven(log).samples;
  std::erase_if(given, [](const GivenSample& one) { return one.peer < 0; });
  return given;
}

}  // namespace reachlab::network

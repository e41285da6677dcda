#include "tests/devices/fakes/fake_lsl.h"

#include <chrono>
#include <cstdint>
#include <string_view>

namespace reachlab::test {
namespace {

FakeLsl state;

std::size_t indexOf(void* handle) { return reinterpret_cast<std::size_t>(handle) - 1; }

}  // namespace

FakeLsl& fakeLsl() { return state; }
void resetFakeLsl() {
  const std::scoped_lock lock(state.mutex);
  state.streams.clear();
  state.alive = 0;
  state.takesNothing = false;
}

}  // namespace reachlab::test

using namespace reachlab::test;

// Handles are the stream's number from 1; an XML node is its stream's.
extern "C" {

void* lsl_create_streaminfo(const char* name, const char* type, std::int32_t channels, double rate, int format, const char* source) {
  const std::scoped_lock lock(fakeLsl().mutex);
  FakeLsl::Stream stream;
  stream.name = name, stream.type = type, stream.source = source, stream.channels = channels, stream.rate = rate, stream.format = format;
  fakeLsl().streams.push_back(stream);
  ++fakeLsl().alive;
  return reinterpret_cast<void*>(fakeLsl().streams.size());
}
void lsl_destroy_streaminfo(void*) {
  const std::scoped_lock lock(fakeLsl().mutex);
  --fakeLsl().alive;
}
void* lsl_get_desc(void* info) { return info; }
void* lsl_append_child(void* node, const char*) { return node; }
void* lsl_append_child_value(void* node, const char* name, const char* value) {
  const std::scoped_lock lock(fakeLsl().mutex);
  FakeLsl::Stream& stream = fakeLsl().streams[indexOf(node)];
  if (std::string_view(name) == "clock") stream.clock = value;
  if (std::string_view(name) == "label") stream.labels.emplace_back(value);
  return node;
}
void* lsl_create_outlet(void* info, std::int32_t, std::int32_t) {
  const std::scoped_lock lock(fakeLsl().mutex);
  ++fakeLsl().alive;
  return info;
}
void lsl_destroy_outlet(void*) {
  const std::scoped_lock lock(fakeLsl().mutex);
  --fakeLsl().alive;
}
std::int32_t lsl_push_sample_dtp(void* outlet, const double* data, double time, std::int32_t) {
  const std::scoped_lock lock(fakeLsl().mutex);
  if (fakeLsl().takesNothing) return -4;
  FakeLsl::Stream& stream = fakeLsl().streams[indexOf(outlet)];
  stream.numbers.emplace_back(time, std::vector<double>(data, data + stream.channels));
  return 0;
}
std::int32_t lsl_push_sample_strtp(void* outlet, const char** data, double time, std::int32_t) {
  const std::scoped_lock lock(fakeLsl().mutex);
  if (fakeLsl().takesNothing) return -4;
  fakeLsl().streams[indexOf(outlet)].texts.emplace_back(time, data[0]);
  return 0;
}
double lsl_local_clock() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count() + fakeLsl().clockAhead;
}
}

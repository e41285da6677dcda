#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "sim/haptics/haptic_loop.h"
#include "tests/haptics/scripted_device.h"

namespace {
std::atomic<std::uint64_t> allocations{0};
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace reachlab {
namespace {

// A whole trial: put up, armed, moved, judged, put up again, with every tick handed to window and recorder.
TEST(HapticLoop, TickAllocatesNothingInAnyShippedExperiment) {
  for (const std::string& name : shippedExperiments()) {
    const Experiment experiment = readExperiment(name);
    auto engine = std::make_unique<TickEngine>(experiment, EngineOptions{});
    const Vec3 start = engine->protocol().start;
    test::ScriptedDevice device(start.x, start.x + 0.05, 400);
    test::MemorySink sink(10);
    LoopOptions options;
    options.virtualClock = true;
    HapticLoop loop(std::move(engine), device, &sink, options);
    const std::uint64_t before = allocations.load();
    for (int i = 0; i < 3000; ++i) {
      if (i % 1000 == 0) loop.tryCommand(i == 0 ? Command::NextTrial : Command::Abort);
      if (i % 1000 == 1) loop.tryCommand(Command::NextTrial);
      loop.advance();
      loop.takeLatest();
    }
    EXPECT_EQ(allocations.load(), before) << name;
    EXPECT_GE(loop.engine().state().trial, 1) << name;
  }
}

}  // namespace
}  // namespace reachlab

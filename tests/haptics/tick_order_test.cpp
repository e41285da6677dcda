#include "sim/haptics/tick_order.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

/// Says when each stage comes, and what the engine has done by then.
struct ToldStages {
  const TickEngine& engine;
  std::vector<std::string>& told;
  bool mayRead = true, mayWrite = true;

  bool read(TickInput& input) {
    input.devices[0].position = engine.protocol().start;
    return tell("read"), mayRead;
  }
  void watch(TickInput&) { tell("watch"); }
  void command(TickInput& input) {
    input.command = trial::Command::NextTrial;
    tell("command");
  }
  bool write(const TickInput&) { return tell("write"), mayWrite; }
  void publish(const TickInput&) { tell("publish"); }
  void tell(const std::string& stage) {
    const TickState& state = engine.state();
    told.push_back(stage + " " + std::to_string(state.tick) + (state.hands[0].deviceState == DeviceState::Armed ? " limited" : ""));
  }
};

TEST(TickOrder, IsReadWatchCommandStepLimitWritePublish) {
  TickEngine engine(test::armedAtOnce("chain-slow"), {});
  TickInput input;
  std::vector<std::string> told;
  EXPECT_TRUE(runTick(engine, input, ToldStages{engine, told}));
  EXPECT_EQ(told, (std::vector<std::string>{"read 0", "watch 0", "command 0", "write 1 limited", "publish 1 limited"}));
}

TEST(TickOrder, AStageThatIsLeftEndsTheTick) {
  TickEngine engine(test::armedAtOnce("chain-slow"), {});
  TickInput input;
  std::vector<std::string> told;
  EXPECT_FALSE(runTick(engine, input, ToldStages{engine, told, false}));
  EXPECT_EQ(told, (std::vector<std::string>{"read 0"}));
  told.clear();
  EXPECT_FALSE(runTick(engine, input, ToldStages{engine, told, true, false}));
  EXPECT_EQ(told.back(), "write 1 limited");
}

}  // namespace
}  // namespace reachlab::haptics

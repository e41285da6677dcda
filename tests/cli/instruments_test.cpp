// A whole run with a trigger box at the other end of a pseudo-terminal, in real time.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include "sim/record/log/run_log.h"
#include "tests/cli/program.h"

using namespace reachlab;
using namespace reachlab::test;

class Instruments : public InAFolder {};

TEST_F(Instruments, AreToldOfARunAndTheRecordingSaysWhen) {
  int wire = -1, slave = -1;
  char name[128] = {};
  ASSERT_EQ(::openpty(&wire, &slave, name, nullptr, nullptr), 0);
  ::fcntl(wire, F_SETFL, O_NONBLOCK);
  const Ended ended = reach("run chain-fast --device simulated --trials 2 --seed 1 --timing-check 0 --data " + folder_.path() +
                            " --instrument byte:" + name);
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  std::string bytes(16, '\0');
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(wire, bytes.data(), bytes.size()))));
  EXPECT_TRUE(bytes.starts_with("\1\2")) << "go, onset";
  const record::RunLog log = record::RunLog::open(record::findLogs(folder_.path()).front());
  EXPECT_EQ(log.configuration().instruments, std::string("byte:") + name);
  std::vector<record::RecordedEvent> sent;
  for (const record::RecordedEvent& event : log.events())
    if (event.kind == record::EventKind::Instrument) sent.push_back(event);
  EXPECT_EQ(sent.size(), bytes.size()) << "an event a byte";
  for (const record::RecordedEvent& event : sent) {
    EXPECT_GT(event.value, 0);
    const record::RecordedTrial& trial = log.trials().at(static_cast<std::size_t>(event.trial - 1));
    for (const auto& [word, tick] :
         {std::pair{" out go", trial.goTick}, {" out onset", trial.result.onsetTick}, {" out success", trial.lastTick}})
      if (event.text.ends_with(word)) {
        EXPECT_EQ(event.tick, tick) << event.text;
      }
  }
  ::close(wire);
  ::close(slave);
}

TEST_F(Instruments, AreRefusedOnAVirtualClock) {
  EXPECT_TRUE(says(reach("run dingwell --device simulated --fast --data " + folder_.path() + " --instrument lsl",
                         "LD_LIBRARY_PATH=" + (std::filesystem::path(REACHLAB_BINARY_DIR) / "tests/fakes").string()),
                   2, "there are instruments, which are on the real clock"));
}

TEST_F(Instruments, AMissingLibraryIsSaid) {
  EXPECT_TRUE(says(reach("run dingwell --device simulated --data " + folder_.path() + " --instrument lsl"), 3, "liblsl.so"));
}

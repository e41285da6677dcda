// The standard streams: closed, full, a pipe that nobody reads any more, and names that talk to the terminal.
#include <gtest/gtest.h>
#include <pty.h>

#include "tests/cli/program.h"

using namespace reachlab::test;
namespace fs = std::filesystem;

namespace {

const std::string kRun = "\"$REACH\" run chain-moderate --device simulated:noise=0 --trials 5 --seed 1 --fast --data ";

std::size_t trialsIn(const TemporaryFolder& data) { return exportedTrials(data.path()).rows.size(); }

void expectOneSentence(const Ended& ended) { EXPECT_TRUE(says(ended, 3, "standard output: cannot be written: No space left on device")); }

// What a command writes to the terminal that it is started from.
std::string onTerminal(const std::string& command) {
  int wire = -1;
  const pid_t child = ::forkpty(&wire, nullptr, nullptr, nullptr);
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::string said;
  char bytes[4096];
  for (ssize_t n = 0; (n = ::read(wire, bytes, sizeof bytes)) > 0;) said.append(bytes, static_cast<std::size_t>(n));
  ::close(wire);
  ::waitpid(child, nullptr, 0);
  return said;
}

}  // namespace

TEST(StandardStreams, ATerminalIsToldHowFarTheReadingIsFromTheFirstRunToTheLast) {
  const TemporaryFolder data, out;
  for (int run = 0; run < 2; ++run) EXPECT_EQ(shell(kRun + data.path()).exitCode, 0);
  const std::string said =
      onTerminal("\"" REACH_PROGRAM "\" analyze " + data.path() + " --criterion min-hand-jerk --hand-mass 1 --out " + out.path());
  const std::size_t first = said.find("reading run 1 of 2"), last = said.find("reading run 2 of 2");
  EXPECT_LT(first, last) << said;
  EXPECT_NE(last, std::string::npos) << said;
}

TEST(StandardStreams, ClosedOnesNeverBecomeAFileOfTheRecording) {
  for (const std::string closed : {"0<&- 1>&-", "0<&- 1>&- 2>&-", "1>&-", "2>&-", "0<&- 2>&-"}) {
    const TemporaryFolder data;
    const Ended ended = shell(kRun + data.path() + " " + closed);
    EXPECT_EQ(ended.exitCode, 0) << closed << ": " << ended.err;
    EXPECT_EQ(trialsIn(data), 5u) << closed;
  }
}

TEST(StandardStreams, WhatCannotBePrintedIsAnErrorOfOneSentence) {
  for (const std::string command : {"list experiments", "list experiments --json", "constraint show torus", "constraint list",
                                    "predict dingwell --criterion min-hand-jerk", "predict dingwell --criterion min-hand-jerk --json",
                                    "simulate chain-moderate --hand hold", "validate dingwell", "--version"})
    expectOneSentence(shell("\"$REACH\" " + command + " > /dev/full"));
}

TEST(StandardStreams, ARunThatCannotPrintIsRecordedToItsEndAndSaysSo) {
  const TemporaryFolder data;
  expectOneSentence(shell(kRun + data.path() + " > /dev/full"));
  EXPECT_EQ(trialsIn(data), 5u);
  expectOneSentence(shell("\"$REACH\" export " + data.path() + " --format csv > /dev/full"));
}

TEST(StandardStreams, ARunWhoseMessagesCannotBePrintedIsRecordedToItsEnd) {
  const TemporaryFolder data;
  EXPECT_EQ(shell(kRun + data.path() + " 2> /dev/full").exitCode, 0);
  EXPECT_EQ(trialsIn(data), 5u);
}

TEST(StandardStreams, APipeThatNobodyReadsAnyMoreEndsQuietlyAndLosesNoRecording) {
  const TemporaryFolder data;
  const Ended run = shell("set -o pipefail\n" + kRun + data.path() + " 2> /dev/null | head -n 1");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(trialsIn(data), 5u);
  // Ten million rows, of which one is read.
  const Ended simulated =
      shell("set -o pipefail\n\"$REACH\" simulate free-point --hand hold --until 9999 --every 0.001 | head -n 1 || exit 1");
  EXPECT_LE(simulated.exitCode, 1);
  EXPECT_EQ(simulated.err, "");
}

TEST(StandardStreams, ControlCharactersOfNamesAndKeysAreSpeltOut) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bad.json",
                                        "{ \"schema_version\": 1, \"a\x7f\xc2\x9b"
                                        "31mkey\": 1, \"\\u001b[31m\\u0007red\": 2 }");
  const Ended ended = reach("validate " + file);
  EXPECT_TRUE(says(ended, 2, "\\x1b[31m\\x07red"));
  EXPECT_EQ(ended.err.find_first_of("\x1b\x07\x7f\x9b"), std::string::npos);
}

#include "base/system/error_report.h"

#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "base/fault.h"
#include "base/system/helper_program.h"
#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/stop_signals.h"
#include "tests/refusal.h"

/// What a program says last, and the number it ends with. Each ending is one of a child.
namespace reachlab {
namespace {

using testing::ExitedWithCode;

template <class E>
std::string reported(const E& error) {
  const ErrorReport report = errorReportOf(error);
  return std::to_string(report.exitCode) + " " + report.sentence;
}

TEST(ErrorReport, TellsOursAsTheyStandAndOthersInOurWords) {
  EXPECT_EQ(reported(FaultError(Fault{"a", "is 1"})), "2 a: is 1");
  EXPECT_EQ(reported(ResourceError("no device")), "3 no device");
  EXPECT_EQ(reported(RefusedError("singular")), "4 singular");
  EXPECT_EQ(reported(Error("something")), "3 something");
  const std::string noMemory = "3 there is not enough memory for this. The recorded data are safe";
  EXPECT_EQ(reported(std::bad_alloc()), noMemory);
  EXPECT_EQ(reported(std::length_error("vector")), noMemory);
  const std::error_code gone = std::make_error_code(std::errc::no_such_file_or_directory);
  EXPECT_EQ(reported(std::filesystem::filesystem_error("open", "/a/b", gone)), "3 /a/b: cannot be used: No such file or directory");
  EXPECT_EQ(reported(std::filesystem::filesystem_error("open", gone)), "3 cannot be used: No such file or directory");
  EXPECT_EQ(reported(std::system_error(gone, "thread")), "3 the operating system refuses: No such file or directory");
  try {
    std::ignore = nlohmann::json::parse("{");
  } catch (const std::exception& error) {
    EXPECT_EQ(reported(error), "2 a file that was read does not hold what Reachlab wrote there, or should find there");
  }
  const std::string own = "70 stopped by a fault of the program itself. The recorded data are safe. Please report what you did";
  EXPECT_EQ(reported(std::runtime_error("x")), own);
  EXPECT_EQ(reported(std::out_of_range("x")), own);
  EXPECT_EQ(ErrorReport{}.exitCode, 0);
}

TEST(ErrorReport, WhatNoCatchReachesEndsWithASentence) {
  const auto uncaught = [](auto thrown) { std::thread([thrown] { throw thrown; }).join(); };
  endOnUncaught();
  EXPECT_EXIT(uncaught(std::bad_alloc()), ExitedWithCode(3), "error: there is not enough memory for this. The recorded data are safe\n");
  EXPECT_EXIT(uncaught(std::runtime_error("x")), ExitedWithCode(70), "Please report what you did\n");
  EXPECT_EXIT(uncaught(7), ExitedWithCode(70), "Please report what you did\n");
  EXPECT_EXIT(std::terminate(), ExitedWithCode(70), "error: stopped by a fault of the program itself");
  const auto withoutMemory = [] {
    try {
      std::get_new_handler()();
    } catch (const std::bad_alloc&) {}
    std::terminate();  // as the standard library does where it may not throw
  };
  EXPECT_EXIT(withoutMemory(), ExitedWithCode(3), "error: there is not enough memory");
}

TEST(StopSignals, EndAtOnceWhereNothingIsToBePutInOrder) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const auto ended = [signal = signal] {
      endOnSignals();
      ::raise(signal);
      ::_exit(9);
    };
    EXPECT_EXIT(ended(), ExitedWithCode(code), "");
  }
  const auto ignored = [] {
    ::signal(SIGHUP, SIG_IGN);
    endOnSignals();
    ::raise(SIGHUP);
    ::_exit(9);
  };
  EXPECT_EXIT(ignored(), ExitedWithCode(9), "") << "as nohup has it";
  const auto restarting = [] {
    endOnSignals();
    struct sigaction action {};
    ::sigaction(SIGTERM, nullptr, &action);
    ::_exit((action.sa_flags & SA_RESTART) != 0 ? 9 : 1);
  };
  EXPECT_EXIT(restarting(), ExitedWithCode(9), "") << "no call is interrupted by a signal that is only noted";
}

TEST(StopSignals, AreOnlyNotedWhileOrderIsKept) {
  EXPECT_FALSE(StopRequest::asked());
  EXPECT_EQ(StopRequest::exitCode(), 0);
  const auto noted = [] {
    endOnSignals();
    StopRequest request;
    if (StopRequest::asked() || StopRequest::exitCode() != 0) ::_exit(1);
    ::raise(SIGTERM);
    ::raise(SIGINT);
    if (!StopRequest::asked()) ::_exit(2);
    itimerval alarm{};
    ::getitimer(ITIMER_REAL, &alarm);
    if (alarm.it_value.tv_sec != 0 || alarm.it_value.tv_usec != 0) ::_exit(4);
    ::_exit(StopRequest::exitCode());
  };
  EXPECT_EXIT(noted(), ExitedWithCode(143), "") << "the first one's";
  const auto after = [](bool inOrder) {
    endOnSignals();
    {
      StopRequest request;
      if (inOrder) request.allInOrder();
    }
    ::raise(SIGINT);
    ::_exit(9);
  };
  EXPECT_EXIT(after(false), ExitedWithCode(130), "");
  EXPECT_EXIT(after(true), ExitedWithCode(130), "");
}

/// What the alarm is set to [us] where a signal comes `before` all is in order or after it; a twentieth of a second lies between the two.
long alarmOf(StopRequest& request, bool before) {
  endOnSignals();
  if (before) ::raise(SIGTERM);
  os::sleepUntil(os::now() + 50'000'000);
  request.allInOrder();
  itimerval alarm{};
  ::getitimer(ITIMER_REAL, &alarm);
  if (!before && alarm.it_value.tv_usec != 0) ::_exit(7);
  if (!before) ::raise(SIGTERM);
  ::getitimer(ITIMER_REAL, &alarm);
  if (alarm.it_interval.tv_sec != 0 || alarm.it_interval.tv_usec != 0 || alarm.it_value.tv_sec != 0) ::_exit(8);
  return alarm.it_value.tv_usec;
}

TEST(StopSignals, TheTablesHaveUntilEightTenthsOfASecondAfterTheSignal) {
  const auto within = [](bool before, long most) {
    StopRequest request;
    const long left = alarmOf(request, before);
    ::_exit(left > 1000 && left <= most ? 9 : 1);
  };
  EXPECT_EXIT(within(true, 750'000), ExitedWithCode(9), "") << "counted from the signal";
  EXPECT_EXIT(within(false, 800'000), ExitedWithCode(9), "");
  const auto over = [] {
    StopRequest request;
    (void)alarmOf(request, false);
    ::raise(SIGINT);
    ::raise(SIGALRM);
    ::_exit(9);
  };
  EXPECT_EXIT(over(), ExitedWithCode(143), "stopped: the recording is safe, .* reach export writes them\n$");
}

TEST(HelperProgram, IsLookedForBesideTheProgramThatNeedsIt) {
  namespace fs = std::filesystem;
  const std::string name = "reachlab-test-helper-" + std::to_string(::getpid());
  const fs::path own = fs::read_symlink("/proc/self/exe").parent_path();
  EXPECT_EQ(refusalOf([&] {
              (void)findHelperProgram(name, "reach", "which helps");
            }).find("reach: " + name + ", which helps, is neither " + (own / name).string() + " nor /"),
            0u);
  for (const fs::path& folder : {own, own.parent_path() / "cli"}) {
    const bool made = fs::create_directories(folder);
    std::ofstream(folder / name) << "#!/bin/sh\n";
    EXPECT_THROW((void)findHelperProgram(name, "reach", "which helps"), ResourceError) << "it cannot be run";
    fs::permissions(folder / name, fs::perms::owner_exec, fs::perm_options::add);
    EXPECT_EQ(findHelperProgram(name, "reach", "which helps"), (folder / name).string());
    fs::remove(folder / name);
    if (made) fs::remove(folder);
  }
}

TEST(ProcessorLevel, IsThatOfTheComputerThatRunsTheTests) {
  EXPECT_NE(std::string(processorLevel()), "");
  requireProcessorLevel();
}

}  // namespace
}  // namespace reachlab

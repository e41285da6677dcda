#include "base/fault.h"
#include "cli/terminal/exit_code.h"

#include <gtest/gtest.h>

#include <vector>

#include "cli/terminal/option_words.h"
#include "tests/cli/program.h"

using namespace reachlab;

namespace {

struct Said {
  int code = 0;
  std::string words;
};

template <class Work>
Said endOf(Work&& work) {
  CLI::App app;
  testing::internal::CaptureStderr();
  const int code = cli::exitCodeOf(app, [&]() -> int {
    work();
    return 0;
  });
  return {code, testing::internal::GetCapturedStderr()};
}

}  // namespace

TEST(ExitCode, IsThatOfTheReportWhichIsPrinted) {
  EXPECT_EQ(endOf([] { throw FaultError(Fault{"x", "is bad"}); }).code, 2);
  EXPECT_EQ(endOf([] { throw ResourceError("no disk"); }).code, 3);
  const Said refused = endOf([] { throw RefusedError("stiff"); });
  EXPECT_EQ(refused.code, 4);
  EXPECT_EQ(refused.words, "error: stiff\n");
  const Said library = endOf([] { (void)std::vector<int>{1}.at(3); });
  EXPECT_EQ(library.code, 70);
  EXPECT_TRUE(test::holds(library.words, "fault of the program itself"));
}

TEST(OptionWords, TellAFaultOfTheRequestByItsOption) {
  EXPECT_EQ(endOf([] {
              throw FaultError(Fault{"participant.age", "is 200", "0 to 130 years"});
            }).words,
            "error: --age: is 200\nhelp: allowed: 0 to 130 years\n");
  EXPECT_EQ(cli::optionOf("disk_reserve"), "--disk-reserve");
  EXPECT_EQ(cli::optionOf("object.masses_kg"), "");
  const Said inFile = endOf([] { throw FaultError(Fault{"method", "is x", "auto", FilePlace{"e.json", 3, 4}}); });
  EXPECT_EQ(inFile.words, "e.json:3:4: error: method: is x\nhelp: allowed: auto\n") << "what stands in a file was not given by an option";
}

/// Every option of the table is one that some command has.
TEST(OptionWords, AreOptionsThatThereAre) {
  std::string help;
  for (const char* command : {"run", "predict", "simulate", "bench", "analyze"}) help += test::printed(std::string(command) + " --help");
  std::istringstream keys(
      "subject session trials run seed day data device fast resume disk_reserve sweep hand_mass unknowns duration hand_damping point scene "
      "method cutoff until participant.age participant.sex participant.handedness");
  for (std::string key; keys >> key;) {
    const std::string option = cli::optionOf(key);
    ASSERT_FALSE(option.empty()) << key;
    EXPECT_TRUE(holds(help, option)) << option;
  }
}

TEST(OptionWords, AreWhatAPersonReads) {
  const TemporaryFolder folder;
  const std::string data = " --data " + folder.path();
  const std::string labels = test::reach("run dingwell --device simulated --fast --subject a_b --session c-d" + data).err;
  EXPECT_EQ(labels,
            "error: --subject: \"a_b\" is not a label\nhelp: allowed: up to 60 letters and digits\n"
            "error: --session: \"c-d\" is not a label\nhelp: allowed: up to 60 letters and digits\n");
  EXPECT_TRUE(test::reach("predict chain-slow --criterion min-hand-jerk --sweep n=1:2")
                  .err.starts_with("error: --sweep: is n=1:2\nhelp: allowed: KEY=FROM"));
  EXPECT_TRUE(
      test::reach("predict ellipse --criterion min-hand-jerk --point behind-spring --unknowns 1").err.starts_with("error: --unknowns: "));
  EXPECT_TRUE(test::reach("bench --scene S99 --quick").err.starts_with("error: --scene: is S99\nhelp: allowed: S1"));
}

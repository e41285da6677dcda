#include "base/terminal/parse_fault.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace reachlab {
namespace {

/// A program with two commands, as `reach` is made.
struct Program {
  CLI::App app{"made", "made"};
  int trials = 0;
  double gain = 0;
  std::string what, side;
  std::vector<double> at;
  bool fast = false, still = false;

  Program() {
    app.require_subcommand(1);
    CLI::App* run = app.add_subcommand("run", "Runs");
    run->add_option("what", what, "The experiment")->required();
    run->add_option("--trials", trials, "Number of trials")->check(CLI::Range(1, 9));
    run->add_option("--gain", gain, "Gain")->check(CLI::NonNegativeNumber);
    run->add_option("--side", side, "Side")->check(CLI::IsMember({"L", "R"}));
    run->add_option("--at", at, "Two numbers")->expected(2);
    run->add_option("--seed", what, "Seed")
        ->check(CLI::Validator([](std::string& text) { return "is " + text + "; allowed: a seed"; }, "SEED"));
    auto* fastFlag = run->add_flag("--fast", fast, "Fast");
    run->add_flag("--still", still, "Still")->excludes(fastFlag);
    run->add_flag("--twice", still, "Twice")->needs(run->get_option("--trials"));
    app.add_subcommand("show", "Shows")->require_subcommand(1)->add_subcommand("log", "A log");
  }
};

std::string faultIn(const std::string& line) {
  Program program;
  try {
    program.app.parse(line);
    return "no error";
  } catch (const CLI::ParseError& error) {
    return toText(reachlab::faultOf(program.app, error));
  }
}

}  // namespace

TEST(ParseFault, SaysInOurWordsWhatIsWrongWithAValue) {
  EXPECT_EQ(faultIn("run a --trials 0"), "--trials: is 0; allowed: a whole number, 1 to 9");
  EXPECT_EQ(faultIn("run a --trials many"), "--trials: is many; allowed: a whole number, 1 to 9");
  EXPECT_EQ(faultIn("run a --gain -1"), "--gain: is -1; allowed: a number, 0 or more");
  EXPECT_EQ(faultIn("run a --gain high"), "--gain: is high; allowed: a number, 0 or more");
  EXPECT_EQ(faultIn("run a --side up"), "--side: is up; allowed: L or R");
  EXPECT_EQ(faultIn("run a --seed x"), "--seed: is x; allowed: a seed") << "a rule of our own";
}

TEST(ParseFault, SaysWhatIsMissing) {
  EXPECT_EQ(faultIn("run"), "what: is missing; what: The experiment");
  EXPECT_EQ(faultIn(""), "a command is missing; `made --help` explains the commands; allowed: run or show");
  EXPECT_EQ(faultIn("show"), "show: a command is missing; `made show --help` explains the commands; allowed: log");
  EXPECT_EQ(faultIn("run a --trials"), "--trials: has the wrong number of values; --trials: Number of trials");
  EXPECT_EQ(faultIn("run a --at 1"), "--at: has the wrong number of values; --at: Two numbers");
  EXPECT_EQ(faultIn("run a --twice"), "--twice: is given without --trials; give --trials, too, or leave --twice out");
  EXPECT_EQ(faultIn("run a --still --fast"), "--fast: is given together with --still; leave out one of the two");
}

TEST(ParseFault, ProposesTheNearestWord) {
  EXPECT_EQ(faultIn("rum a"), "rum: is not a command; did you mean run?; allowed: run or show");
  EXPECT_EQ(faultIn("run a --tirals 3"), "--tirals: is not a known option; did you mean --trials?; `made run --help` lists the options");
  EXPECT_EQ(faultIn("run --tirals=3"), "--tirals=3: is not a known option; did you mean --trials?; `made run --help` lists the options")
      << "and not: what is missing";
  EXPECT_EQ(faultIn("run a b"), "b: is one word too many; `made run --help` shows the form of the command");
  EXPECT_EQ(faultIn("show lag"), "lag: is not a command; did you mean log?; allowed: log");
}

TEST(ParseFault, AnOptionNamesItsRange) {
  Program program;
  const CLI::App* run = program.app.get_subcommand("run");
  EXPECT_EQ(allowedOf(*run->get_option("--trials")), "1 to 9");
  EXPECT_EQ(allowedOf(*run->get_option("--gain")), "0 or more");
  EXPECT_EQ(allowedOf(*run->get_option("--side")), "L or R");
  EXPECT_EQ(allowedOf(*run->get_option("--at")), "");
  EXPECT_EQ(typeOf(*run->get_option("--gain")), "FLOAT");
  EXPECT_EQ(typeOf(*run->get_option("--fast")), "");
}

}  // namespace reachlab

#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/fault.h"

namespace reachlab {

/// The sentence with which `work` is refused, or `done` where it was not. A refusal of another type than `Refused` is thrown on.
template <class Refused = Error, class Work>
std::string refusalOf(const Work& work, const std::string& done = {}) {
  try {
    work();
    return done;
  } catch (const Refused& refusal) {
    return refusal.what();
  }
}

/// The faults for which `work` is refused; none where it was not.
template <class Work>
std::vector<Fault> faultsToldBy(const Work& work) {
  try {
    work();
    return {};
  } catch (const FaultError& refusal) {
    return refusal.faults;
  }
}

/// The keys of faults in their order, with a blank between two.
inline std::string keysTold(const std::vector<Fault>& faults) {
  std::string keys;
  for (const Fault& fault : faults) keys += (keys.empty() ? "" : " ") + fault.key;
  return keys;
}

/// Whether a text has these words in it. Shows as much of it as a person reads.
inline testing::AssertionResult holds(const std::string& text, const std::string& words) {
  const bool has = text.find(words) != std::string::npos;
  return testing::AssertionResult(has) << '"' << text.substr(0, 4000) << "\" has " << (has ? "" : "no ") << '"' << words << '"';
}

}  // namespace reachlab

#pragma once
#include <mutex>
#include <string>
#include <vector>

namespace reachlab::test {

/// What the stand-in for liblsl was given.
struct FakeLsl {
  struct Stream {
    std::string name, type, source, clock;
    int channels = 0, format = 0;
    double rate = 0;
    std::vector<std::string> labels;
    std::vector<std::pair<double, std::string>> texts;
    std::vector<std::pair<double, std::vector<double>>> numbers;
  };
  std::mutex mutex;
  std::vector<Stream> streams;
  int alive = 0;  // handles that were not given back
  bool takesNothing = false;
  double clockAhead = 1000;  // [s] of the monotonic clock
};
FakeLsl& fakeLsl();
void resetFakeLsl();

}  // namespace reachlab::test

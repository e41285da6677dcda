#pragma once
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

/// A stand-in for hidapi, linked into tests before the real one, and for the two questions that are put to the system beside it: whether a
/// node may be opened, and its report descriptor.
namespace reachlab::test {

struct FakeHid {
  std::string path;  // "/dev/hidraw0"
  std::uint16_t vendor = 0, product = 0;
  std::wstring serial = {}, maker = {}, title = {};    // empty: the device has no such string
  std::vector<std::uint8_t> descriptor = {};           // report descriptor
  std::vector<std::uint8_t> steady = {};               // a report that there is at every reading; empty: none
  std::deque<std::vector<std::uint8_t>> reports = {};  // before it
  int closedBy = 0;                                    // errno of opening it; 0: it can be opened
  bool gone = false;                                   // reading and writing fail
  bool deaf = false;                                   // writing fails
  bool paces = true;                                   // one that has no report waits a millisecond for it
  int open = 0, opened = 0;                            // how often it is open, and was opened
  std::vector<std::vector<std::uint8_t>> written = {};
  std::vector<int> waits = {};  // [ms] of each reading
  std::size_t room = 0;         // [bytes] of the last reading
};

struct FakeHids {
  std::mutex mutex;
  std::deque<FakeHid> list;  // in the order that the system tells; places stay
};
FakeHids& fakeHids();
void resetFakeHids(const std::vector<FakeHid>& list = {});
/// The first of them is unplugged, or is there again with these reports.
void setFirstFakeHid(bool gone, const std::deque<std::vector<std::uint8_t>>& reports = {});
/// The only device from now on. It lets nobody wait.
FakeHid& resetToOneFakeHid();

}  // namespace reachlab::test

#include "base/system/stop_signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>

#include "base/system/os.h"

namespace reachlab {
namespace {

constexpr std::int64_t kPatienceNs = 800'000'000;  // so that the program has ended within a second of the signal

std::atomic<bool> stopAsked{false};
std::atomic<int> firstSignal{0};
std::atomic<std::int64_t> signalledNs{0};
std::atomic<bool> orderIsKept{false};  // a StopRequest is there and not all is in order yet
std::atomic<bool> tablesUnderWay{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

[[noreturn]] void endNow(int signal) { ::_exit(128 + signal); }

// Counted from the signal, not from here: to put things in order may have taken its time.
void startPatience() {
  constexpr std::int64_t kLeastNs = 1'000'000;  // nothing would be no alarm at all
  const std::int64_t left = std::clamp(signalledNs + kPatienceNs - os::now(), kLeastNs, kPatienceNs);
  const itimerval once{{0, 0}, {0, static_cast<suseconds_t>(left / 1000)}};
  ::setitimer(ITIMER_REAL, &once, nullptr);
}

void onPatienceOver(int) {
  constexpr char kSaid[] = "stopped: the recording is safe, the dataset's tables were not finished; reach export writes them\n";
  if (::write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) {}  // nothing is left to do about it
  endNow(firstSignal);
}

void onSignal(int signal) {
  int none = 0;
  const bool first = firstSignal.compare_exchange_strong(none, signal);
  if (first) signalledNs = os::now();
  stopAsked = true;
  if (orderIsKept) return;
  if (!tablesUnderWay) endNow(signal);
  if (first) startPatience();
}

void listen(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void endOnSignals() {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on a file's size is then a write that fails, as a full disk is
  listen(SIGALRM, onPatienceOver);
  for (const int signal : {SIGINT, SIGTERM}) listen(signal, onSignal);
  struct sigaction old {};
  ::sigaction(SIGHUP, nullptr, &old);
  if (old.sa_handler != SIG_IGN) listen(SIGHUP, onSignal);
}

StopRequest::StopRequest() { orderIsKept = true; }

StopRequest::~StopRequest() {
  const itimerval none{};  // the tables are written: there is nothing more to be patient for
  ::setitimer(ITIMER_REAL, &none, nullptr);
  orderIsKept = false;
  tablesUnderWay = false;
}

const std::atomic<bool>& StopRequest::asked() { return stopAsked; }

void StopRequest::allInOrder() {
  tablesUnderWay = true;
  orderIsKept = false;
  if (stopAsked) startPatience();
}

int StopRequest::exitCode() {
  const int signal = firstSignal;
  return signal == 0 ? 0 : 128 + signal;
}

}  // namespace reachlab

#include "base/stop_signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

namespace reachlab {
namespace {

constexpr int kPatienceUs = 800'000;  // so that the program has ended within a second of the signal

std::atomic<bool> stopAsked{false};
std::atomic<int> firstSignal{0};
std::atomic<bool> orderIsKept{false};  // a StopRequest is there and not all is in order yet
std::atomic<bool> tablesUnderWay{false};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

[[noreturn]] void endNow(int signal) { ::_exit(128 + signal); }

void startPatience() {
  const itimerval once{{0, 0}, {0, kPatienceUs}};
  ::setitimer(ITIMER_REAL, &once, nullptr);
}

void onPatienceOver(int) {
  constexpr char kSaid[] = "stopped: the recording is safe, the dataset's tables were not finished; reach export writes them\n";
  if (::write(STDERR_FILENO, kSaid, sizeof kSaid - 1) < 0) {}  // nothing is left to do about it
  endNow(firstSignal);
}

void onSignal(int signal) {
  const bool first = firstSignal.exchange(signal) == 0;
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
  listen(SIGALRM, onPatienceOver);
  for (const int signal : {SIGINT, SIGTERM}) listen(signal, onSignal);
  struct sigaction old {};
  ::sigaction(SIGHUP, nullptr, &old);
  if (old.sa_handler != SIG_IGN) listen(SIGHUP, onSignal);
}

StopRequest::StopRequest() { orderIsKept = true; }

StopRequest::~StopRequest() {
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

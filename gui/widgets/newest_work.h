#pragma once
#include <QMetaObject>
#include <QObject>
#include <QString>
#include <memory>
#include <stop_token>
#include <thread>

#include "base/system/error_report.h"

namespace reachlab::gui::widgets {

/// Work on another thread, so that the window does not wait. New work replaces the work under way, which then tells nothing any more.
/// All functions are for the window's thread, except those of a turn.
class NewestWork {
  struct Stopped {};

 public:
  /// `owner` has this as a member. Its thread receives the messages of the work.
  explicit NewestWork(QObject& owner) : owner_(owner) {}

  /// The work's view of itself, on its own thread.
  struct Turn {
    NewestWork& of;
    int number;
    const std::stop_token& stop;
    /// Ends the work here if it was stopped or replaced.
    void goOn() const {
      if (stop.stop_requested()) throw Stopped{};
    }
    /// `tell()` follows on the window's thread, unless the work is replaced before.
    template <typename Tell>
    void tell(Tell tell) const {
      const auto unlessReplaced = [work = &of, turn = number, tell] {
        if (turn == work->turn_) tell();
      };
      QMetaObject::invokeMethod(&of.owner_, unlessReplaced, Qt::QueuedConnection);
    }
  };

  /// Calls `work(turn)` on another thread, then `done(fault)` on the window's thread. The fault is a sentence, or empty after work that
  /// ended well or was stopped.
  template <typename Work, typename Done>
  void begin(Work work, Done done) {
    drop();
    busy_ = true;
    // The new thread waits for the earlier work, so that the window does not.
    auto before = std::make_shared<std::jthread>(std::move(thread_));
    thread_ = std::jthread([this, number = turn_, work, done, before](const std::stop_token& stop) mutable {
      if (before->joinable()) before->join();
      before.reset();
      const Turn turn{*this, number, stop};
      QString fault;
      try {
        turn.goOn();
        work(turn);
      } catch (const Stopped&) {
      } catch (const std::exception& e) {
        fault = QString::fromStdString(errorReportOf(e).sentence);
      }
      turn.tell([this, done, fault] {
        busy_ = false;
        done(fault);
      });
    });
  }
  /// Asks the work to stop. `done` follows.
  void stop() { thread_.request_stop(); }
  /// Stops the work, which then tells nothing any more.
  void drop() {
    stop();
    ++turn_;
    busy_ = false;
  }
  bool busy() const { return busy_; }

 private:
  QObject& owner_;
  int turn_ = 0;
  bool busy_ = false;
  std::jthread thread_;
};

}  // namespace reachlab::gui::widgets

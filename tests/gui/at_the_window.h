#pragma once
#include <gtest/gtest.h>

#include <QApplication>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <map>
#include <memory>

#include "gui/app/main_window.h"
#include "tests/gui/child.h"
#include "tests/gui/words.h"

namespace reachlab::gui {

/// Starts this program once more, for tests that are not run by themselves.
inline void startAgain(QProcess& process, const QString& tests, const std::map<QString, QString>& variables) {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  for (const auto& [name, value] : variables) environment.insert(name, value);
  process.setProcessEnvironment(environment);
  process.start(QCoreApplication::applicationFilePath(), {"--gtest_filter=" + tests, "--gtest_also_run_disabled_tests"});
}

/// The subject's screen, if it is open.
inline subject::SubjectWindow* subjectsScreen() {
  for (QWidget* top : QApplication::topLevelWidgets())
    if (auto* found = qobject_cast<subject::SubjectWindow*>(top)) return found;
  return nullptr;
}

/// Whoever sits at a window whose data lie in a folder of the test's own.
class AtTheWindow : public ::testing::Test {
 protected:
  AtTheWindow() {
    request_.place.data = folder_.filePath("data").toStdString();
    request_.what = "chain-moderate";
    request_.device = "mouse";
    request_.seed = 1;
  }
  ~AtTheWindow() override { app::forgetLayout(); }
  /// As its program makes it, on no screen.
  app::MainWindow& make() {
    window_ = std::make_unique<app::MainWindow>(request_);
    return *window_;
  }
  /// On the screen, with the keys.
  app::MainWindow& open() {
    make();
    return show();
  }
  app::MainWindow& show() {
    window_->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    QApplication::setActiveWindow(window_.get());  // there may be no window manager to do it, and shortcuts ask for it
    return *window_;
  }
  template <typename T>
  T* find(const char* name) const {
    return child<T>(*window_, name);
  }

  /// A new file of the test's folder.
  std::string write(const char* name, const std::string& text) const {
    const std::string path = folder_.filePath(QLatin1String(name)).toStdString();
    std::ofstream(path) << text;
    return path;
  }

  /// Replaces what a field holds, and takes it over where Enter is asked for.
  template <typename Field>
  static void type(Field* field, const char* text, bool enter = true) {
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, QLatin1String(text));
    if (enter) QTest::keyClick(field, Qt::Key_Return);
  }
  /// Puts the next trial up, and the run that it needs. Whether there is one.
  testing::AssertionResult startsTrial() const {
    window_->nextTrial();
    return testing::AssertionResult(window_->session().run() != nullptr) << window_->message().toStdString();
  }
  /// The same, until the trial is armed.
  bool armsTrial() const {
    window_->nextTrial();
    return waitForPhase(trial::Phase::Armed);
  }
  bool waitForPhase(trial::Phase phase) const {
    return QTest::qWaitFor([&] { return window_->session().run() != nullptr && window_->session().run()->latest().phase == phase; }, 20000);
  }
  bool waitForTrialsEnd() const {
    return QTest::qWaitFor([&] { return window_->session().lastTrial().has_value(); }, 20000);
  }

  QTemporaryDir folder_;
  session::SessionRequest request_;
  std::unique_ptr<app::MainWindow> window_;
};

}  // namespace reachlab::gui

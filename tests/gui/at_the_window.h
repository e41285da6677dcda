#pragma once
#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <memory>

#include "gui/app/main_window.h"
#include "tests/gui/child.h"

namespace reachlab::gui {

/// Whoever sits at a window whose data lie in a folder of the test's own.
class AtTheWindow : public ::testing::Test {
 protected:
  AtTheWindow() {
    request_.place.data = folder_.filePath(QStringLiteral("data")).toStdString();
    request_.device = "mouse";
    request_.seed = 1;
  }
  /// As its program makes it, on no screen.
  app::MainWindow& make() {
    window_ = std::make_unique<app::MainWindow>(request_);
    return *window_;
  }
  /// On the screen, with the keys.
  app::MainWindow& open() {
    make().show();
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

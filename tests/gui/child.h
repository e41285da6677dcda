#pragma once
#include <gtest/gtest.h>

#include <QObject>

namespace reachlab::gui {

/// The child of that name. There must be one.
template <class T>
T* child(const QObject& of, const char* name) {
  T* found = of.findChild<T*>(QLatin1String(name));
  EXPECT_NE(found, nullptr) << name;
  return found;
}

}  // namespace reachlab::gui

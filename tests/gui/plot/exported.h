#pragma once
#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>

namespace reachlab::gui::plot {

/// The lines of the plot's table.
template <class Plot>
QList<QByteArray> exportedLines(Plot& plot) {
  const QTemporaryDir folder;
  QFile file(folder.filePath("plot.csv"));
  EXPECT_TRUE(plot.exportTo(file.fileName()));
  EXPECT_TRUE(file.open(QIODevice::ReadOnly));
  return file.readAll().trimmed().split('\n');
}

/// The plot is drawn to files of the known endings alone.
template <class Plot>
void expectDrawings(Plot& plot) {
  const QTemporaryDir folder;
  for (const char* name : {"plot.svg", "plot.pdf"}) {
    ASSERT_TRUE(plot.exportTo(folder.filePath(name))) << name;
    EXPECT_GT(QFile(folder.filePath(name)).size(), 2000) << name;
  }
  EXPECT_FALSE(plot.exportTo(folder.filePath("plot.doc")));
  for (const char* name : {"folder.svg", "folder.pdf", "folder.csv"}) {
    QDir(folder.path()).mkdir(name);
    EXPECT_FALSE(plot.exportTo(folder.filePath(name))) << name << " cannot be written";
  }
}

}  // namespace reachlab::gui::plot

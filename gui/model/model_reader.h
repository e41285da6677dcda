#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <string>

#include "gui/model/model.h"
#include "gui/widgets/newest_work.h"

namespace reachlab::gui::model {

/// The file that an experiment names so: beside the experiment or recording in `folder`, if it is there.
std::string findSceneFile(const std::string& named, const QString& folder);

/// Reads scene files on another thread, so that a large file or a slow disk does not block the window. A new request replaces an unfinished request.
/// Window's thread.
class ModelReader : public QObject {
  Q_OBJECT
 public:
  /// `ready` or `failed` follows, but not if the request is cancelled or replaced. An empty name means no scene, which is ready at once. A
  /// file that is read or being read is not read again.
  void begin(const std::string& file);
  void cancel() { work_.stop(); }
  const std::shared_ptr<const Model>& model() const { return model_; }

 Q_SIGNALS:
  void ready();
  void failed(const QString& sentence);
  /// Progress of long work. `percent` is -1 if it is not known.
  void progressed(const QString& what, int percent);
  void idle();

 private:
  std::string file_;  // that is read, or being read
  std::shared_ptr<const Model> model_;
  widgets::NewestWork work_{*this};
};

}  // namespace reachlab::gui::model

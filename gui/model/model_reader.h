#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <string>
#include <thread>

#include "gui/model/model.h"
#include "gui/model/watch.h"

namespace reachlab::gui::model {

/// As readModel(file); `watch` is told the share that is read, and may throw.
Model readModel(const std::string& file, const Watch& watch);
/// The file that an experiment names so: beside the experiment or recording in `folder`, if it is there.
std::string findSceneFile(const std::string& named, const QString& folder);

/// Reads scene files beside the window: a large one, or a slow disk, keeps nobody waiting. The newest one wins. The window's thread.
class ModelReader : public QObject {
  Q_OBJECT
 public:
  explicit ModelReader(QObject* parent = nullptr);
  ~ModelReader() override;

  /// `ready` follows, or `failed`; nothing where it is cancelled or another is begun. Empty: no scene, which is ready at once.
  /// Reads nothing that is read already, or being read.
  void begin(const std::string& file);
  void cancel();
  const std::shared_ptr<const Model>& model() const { return model_; }

 Q_SIGNALS:
  void ready();
  void failed(const QString& sentence);
  /// Of what takes long. `percent`: -1 where it is not known.
  void progressed(const QString& what, int percent);
  void idle();

 private:
  template <typename Tell>
  void tell(int turn, Tell tell);

  std::string file_;  // that is read, or being read
  std::shared_ptr<const Model> model_;
  int turn_ = 0;  // what an earlier reading still tells is passed over
  std::jthread thread_;
};

}  // namespace reachlab::gui::model

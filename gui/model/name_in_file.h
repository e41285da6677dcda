#pragma once
#include <QString>
#include <string>

namespace reachlab::gui::model {

/// The name by which a plan or an experiment that is written as `file` finds the file `named`. A file in its folder keeps a relative name
/// and moves with it. Another file is found from every folder. A name without a file, such as a shipped name, stays.
std::string nameInFile(const std::string& named, const QString& file);

}  // namespace reachlab::gui::model

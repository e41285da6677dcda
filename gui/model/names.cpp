#include "gui/model/model.h"

namespace reachlab::gui::model {

bool isMoving(const std::string& name) {
  if (name == "hand") return true;
  return name.size() > 4 && name.size() < 8 && name.starts_with("mass") && name[4] != '0' &&
         name.find_first_not_of("0123456789", 4) == std::string::npos;
}

}  // namespace reachlab::gui::model

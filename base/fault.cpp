#include "base/fault.h"

namespace reachlab {

Fault fileFault(const std::string& file, const std::string& what, const std::string& allowed) {
  return {{}, what, allowed, FilePlace{file}};
}

std::string toText(const Fault& fault) {
  std::string text, key = fault.key;
  if (fault.place && fault.place->file.empty()) {
    key += (key.empty() ? "character " : ", character ") + std::to_string(fault.place->column);
  } else if (fault.place) {
    text += fault.place->file;
    if (fault.place->line > 0) text += ":" + std::to_string(fault.place->line);
    if (fault.place->line > 0 && fault.place->column > 0) text += ":" + std::to_string(fault.place->column);
    text += ": ";
  }
  if (!key.empty()) text += key + ": ";
  text += fault.what;
  if (!fault.allowed.empty()) text += "; allowed: " + fault.allowed;
  return text;
}

std::string toText(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + toText(fault);
  return text;
}

std::string keyIn(const std::string& outer, const std::string& inner) { return outer.empty() ? inner : outer + "." + inner; }

std::vector<Fault> inside(const std::string& key, std::vector<Fault> faults) {
  for (Fault& fault : faults) fault.key = fault.key.empty() ? key : keyIn(key, fault.key);
  return faults;
}

std::vector<Fault> inFile(const std::string& file, std::vector<Fault> faults) {
  for (Fault& fault : faults)
    if (!fault.place) fault.place = FilePlace{file};
  return faults;
}

}  // namespace reachlab

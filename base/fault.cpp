#include "base/fault.h"

namespace reachlab {

std::string toText(const Fault& fault) {
  std::string text, key = fault.key;
  if (fault.place && fault.place->file.empty()) {
    key += (key.empty() ? "character " : ", character ") + std::to_string(fault.place->column);
  } else if (fault.place) {
    text += fault.place->file;
    if (fault.place->line > 0) text += ":" + std::to_string(fault.place->line) + ":" + std::to_string(fault.place->column);
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

std::vector<Fault> faultsOf(const UsageError& error) {
  if (const auto* told = dynamic_cast<const FaultError*>(&error)) return told->faults;
  return {Fault{.what = error.what()}};
}

}  // namespace reachlab

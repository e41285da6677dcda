#include "devices/vendor/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"

namespace reachlab::devices {

SharedLibrary::SharedLibrary(const std::vector<std::string>& names) {
  std::string words;
  for (const std::string& name : names) {
    handle_ = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      name_ = name;
      return;
    }
    const char* error = ::dlerror();
    const std::string said = error != nullptr ? error : "no reason given";
    // A library that is there but lacks another one tells more than one that is not there.
    const bool isAbsent = said.starts_with(name) && said.find("No such file") != std::string::npos;
    if (words.empty() || !isAbsent) words = said;
    if (!isAbsent) break;
  }
  throw ResourceError(
      fmt::format("{}; looked for {} where the loader looks (LD_LIBRARY_PATH, /etc/ld.so.conf)", words, fmt::join(names, ", ")));
}

SharedLibrary::Symbol SharedLibrary::find(const char* symbol) const { return {::dlsym(handle_, symbol)}; }

SharedLibrary::Symbol SharedLibrary::require(const char* symbol) const {
  if (const Symbol found = find(symbol); found.address != nullptr) return found;
  throw ResourceError(fmt::format("{}: has no function {}; is it another version?", name_, symbol));
}

}  // namespace reachlab::devices

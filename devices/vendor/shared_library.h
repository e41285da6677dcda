#pragma once
#include <string>
#include <vector>

namespace reachlab::devices {

/// A vendor's library, loaded while the program runs and never unloaded. OpenHaptics fails when it is loaded a second time.
class SharedLibrary {
 public:
  /// Loads the first of `names` that the system's loader finds (LD_LIBRARY_PATH, ld.so.conf). Throws ResourceError with the tried names and
  /// the loader's message.
  explicit SharedLibrary(const std::vector<std::string>& names);

  const std::string& name() const { return name_; }
  /// An address in the library, as a pointer to whatever function it is assigned to.
  struct Symbol {
    void* address = nullptr;
    template <typename Function>
    operator Function*() const {
      return reinterpret_cast<Function*>(address);
    }
  };
  /// Throws ResourceError when the library has no symbol of that name.
  Symbol require(const char* symbol) const;
  /// The same for a function that some versions lack. It is then null.
  Symbol find(const char* symbol) const;

 private:
  std::string name_;
  void* handle_ = nullptr;
};

}  // namespace reachlab::devices

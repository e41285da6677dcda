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
  /// Null when the library has no symbol of that name.
  void* find(const char* symbol) const;
  /// Binds `function` to the symbol. Throws ResourceError when the symbol is missing.
  template <typename Function>
  void bind(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(require(symbol));
  }
  /// The same for a function that some versions lack. It is then null.
  template <typename Function>
  void bindIfThere(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(find(symbol));
  }

 private:
  void* require(const char* symbol) const;
  std::string name_;
  void* handle_ = nullptr;
};

}  // namespace reachlab::devices

#pragma once
#include <string>
#include <vector>

namespace reachlab::devices {

/// A vendor's library, taken when the program runs and never given back: OpenHaptics fails when it is loaded a second time.
class SharedLibrary {
 public:
  /// Loads the first of `names` that the system's loader finds (LD_LIBRARY_PATH, ld.so.conf). Throws ResourceError with the names that
  /// were tried and the loader's own words.
  explicit SharedLibrary(const std::vector<std::string>& names);

  const std::string& name() const { return name_; }
  /// Null when it has none of that name.
  void* find(const char* symbol) const;
  /// Binds `function` to the symbol. Throws ResourceError when there is none.
  template <typename Function>
  void bind(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(require(symbol));
  }
  /// The same for what not every version has: null then.
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

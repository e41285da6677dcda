#pragma once
#include <optional>
#include <string>
#include <vector>

namespace reachlab {

/// The options `plain,key=value,key=value` behind a device's name. The driver must take every key: `done` refuses each key that was not
/// taken.
class DeviceOptions {
 public:
  /// `device` is used in messages, e.g. "device hid:0001". Throws FaultError for a key that comes twice.
  DeviceOptions(const std::string& text, std::string device);

  /// The first item, if it has no `=`. It is a serial number, an index or a model.
  const std::string& plain() const { return plain_; }
  /// The value of a key. The key then counts as taken.
  std::optional<std::string> take(const std::string& key);
  /// A number within [least, most]. Throws FaultError otherwise.
  double number(const std::string& key, double otherwise, double least, double most);
  /// A whole number within [least, most]. Throws FaultError otherwise.
  int count(const std::string& key, int otherwise, int least, int most);
  /// One of the words. The first word is the default. Throws FaultError for any other value.
  std::string word(const std::string& key, const std::vector<std::string>& allowed);
  /// The options that are left, as they were written. A driver hands them on.
  std::string rest();
  /// Throws FaultError, which names the unknown keys and the allowed keys.
  void done() const;

 private:
  template <class Number>
  Number within(const std::string& key, Number otherwise, Number least, Number most, const char* kind);
  std::string device_, plain_;
  std::vector<std::pair<std::string, std::string>> items_;
  std::vector<std::string> known_;
};

}  // namespace reachlab

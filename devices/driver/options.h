#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reachlab::devices {

/// `plain,key=value,key=value` behind a device's name. Every key must be taken by its driver: `done` refuses what was not.
class DeviceOptions {
 public:
  /// `device`: for messages, e.g. "device hid:0001". Throws FaultError for a key that comes twice.
  DeviceOptions(const std::string& text, std::string device);

  /// The first item, if it has no `=`: a serial number, an index, a model.
  const std::string& plain() const { return plain_; }
  /// The value of a key, which then counts as taken.
  std::optional<std::string> take(const std::string& key);
  /// A number within [least, most]; throws FaultError otherwise.
  double number(const std::string& key, double otherwise, double least, double most);
  /// One of the words; the first is the default. Throws FaultError otherwise.
  std::string word(const std::string& key, const std::vector<std::string>& allowed);
  /// What is left, as it was written: for a driver that hands the rest on.
  std::string rest();
  /// Throws FaultError naming what is unknown and what is allowed.
  void done() const;

 private:
  std::string device_, plain_;
  std::vector<std::pair<std::string, std::string>> items_;
  std::vector<std::string> known_;
};

}  // namespace reachlab::devices

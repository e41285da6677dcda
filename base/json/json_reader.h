#pragma once
#include <string>
#include <vector>

#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/names.h"
#include "base/number_range.h"

namespace reachlab {

/// Faults of one file in the order of the file, each as `FILE:LINE:COLUMN: KEY: fault; allowed: …`.
class FaultList {
 public:
  explicit FaultList(std::string file) : file_(std::move(file)) {}
  void add(const JsonNode& where, const std::string& key, const std::string& what, const std::string& allowed = {});
  /// True if the node is of that kind. Otherwise a fault says of what kind it is.
  bool requireKind(const JsonNode& node, JsonNode::Kind kind, const std::string& key, const std::string& allowed);
  /// Adds a fault of the value that was read from `root`, at the location of its key there, or as a missing key. It is left out if the file
  /// itself has a fault about that key, a key inside it or a key around it. In that case the value has a default.
  /// A fault of another file, which this one names, keeps its place.
  void addOfValue(const JsonNode& root, Fault fault);
  /// True when there is a fault about that key, a key inside it or a key around it.
  bool isAbout(const std::string& key) const;
  /// More than a person reads: further faults are only counted.
  bool isFull() const { return faults_.size() >= kMaxFaults; }
  const std::vector<Fault>& faults() const { return faults_; }
  bool empty() const { return faults_.empty(); }
  /// Throws FaultError with all faults, in the file's order, when there are any.
  void throwIfAny() const;

 private:
  void keep(Fault fault);  // or count it, when the list is full

  static constexpr std::size_t kMaxFaults = 100, kNone = static_cast<std::size_t>(-1);
  std::string file_;
  std::vector<Fault> faults_;
  std::size_t more_ = 0;
  std::size_t ofFile_ = kNone;  // so many faults are of the file itself, before any of its value
};

/// Faults of a value at the locations of their keys in the text from which it was read. Without a text they are unchanged.
std::vector<Fault> atTheirPlaces(std::vector<Fault> faults, const std::string& text, const std::string& file);

/// Reads one JSON object key by key and remembers the keys that were asked for. `finish` reports the others as unknown, with the nearest
/// known name. Faults are collected. A faulty value reads as its default. A faulty number reads as NaN, so that the value's own check
/// states the allowed range.
class ObjectReader {
 public:
  ObjectReader(FaultList& faults, const JsonNode& node, std::string path);

  const JsonNode* optional(const std::string& key);
  const JsonNode* required(const std::string& key, const std::string& allowed);

  void number(const std::string& key, const NumberRange& range, double& value);
  bool requiredNumber(const std::string& key, const NumberRange& range, double& value);
  void integer(const std::string& key, int lo, int hi, int& value);
  void boolean(const std::string& key, bool& value);
  void text(const std::string& key, std::string& value);
  bool choice(const std::string& key, const std::vector<std::string>& names, std::string& value, bool isRequired);
  /// Numbers. If `length` < 0, any number of them is allowed.
  bool numbers(const JsonNode& node, const std::string& key, int length, const NumberRange& range, std::vector<double>& values);
  bool strings(const JsonNode& node, const std::string& key, int length, std::vector<std::string>& values);
  void finish();

  std::string keyPath(const std::string& key) const;
  FaultList& faults() { return faults_; }
  const JsonNode& node() const { return node_; }

 private:
  bool readNumber(const JsonNode& node, const std::string& path, const NumberRange& range, double& value);

  FaultList& faults_;
  const JsonNode& node_;
  std::string path_;
  std::vector<std::string> known_;
};

}  // namespace reachlab

#include "base/json/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <utility>

namespace reachlab {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// "object.masses_kg[1]" is inside of "object.masses_kg" and of "object".
bool isInside(std::string_view key, std::string_view outer) {
  return key.starts_with(outer) && (key.size() == outer.size() || key[outer.size()] == '.' || key[outer.size()] == '[');
}

/// Whether a fault is about that key, a key inside it, or a key around it.
auto isBeside(const std::string& key) {
  return [&key](const Fault& f) { return isInside(key, f.key) || isInside(f.key, key); };
}

struct Found {
  const JsonNode* node = nullptr;  // what stands at the key, or the nearest that it would stand in
  bool missing = false;            // a member that an object has not
};

/// By its name, or as a change of all elements names it: "masses_kg[*]" for "masses_kg[2]".
const JsonNode* findMember(const JsonNode& node, std::string_view name) {
  if (const JsonNode* member = node.find(std::string(name))) return member;
  std::string ofAll;
  for (std::size_t i = 0; i < name.size(); ++i) {
    ofAll += name[i];
    if (name[i] != '[') continue;
    ofAll += '*';
    while (i + 1 < name.size() && name[i + 1] != ']') ++i;
  }
  return node.find(ofAll);
}

Found findKey(const JsonNode& root, std::string_view key) {
  const JsonNode* node = &root;
  while (!key.empty()) {
    if (key.front() == '[') {
      const std::size_t end = std::min(key.find(']'), key.size() - 1);
      std::size_t index = node->items.size();
      std::from_chars(key.data() + 1, key.data() + end, index);
      if (index >= node->items.size()) return {node};
      node = &node->items[index];
      key.remove_prefix(end + 1);
    } else {
      if (key.front() == '.') key.remove_prefix(1);
      // A change's key is one member, "task.duration_s": the longest name that is there counts.
      std::size_t end = key.size();
      const JsonNode* member = findMember(*node, key);
      while (member == nullptr && end > 0 && (end = key.find_last_of(".[", end - 1)) != std::string_view::npos)
        member = findMember(*node, key.substr(0, end));
      if (member == nullptr) return {node, node->kind == JsonNode::Kind::Object};
      node = member;
      key.remove_prefix(end);
    }
  }
  return {node};
}

}  // namespace

void FaultList::add(const JsonNode& where, const std::string& key, const std::string& what, const std::string& allowed) {
  keep({key, what, allowed, FilePlace{file_, where.line, where.column}});
}

void FaultList::keep(Fault fault) {
  if (isFull()) ++more_;
  else faults_.push_back(std::move(fault));
}

bool FaultList::requireKind(const JsonNode& node, JsonNode::Kind kind, const std::string& key, const std::string& allowed) {
  if (node.kind != kind) add(node, key, fmt::format("is {}", nameOf(node.kind)), allowed);
  return node.kind == kind;
}

bool FaultList::isAbout(const std::string& key) const { return std::any_of(faults_.begin(), faults_.end(), isBeside(key)); }

void FaultList::addOfValue(const JsonNode& root, Fault fault) {
  if (ofFile_ == kNone) ofFile_ = faults_.size();
  if (fault.place && !fault.place->file.empty() && fault.place->file != file_) return keep(std::move(fault));
  const auto endOfFile = faults_.begin() + static_cast<std::ptrdiff_t>(ofFile_);
  const auto told = std::find_if(faults_.begin(), endOfFile, isBeside(fault.key));
  if (told != endOfFile) {
    // The file's fault knows no range; the value's does.
    if (told->key == fault.key && told->allowed == anyNumber().allowed) told->allowed = fault.allowed;
    return;
  }
  const Found found = findKey(root, fault.key);
  if (found.missing && fault.what == "has 0 elements") fault.what = "is missing";  // a list has no default
  else if (found.missing && !fault.what.starts_with("is missing")) fault.what = "is missing, and by default " + fault.what;
  FilePlace place{file_, found.node->line, found.node->column};
  if (fault.place && fault.place->file.empty()) place.column += fault.place->column;  // behind the string's opening quote
  fault.place = place;
  keep(std::move(fault));
}

void FaultList::throwIfAny() const {
  if (faults_.empty()) return;
  std::vector<Fault> all = faults_;
  const auto at = [](const Fault& f) { return std::pair(f.place->line, f.place->column); };
  std::stable_sort(all.begin(), all.end(), [&](const Fault& a, const Fault& b) { return at(a) < at(b); });
  if (more_ > 0) all.push_back({.what = fmt::format("and {} more faults", more_), .place = FilePlace{file_}});
  throw FaultError(std::move(all));
}

std::vector<Fault> atTheirPlaces(std::vector<Fault> faults, const std::string& text, const std::string& file) {
  if (text.empty() || faults.empty()) return faults;
  const JsonNode root = parseJson(text, file);
  FaultList list(file);
  for (Fault& fault : faults) list.addOfValue(root, std::move(fault));
  return list.faults();
}

ObjectReader::ObjectReader(FaultList& faults, const JsonNode& node, std::string path)
    : faults_(faults), node_(node), path_(std::move(path)) {
  faults_.requireKind(node_, JsonNode::Kind::Object, path_.empty() ? "file" : path_, "an object { … }");
}

std::string ObjectReader::keyPath(const std::string& key) const { return keyIn(path_, key); }

const JsonNode* ObjectReader::optional(const std::string& key) {
  known_.push_back(key);
  return node_.find(key);
}

const JsonNode* ObjectReader::required(const std::string& key, const std::string& allowed) {
  const JsonNode* node = optional(key);
  if (node == nullptr && node_.kind == JsonNode::Kind::Object) faults_.add(node_, keyPath(key), "is missing", allowed);
  return node;
}

bool ObjectReader::readNumber(const JsonNode& node, const std::string& path, const NumberRange& range, double& value) {
  value = kNoNumber;
  if (!faults_.requireKind(node, JsonNode::Kind::Number, path, range.allowed)) return false;
  if (isWithin(range, node.number)) value = node.number;
  else faults_.add(node, path, fmt::format("is {}", node.number), range.allowed);
  return !std::isnan(value);
}

void ObjectReader::number(const std::string& key, const NumberRange& range, double& value) {
  if (const JsonNode* node = optional(key)) readNumber(*node, keyPath(key), range, value);
}

bool ObjectReader::requiredNumber(const std::string& key, const NumberRange& range, double& value) {
  const JsonNode* node = required(key, range.allowed);
  if (node == nullptr) value = kNoNumber;
  return node != nullptr && readNumber(*node, keyPath(key), range, value);
}

void ObjectReader::integer(const std::string& key, int lo, int hi, int& value) {
  const JsonNode* node = optional(key);
  if (node == nullptr) return;
  const NumberRange range = wholeNumber(lo, hi);
  double read = 0;
  if (readNumber(*node, keyPath(key), range, read)) value = static_cast<int>(read);
}

void ObjectReader::boolean(const std::string& key, bool& value) {
  const JsonNode* node = optional(key);
  if (node != nullptr && faults_.requireKind(*node, JsonNode::Kind::Boolean, keyPath(key), "true or false")) value = node->boolean;
}

void ObjectReader::text(const std::string& key, std::string& value) {
  const JsonNode* node = optional(key);
  if (node != nullptr && faults_.requireKind(*node, JsonNode::Kind::String, keyPath(key), "a string")) value = node->string;
}

bool ObjectReader::choice(const std::string& key, const std::vector<std::string>& names, std::string& value, bool isRequired) {
  const std::string allowed = listOf(names);
  const JsonNode* node = isRequired ? required(key, allowed) : optional(key);
  if (node == nullptr || !faults_.requireKind(*node, JsonNode::Kind::String, keyPath(key), allowed)) return false;
  const bool known = std::find(names.begin(), names.end(), node->string) != names.end();
  if (known) value = node->string;
  else faults_.add(*node, keyPath(key), fmt::format("is \"{}\"", node->string), allowed);
  return known;
}

bool ObjectReader::numbers(const JsonNode& node, const std::string& key, int length, const NumberRange& range,
                           std::vector<double>& values) {
  const std::string shape = length < 0 ? "an array of numbers" : fmt::format("an array of {} number{}", length, length == 1 ? "" : "s");
  if (!faults_.requireKind(node, JsonNode::Kind::Array, keyPath(key), shape)) return false;
  if (length >= 0 && node.items.size() != static_cast<std::size_t>(length)) {
    faults_.add(node, keyPath(key), fmt::format("has {} element{}", node.items.size(), node.items.size() == 1 ? "" : "s"), shape);
    return false;
  }
  std::vector<double> read(node.items.size());
  bool fine = true;
  for (std::size_t i = 0; i < read.size(); ++i)
    fine = readNumber(node.items[i], fmt::format("{}[{}]", keyPath(key), i), range, read[i]) && fine;
  if (fine) values = std::move(read);
  return fine;
}

bool ObjectReader::strings(const JsonNode& node, const std::string& key, int length, std::vector<std::string>& values) {
  const std::string shape = fmt::format("an array of {} strings", length);
  if (!faults_.requireKind(node, JsonNode::Kind::Array, keyPath(key), shape)) return false;
  if (node.items.size() != static_cast<std::size_t>(length)) {
    faults_.add(node, keyPath(key), fmt::format("has {} elements", node.items.size()), shape);
    return false;
  }
  std::vector<std::string> read;
  for (const JsonNode& item : node.items) {
    if (!faults_.requireKind(item, JsonNode::Kind::String, fmt::format("{}[{}]", keyPath(key), read.size()), "a string")) return false;
    read.push_back(item.string);
  }
  values = std::move(read);
  return true;
}

void ObjectReader::finish() {
  for (const auto& [key, value] : node_.members) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    if (faults_.isFull()) {  // only counted: no names need be compared
      faults_.add(value, keyPath(key), {});
      continue;
    }
    std::vector<std::string> sorted = known_;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    JsonNode keyPlace;
    keyPlace.line = value.keyLine, keyPlace.column = value.keyColumn;
    faults_.add(keyPlace, keyPath(key), "is not known here" + didYouMean(key, known_), listOf(sorted));
  }
}

}  // namespace reachlab

#include "base/json/json_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <tuple>
#include <unordered_set>

#include "base/fault.h"

namespace reachlab {
namespace {

constexpr std::size_t kMaxDepth = 64;

// The parser reads the text through this iterator, so that the events below know how far it has come.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at = nullptr;
  const char** furthest = nullptr;
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    ++at;
    if (furthest != nullptr && at > *furthest) *furthest = at;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& o) const { return at == o.at; }
};

// The library's description of a fault in the text, and ours of the same fault.
struct SyntaxFault {
  std::string_view library;
  const char *what, *allowed;
};
constexpr SyntaxFault kSyntaxFaults[] = {
    {"unexpected end of input", "the text ends before the value is complete", "one whole JSON value"},
    {"empty input", "the text ends before the value is complete", "one whole JSON value"},
    {"missing closing quote", "a string is not closed before the end of the text", "a double quote at its end"},
    {"control character", "a string contains a control character, such as the end of its line", "\\n for a new line, \\t for a tab"},
    {"UTF-8", "a string contains bytes that are not UTF-8", "a file saved as UTF-8"},
    {"backslash", "this character has no meaning after a backslash", "\\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX"},
    {"'\\u'", "an escaped character is not complete", "\\u and four hexadecimal digits"},
    {"surrogate", "half of a pair of escaped characters is missing", "both halves, \\uD8XX\\uDCXX"},
    {"BOM", "the mark at the beginning of the text is not complete", "a file saved as UTF-8"},
    {"comment", "this comment is not complete", "// to the end of the line, or /* and */"},
    {"invalid number", "this number is not complete", "numbers such as 1, -0.5 and 2e-3"},
    {"; expected string literal", "a key is missing here", "a key in double quotes"},
    {"; expected ':'", "a colon is missing behind the key", "\"key\": value"},
    {"; expected '}'", "a comma or a closing bracket is missing here", ", or }"},
    {"; expected ']'", "a comma or a closing bracket is missing here", ", or ]"},
    {"; expected end of input", "the text continues behind its closing bracket", "one value in a file"},
    {"", "this is not a value", "a number, true, false, null, text in double quotes, [ or {"}};

// Messages of nlohmann/json: "…; last read: 'TEXT'; expected …", where TEXT is of the file and tells nothing of the fault.
SyntaxFault syntaxFault(std::string message) {
  if (const auto read = message.find("; last read"); read != std::string::npos)
    message.erase(read, std::max(message.rfind("'; expected"), read) - read);
  return *std::find_if(std::begin(kSyntaxFaults), std::end(kSyntaxFaults),
                       [&](const SyntaxFault& fault) { return message.find(fault.library) != std::string::npos; });
}

class TreeBuilder : public nlohmann::json::json_sax_t {
 public:
  TreeBuilder(const std::string& text, std::string file, const char** furthest)
      : text_(text), file_(std::move(file)), furthest_(furthest) {}

  JsonNode root;

  bool null() override { return add(JsonNode::Kind::Null, tokenStart()), true; }
  bool boolean(bool value) override {
    add(JsonNode::Kind::Boolean, tokenStart()).boolean = value;
    return true;
  }
  bool number_integer(number_integer_t value) override { return putWhole(value); }
  bool number_unsigned(number_unsigned_t value) override { return putWhole(value); }
  bool number_float(number_float_t value, const string_t&) override { return putNumber(value, false); }
  bool string(string_t& value) override {
    add(JsonNode::Kind::String, stringStart()).string = value;
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonNode::Kind::Object); }
  bool start_array(std::size_t) override { return open(JsonNode::Kind::Array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    const std::size_t start = stringStart();
    if (!keys_.back().insert(value).second) throw FaultError(Fault{value, "stands here twice", "each key once", place(start)});
    key_ = value;
    std::tie(keyLine_, keyColumn_) = lineAndColumn(start);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
    const std::size_t end = offset();
    if (e.id == 406) throw FaultError(Fault{{}, "this number is beyond the range of a double", "finite numbers", place(tokenStart())});
    if (const std::size_t comma = trailingComma(end); comma != std::string::npos)
      throw FaultError(Fault{{}, "this comma has nothing behind it", "a further element, or no comma after the last one", place(comma)});
    const SyntaxFault fault = syntaxFault(e.what());
    std::string what = fault.what;
    if (fault.library == "unexpected end of input" && !open_.empty())
      what += fmt::format("; the bracket of line {} is not closed", open_.back()->line);
    throw FaultError(Fault{{}, what, fault.allowed, place(end > 0 ? end - 1 : 0)});
  }

 private:
  std::size_t offset() const { return static_cast<std::size_t>(*furthest_ - text_.data()); }

  // Where the bracket that ends at `end` closes behind a comma: that comma.
  std::size_t trailingComma(std::size_t end) const {
    if (end < 2 || (text_[end - 1] != ']' && text_[end - 1] != '}')) return std::string::npos;
    const std::size_t before = text_.find_last_not_of(" \t\r\n", end - 2);
    return before != std::string::npos && text_[before] == ',' ? before : std::string::npos;
  }
  FilePlace place(std::size_t at) {
    const auto [line, column] = lineAndColumn(at);
    return {file_, line, column};
  }
  // Counted on from the place asked for last: values come in the order of the file, so that all of them together cost one pass.
  std::pair<int, int> lineAndColumn(std::size_t at) {
    if (at < counted_.at) counted_ = {};
    for (; counted_.at < at && counted_.at < text_.size(); ++counted_.at) {
      if (text_[counted_.at] == '\n') {
        ++counted_.line, counted_.column = 1;
      } else if ((static_cast<unsigned char>(text_[counted_.at]) & 0xC0) != 0x80) {
        ++counted_.column;
      }
    }
    return {counted_.line, counted_.column};
  }
  // Start of the word or number that has just been read; the parser is at most one character past its end.
  std::size_t tokenStart() const {
    const auto isTokenCharacter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.'; };
    std::size_t at = std::min(offset(), text_.size());
    while (!isTokenCharacter(text_[at - 1])) --at;
    while (at > 0 && isTokenCharacter(text_[at - 1])) --at;
    return at;
  }
  // Start of the string whose closing quote has just been read.
  std::size_t stringStart() const {
    std::size_t at = offset() - 1;
    const auto isEscaped = [&](std::size_t quote) {
      std::size_t backslashes = 0;
      while (quote > backslashes && text_[quote - 1 - backslashes] == '\\') ++backslashes;
      return backslashes % 2 == 1;
    };
    while (text_[at - 1] != '"' || isEscaped(at - 1)) --at;
    return at - 1;
  }
  // A double holds every whole number up to 2^53; one beyond would become its neighbour without a word.
  template <class Whole>
  bool putWhole(Whole value) {
    constexpr double kMost = 9007199254740992;
    const auto number = static_cast<double>(value);
    if (std::abs(number) > kMost || (std::abs(number) == kMost && static_cast<Whole>(number) != value))
      throw FaultError(Fault{key_, fmt::format("is {}, which would be rounded", value), fmt::format("whole numbers up to {:.0f}", kMost),
                             place(tokenStart())});
    return putNumber(number, true);
  }
  bool putNumber(double value, bool integer) {
    JsonNode& node = add(JsonNode::Kind::Number, tokenStart());
    node.number = value;
    node.integer = integer;
    return true;
  }

  // A child's address is stable until it is closed: its parent gets no further child before.
  JsonNode& add(JsonNode::Kind kind, std::size_t start) {
    JsonNode* node = &root;
    if (!open_.empty() && open_.back()->kind == JsonNode::Kind::Array) node = &open_.back()->items.emplace_back();
    else if (!open_.empty()) {
      node = &open_.back()->members.emplace_back(key_, JsonNode()).second;
      node->keyLine = keyLine_, node->keyColumn = keyColumn_;
    }
    node->kind = kind;
    std::tie(node->line, node->column) = lineAndColumn(start);
    return *node;
  }
  bool open(JsonNode::Kind kind) {
    const std::size_t start = offset() - 1;
    if (open_.size() >= kMaxDepth) throw FaultError(Fault{{}, "nested too deeply", fmt::format("{} levels", kMaxDepth), place(start)});
    open_.push_back(&add(kind, start));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }

  const std::string& text_;
  std::string file_;
  const char** furthest_;
  std::vector<JsonNode*> open_;
  std::vector<std::unordered_set<std::string>> keys_;  // of each open object
  std::string key_;
  int keyLine_ = 0, keyColumn_ = 0;
  struct {
    std::size_t at = 0;
    int line = 1, column = 1;
  } counted_;
};

}  // namespace

JsonNode::JsonNode() = default;

const JsonNode* JsonNode::find(const std::string& key) const {
  for (const auto& [name, node] : members)
    if (name == key) return &node;
  return nullptr;
}

const char* nameOf(JsonNode::Kind kind) {
  constexpr const char* kNames[]{"null", "a truth value", "a number", "a string", "an array", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

JsonNode parseJson(const std::string& text, const std::string& file) {
  const char* furthest = text.data();
  TreeBuilder builder(text, file, &furthest);
  const CountingIterator begin{text.data(), &furthest}, end{text.data() + text.size(), nullptr};
  nlohmann::json::sax_parse(begin, end, &builder, nlohmann::json::input_format_t::json, true, true);
  return std::move(builder.root);
}

}  // namespace reachlab

#include "constraints/formula/parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/names.h"

namespace reachlab::constraints {
namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::optional<Op> functionNamed(std::string_view name) {
  for (int op = static_cast<int>(Op::Sin); op <= static_cast<int>(Op::Sign); ++op)
    if (name == nameOf(static_cast<Op>(op))) return static_cast<Op>(op);
  return std::nullopt;
}

std::vector<std::string> functionNames() {
  std::vector<std::string> names;
  for (int op = static_cast<int>(Op::Sin); op <= static_cast<int>(Op::Sign); ++op) names.emplace_back(nameOf(static_cast<Op>(op)));
  return names;
}

constexpr std::size_t kMaxNameLength = 40;

struct BreaksOff {
  std::size_t position;
  std::string what, allowed;
};

class Parser {
 public:
  Parser(std::string_view text, const FormulaNames& names, ExpressionGraph& graph, std::vector<bool>& used)
      : text_(text), names_(names), graph_(graph), used_(used) {}

  int parse() {
    const int root = sum();
    skipSpaces();
    if (at_ < text_.size()) fail(at_, "unexpected " + here() + "; expected an operator + - * / ^ or the end");
    return root;
  }

 private:
  [[noreturn]] static void fail(std::size_t position, std::string what, std::string allowed = {}) {
    throw BreaksOff{position, std::move(what), std::move(allowed)};
  }

  void skipSpaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) ++at_;
  }
  // What stands at the current place, in words.
  std::string here() const {
    if (at_ >= text_.size()) return "end of the formula";
    std::size_t end = at_ + 1;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0) == 0x80) ++end;
    const unsigned char c = static_cast<unsigned char>(text_[at_]);
    return c < 0x20 || c == 0x7F ? "control character" : "'" + std::string(text_.substr(at_, end - at_)) + "'";
  }
  bool take(char c) {
    skipSpaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c, const char* why) {
    if (!take(c)) fail(at_, "unexpected " + here() + "; expected '" + c + "' " + why);
  }

  struct Nested {
    explicit Nested(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMaxFormulaDepth) fail(parser_.at_, "nested too deeply", std::to_string(kMaxFormulaDepth) + " levels");
    }
    ~Nested() { --parser_.depth_; }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;
    Parser& parser_;
  };

  int sum() {
    int left = product();
    for (;;) {
      if (take('+')) left = graph_.add(left, product());
      else if (take('-')) left = graph_.sub(left, product());
      else return left;
    }
  }
  int product() {
    int left = signedPower();
    for (;;) {
      if (take('*')) {
        if (at_ < text_.size() && text_[at_] == '*') fail(at_, "unexpected '*'; a power is written ^");
        left = graph_.mul(left, signedPower());
      } else if (take('/')) {
        left = graph_.div(left, signedPower());
      } else {
        return left;
      }
    }
  }
  int signedPower() {
    const Nested nested(*this);
    if (take('-')) return graph_.neg(signedPower());
    if (take('+')) return signedPower();
    const int base = primary();
    return take('^') ? graph_.pow(base, signedPower()) : base;
  }
  int primary() {
    skipSpaces();
    if (take('(')) {
      const int inner = sum();
      expect(')', "or an operator");
      return inner;
    }
    if (at_ < text_.size() && (isDigit(text_[at_]) || text_[at_] == '.')) return number();
    if (at_ < text_.size() && isLetter(text_[at_])) return name();
    fail(at_, "unexpected " + here() + "; expected a number, a name, a function or '('");
  }
  int number() {
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument) fail(at_, "unexpected '.'; expected a number such as 0.5");
    if (error != std::errc{} || !std::isfinite(value))
      fail(at_, "the number is beyond what a double holds; expected a magnitude of 1e-308 to 1e308");
    at_ += static_cast<std::size_t>(end - begin);
    if (at_ < text_.size() && (isLetter(text_[at_]) || text_[at_] == '.'))
      fail(at_, "unexpected " + here() + " after a number; expected an operator (multiplication is written *)");
    return graph_.constant(value);
  }
  int name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    if (const auto function = functionNamed(word)) return call(*function, word);
    for (std::size_t i = 0; i < names_.variables.size(); ++i)
      if (word == names_.variables[i]) return checked(graph_.variable(static_cast<int>(i)), word);
    for (std::size_t i = 0; i < names_.parameters.size(); ++i)
      if (word == names_.parameters[i]) {
        used_[i] = true;
        return checked(graph_.parameter(static_cast<int>(i)), word);
      }
    if (word == "pi") return checked(graph_.constant(std::numbers::pi), word);
    if (word == "e") return checked(graph_.constant(std::numbers::e), word);
    unknown(start, word);
  }
  // A name is no function: `a(b)` is most likely a forgotten multiplication.
  int checked(int id, std::string_view word) {
    skipSpaces();
    if (at_ < text_.size() && text_[at_] == '(')
      fail(at_,
           "unexpected '(' after '" + std::string(word) + "', which is no function; expected an operator (multiplication is written *)");
    return id;
  }
  int call(Op function, std::string_view word) {
    const Nested nested(*this);
    expect('(', ("after " + std::string(word)).c_str());
    const int a = sum();
    if (operandCount(function) == 1) {
      skipSpaces();
      if (at_ < text_.size() && text_[at_] == ',') fail(at_, "unexpected ','; " + std::string(word) + " takes one argument");
      expect(')', ("that closes " + std::string(word)).c_str());
      return graph_.apply(function, a);
    }
    expect(',', ("and the second argument of " + std::string(word)).c_str());
    const int b = sum();
    expect(')', ("that closes " + std::string(word)).c_str());
    return graph_.apply(function, a, b);
  }
  [[noreturn]] void unknown(std::size_t start, std::string_view word) {
    std::vector<std::string> known = names_.variables;
    known.insert(known.end(), names_.parameters.begin(), names_.parameters.end());
    known.insert(known.end(), {"pi", "e"});
    std::vector<std::string> choices = known;
    choices.emplace_back("a function");
    const std::string expected = listOf(choices);
    const std::vector<std::string> functions = functionNames();
    known.insert(known.end(), functions.begin(), functions.end());
    std::string shown(word.substr(0, kMaxNameLength));
    fail(start, "unknown name '" + shown + "'; expected " + expected + didYouMean(word, known));
  }

  std::string_view text_;
  const FormulaNames& names_;
  ExpressionGraph& graph_;
  std::vector<bool>& used_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

std::size_t countCharacters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

ParsedFormula parseFormula(std::string_view text, const FormulaNames& names, ExpressionGraph& graph) {
  ParsedFormula result;
  result.used.assign(names.parameters.size(), false);
  if (text.size() > kMaxFormulaCharacters) {
    result.fault = FormulaFault{0, kMaxFormulaCharacters, kMaxFormulaCharacters + 1,
                                "the formula has " + std::to_string(text.size()) + " characters", std::to_string(kMaxFormulaCharacters)};
    return result;
  }
  try {
    result.root = Parser(text, names, graph, result.used).parse();
  } catch (const BreaksOff& fault) {
    result.fault = FormulaFault{0, fault.position, countCharacters(text.substr(0, fault.position)) + 1, fault.what, fault.allowed};
  }
  return result;
}

std::optional<FormulaFault> parameterNameFault(const std::string& name, const std::vector<std::string>& variables) {
  const auto fault = [&](const char* what, const char* allowed) {
    return FormulaFault{-1, 0, 0, "shape." + name.substr(0, kMaxNameLength) + " " + what, allowed};
  };
  if (name.empty() || name.size() > kMaxNameLength || !isLetter(name[0]) ||
      !std::all_of(name.begin(), name.end(), [](char c) { return isLetter(c) || isDigit(c); }))
    return fault("is no name", "a letter, then letters, digits and _, at most 40 characters");
  if (std::find(variables.begin(), variables.end(), name) != variables.end())
    return fault("is the name of the formula's variable", "another name");
  if (name == "phi" || name == "u" || name == "v") return fault("is the name of a variable", "another name");
  if (name == "pi" || name == "e") return fault("is the name of a constant", "another name");
  if (functionNamed(name)) return fault("is the name of a function", "another name");
  return std::nullopt;
}

}  // namespace reachlab::constraints

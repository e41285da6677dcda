#include "base/terminal/command_words.h"

#include <algorithm>
#include <cctype>

#include "base/fault.h"

namespace reachlab {

void refuseEmptyWords(int argc, const char* const* argv) {
  const std::string allowed = "a value, or leave the option out";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], before = argv[i - 1];
    if (word.empty()) throw FaultError(Fault{before.starts_with("--") ? before : "argument " + std::to_string(i), "is empty", allowed});
    if (word.starts_with("--") && word.ends_with('=')) throw FaultError(Fault{word.substr(0, word.size() - 1), "is empty", allowed});
  }
}

namespace {

// "nan" and "inf" would read like defaults and would be recorded.
std::string finiteNumberFault(const std::string& text) {
  std::string word;
  for (const char c : text)
    if (c != '+' && c != '-') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word.starts_with("nan") || word.starts_with("inf") ? "is " + text + "; allowed: a finite number" : std::string();
}

// By zeros in front a library would take 010 for eight.
std::string withoutLeadingZeros(const std::string& text) {
  const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  if (!std::all_of(text.begin() + static_cast<std::ptrdiff_t>(sign), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
    return text;
  const std::size_t first = text.find_first_not_of('0', sign);
  return text.substr(0, sign) + (first == std::string::npos ? (text.size() > sign ? "0" : "") : text.substr(first));
}

}  // namespace

void checkEveryNumber(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (type.find("FLOAT") != std::string::npos)
      option->check(CLI::Validator([](std::string& text) { return finiteNumberFault(text); }, ""));
    if (type.find("INT") == std::string::npos) continue;
    const auto toDecimal = [](std::string& text) {
      text = withoutLeadingZeros(text);
      return std::string();
    };
    option->transform(CLI::Validator(toDecimal, ""));
  }
  for (CLI::App* sub : command.get_subcommands({})) checkEveryNumber(*sub);
}

}  // namespace reachlab

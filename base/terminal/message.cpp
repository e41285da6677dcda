#include "base/terminal/message.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <utility>

namespace reachlab {
namespace {

constexpr std::size_t kColumns = 90;  // of a shown line

struct Sentence {
  std::string problem;
  std::vector<std::string> remedies;  // the proposal first
};

Sentence parted(const std::string& text, const std::string& allowed) {
  Sentence sentence;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find("; ", begin), text.size());
    std::string part = text.substr(begin, end - begin);
    if (begin == 0) sentence.problem = std::move(part);
    else sentence.remedies.push_back(std::move(part));
    begin = end + 2;
  }
  if (!allowed.empty()) sentence.remedies.push_back("allowed: " + allowed);
  std::stable_partition(sentence.remedies.begin(), sentence.remedies.end(),
                        [](const std::string& part) { return part.find("did you mean") != std::string::npos; });
  return sentence;
}

std::string helpOf(const std::vector<std::string>& remedies) {
  std::string help;
  for (std::string part : remedies) {
    if (help.empty()) {
      help = "help: " + std::move(part);
      continue;
    }
    help += help.ends_with('?') || help.ends_with('.') ? " " : ". ";
    part.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(part.front())));
    help += part;
  }
  return help.empty() ? help : help + "\n";
}

bool isContinued(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The characters of a line, each with its bytes. Control characters become blanks.
std::vector<std::string> charactersOf(const std::string& line) {
  std::vector<std::string> characters;
  for (const char c : line) {
    if (isContinued(c) && !characters.empty()) characters.back() += c;
    else characters.emplace_back(1, std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c);
  }
  return characters;
}

/// The line of the file with a caret below the column. A long line is cut on both sides. Empty when there is no such line.
std::string excerptOf(const FilePlace& place) {
  if (place.file.empty() || place.line < 1 || place.column < 1) return {};
  std::ifstream in(place.file, std::ios::binary);
  std::string line;
  for (int i = 0; i < place.line; ++i)
    if (!std::getline(in, line)) return {};
  const std::vector<std::string> characters = charactersOf(line);
  const auto column = static_cast<std::size_t>(place.column) - 1;
  if (column > characters.size()) return {};
  const std::size_t begin = characters.size() <= kColumns || column < 2 * kColumns / 3 ? 0 : column - kColumns / 2;
  const std::size_t end = std::min(begin + kColumns, characters.size());
  std::string shown = begin > 0 ? "…" : "";
  for (std::size_t i = begin; i < end; ++i) shown += characters[i];
  while (shown.ends_with(' ')) shown.pop_back();
  if (end < characters.size()) shown += "…";
  const std::string number = std::to_string(place.line);
  return "  " + number + " | " + shown + "\n" + std::string(number.size() + 2, ' ') + " | " +
         std::string(column - begin + (begin > 0 ? 1 : 0), ' ') + "^\n";
}

}  // namespace

std::string messageOf(const Fault& fault, const std::string& severity) {
  const Sentence sentence = parted(fault.what, fault.allowed);
  Fault head = fault;  // its location and key as everywhere
  head.what.clear(), head.allowed.clear(), head.key.clear();
  std::string message = fault.place && !fault.place->file.empty() ? toText(head) : std::string();
  message += severity + ": ";
  if (fault.place && fault.place->file.empty()) message += toText(Fault{fault.key, {}, {}, fault.place});
  else if (!fault.key.empty()) message += fault.key + ": ";
  message += sentence.problem + "\n";
  if (fault.place) message += excerptOf(*fault.place);
  return message + helpOf(sentence.remedies);
}

std::string messageOf(const std::vector<Fault>& faults) {
  std::string messages;
  for (const Fault& fault : faults) messages += messageOf(fault);
  return messages;
}

std::string messageOf(const std::string& text) {
  std::string messages;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) messages += messageOf(Fault{{}, line});
  return messages;
}

}  // namespace reachlab

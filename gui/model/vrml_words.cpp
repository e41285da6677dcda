#include "gui/model/vrml_words.h"

#include <cmath>

#include "base/as_number.h"

namespace reachlab::gui::model {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; }
bool isBracket(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }

}  // namespace

void VrmlWords::advance() {
  constexpr std::size_t kTellEvery = 4096;
  if (++words_ % kTellEvery == 0 && watch_) watch_(static_cast<double>(at_) / static_cast<double>(text_.size()));
  const auto step = [&] {
    if (text_[at_] == '\n') ++line_, column_ = 1;
    else ++column_;
    ++at_;
  };
  while (at_ < text_.size() && (isBlank(text_[at_]) || text_[at_] == '#')) {
    if (text_[at_] == '#')
      while (at_ < text_.size() && text_[at_] != '\n') step();
    else step();
  }
  wordLine_ = line_, wordColumn_ = column_;
  quoted_ = false;
  if (at_ >= text_.size()) return static_cast<void>(word_ = {});
  const std::size_t first = at_;
  if (text_[at_] == '"') {
    step();
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) step();
      step();
    }
    quoted_ = true;
    word_ = text_.substr(first, at_ + 1 - first);
    if (at_ >= text_.size()) fail({}, "begins a text that never ends", "a closing \"");
    step();
    return;
  }
  if (model::isBracket(text_[at_])) {
    step();
  } else {
    while (at_ < text_.size() && !isBlank(text_[at_]) && !model::isBracket(text_[at_]) && text_[at_] != '#' && text_[at_] != '"') step();
  }
  word_ = text_.substr(first, at_ - first);
}

bool VrmlWords::isBracket() const { return word_.size() == 1 && model::isBracket(word_[0]); }

std::string VrmlWords::take() {
  std::string taken(word_);
  advance();
  return taken;
}

bool VrmlWords::tryTake(std::string_view wanted) {
  if (quoted_ || word_ != wanted) return false;
  advance();
  return true;
}

void VrmlWords::expect(std::string_view wanted, const std::string& within) {
  if (!tryTake(wanted)) fail(within, found(), std::string(wanted));
}

double VrmlWords::number(const std::string& key) {
  std::string_view digits = word_;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto value = asNumber<double>(digits);
  if (quoted_ || !value || !std::isfinite(*value)) fail(key, found(), "a number");
  advance();
  return *value;
}

int VrmlWords::whole(const std::string& key) {
  const auto value = asNumber<int>(word_);
  if (quoted_ || !value) fail(key, found(), "a whole number");
  advance();
  return *value;
}

void VrmlWords::fail(const std::string& key, const std::string& what, const std::string& allowed) const {
  throw FaultError(Fault{key, what, allowed, FilePlace{file_, wordLine_, wordColumn_}});
}

std::string VrmlWords::shown() const {
  constexpr std::size_t kMost = 40;
  std::string words;
  for (const char c : word_.substr(0, kMost)) words += static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126 ? '?' : c;
  return words + (word_.size() > kMost ? "…" : "");
}

}  // namespace reachlab::gui::model

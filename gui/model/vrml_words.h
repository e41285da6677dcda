#pragma once
#include <string>
#include <string_view>

#include "base/fault.h"
#include "gui/model/model.h"

namespace reachlab::gui::model {

/// The tokens of a VRML 2.0 text: names, numbers, "texts", { } [ ]. Comments and commas are blanks.
class VrmlWords {
 public:
  VrmlWords(std::string_view text, std::string file, Watch watch = {}) : text_(text), file_(std::move(file)), watch_(std::move(watch)) {
    advance();
  }

  /// Empty at the end.
  std::string_view word() const { return word_; }
  bool ended() const { return word_.empty(); }
  bool isQuoted() const { return quoted_; }
  /// Takes the word.
  std::string take();
  bool tryTake(std::string_view wanted);
  void expect(std::string_view wanted, const std::string& within);
  double number(const std::string& key);
  int whole(const std::string& key);
  /// Throws FaultError at the word's place.
  [[noreturn]] void fail(const std::string& key, const std::string& what, const std::string& allowed = {}) const;
  /// The word as a person reads it, shortened.
  std::string shown() const;
  /// The fault of a word that is not the expected one: "has 3", or that the text ends here.
  std::string found() const { return ended() ? "ends in the middle" : "has " + shown(); }
  /// One of { } [ ].
  bool isBracket() const;

 private:
  void advance();
  std::string_view text_, word_;
  std::string file_;
  Watch watch_;
  std::size_t at_ = 0, words_ = 0;
  int line_ = 1, column_ = 1, wordLine_ = 1, wordColumn_ = 1;
  bool quoted_ = false;
};

}  // namespace reachlab::gui::model

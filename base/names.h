#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace reachlab {

/// The text as one word of a shell, in quotes where it needs them.
std::string shellWord(const std::string& text);

/// The known name closest to `name` by edit distance, or empty when no name is close.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);
/// "; did you mean NAME?" of the nearest known name, or empty.
std::string didYouMean(std::string_view name, const std::vector<std::string>& known);
/// What a file of an experiment, a plan or a study is called: `chain.v2` of `lab/chain.v2.json` and of `chain.v2`.
std::string nameOfFile(const std::string& path);
/// "a, b or c".
std::string listOf(const std::vector<std::string>& names, const char* last = " or ");

}  // namespace reachlab

#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>

namespace reachlab::cli {

/// A seed is a whole number from 0 to 2^64 - 1; a sign or a larger number would be turned into another seed without a word.
inline CLI::Validator wholeSeed() {
  return {[](std::string& text) {
            std::uint64_t seed = 0;
            const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seed);
            return fault == std::errc{} && end == text.data() + text.size() ? std::string()
                                                                            : "is " + text + "; allowed: 0 to 18446744073709551615";
          },
          "SEED"};
}

}  // namespace reachlab::cli

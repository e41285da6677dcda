#pragma once
#include <cstdint>
#include <string_view>

namespace reachlab {

/// SplitMix64's output function (Steele, Lea, Flood 2014): a good mix of its argument, the same on every machine.
constexpr std::uint64_t mixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// A number that depends on these two alone: the draw for trial i does not depend on the trials before it.
constexpr std::uint64_t seededBits(std::uint64_t seed, std::uint64_t index) { return mixBits(mixBits(seed) ^ mixBits(~index)); }

/// The same in [0, 1).
constexpr double seededFraction(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(seededBits(seed, index) >> 11) * 0x1.0p-53;
}

/// FNV-1a, to turn a label into a number.
constexpr std::uint64_t hashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

}  // namespace reachlab

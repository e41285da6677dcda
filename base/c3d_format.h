#pragma once
#include <cstddef>
#include <cstdint>

/// Constants that the writer and the reader of C3D files share.
namespace reachlab::c3d {

inline constexpr std::size_t kBlock = 512;
inline constexpr std::size_t kMostLabels = 255;                           // of one parameter: its dimensions are bytes
inline constexpr int kCharacters = -1, kByte = 1, kWord = 2, kFloat = 4;  // types of parameters: the bytes of one value
inline constexpr std::size_t kMostEvents = 18;                            // in the header
inline constexpr std::uint16_t kEventKey = 12345;
inline constexpr unsigned char kMagic = 0x50, kIntel = 84, kDec = 85, kMips = 86;

}  // namespace reachlab::c3d

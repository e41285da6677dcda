#pragma once
#include <zlib.h>

#include <cstddef>
#include <cstdint>

namespace reachlab::record {

/// CRC-32.
inline std::uint32_t checksum(const void* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(0, static_cast<const Bytef*>(data), size));
}

}  // namespace reachlab::record

#include "analysis/study/gzip.h"

#include <zlib.h>

#include "base/error.h"

namespace reachlab::study {

std::string gzipMember(std::string_view text) {
  constexpr int kGzip = 16 + MAX_WBITS, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw ResourceError("a table cannot be compressed: no memory");
  std::string packed;
  char piece[1 << 16];
  int state = Z_OK;
  std::size_t taken = 0;
  while (state != Z_STREAM_END) {
    constexpr std::size_t kMost = 1u << 30;
    const std::size_t next = std::min(kMost, text.size() - taken);
    if (stream.avail_in == 0 && next > 0) {
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data() + taken));
      stream.avail_in = static_cast<uInt>(next);
      taken += next;
    }
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    state = deflate(&stream, taken == text.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(piece, sizeof piece - stream.avail_out);
  }
  deflateEnd(&stream);
  return packed;
}

}  // namespace reachlab::study

#include "analysis/study/gzip.h"

#include <zlib.h>

#include <limits>

#include "base/error.h"

namespace reachlab::study {

std::string gzipMember(std::string_view text) {
  constexpr int kGzip = 16 + MAX_WBITS, kMemory = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw ResourceError("a table cannot be compressed: no memory");
  std::string packed(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.avail_out = static_cast<uInt>(packed.size());
  const bool whole = packed.size() <= std::numeric_limits<uInt>::max() && deflate(&stream, Z_FINISH) == Z_STREAM_END;
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (!whole) throw ResourceError("a table cannot be compressed: it has more than 4 GB");
  return packed;
}

}  // namespace reachlab::study

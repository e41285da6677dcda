#pragma once
#include <string>
#include <string_view>

namespace reachlab::study {

/// One gzip member, without a time or a name: the same text gives the same bytes. Members may be put one behind the other (RFC 1952).
std::string gzipMember(std::string_view text);

}  // namespace reachlab::study

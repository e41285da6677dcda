#pragma once
#include <concepts>
#include <type_traits>

namespace reachlab {

/// `Of` or `const Of`: so that one list of members serves for reading and for writing.
template <class T, class Of>
concept MaybeConst = std::same_as<std::remove_const_t<T>, Of>;

}  // namespace reachlab

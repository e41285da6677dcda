#pragma once
#include <span>
#include <string_view>

namespace reachlab::subjects {

/// One number of a virtual subject: its key as an option, and the source of its default.
struct SubjectParameter {
  std::string_view key, unit;
  double usual = 0, least = 0, most = 0;
  bool published = false;  // true: from the source's text or abstract; false: assumed, or fitted by us
  std::string_view meaning, source;
};

/// The numbers of `kind=ofc`, in the order of the documentation.
std::span<const SubjectParameter> feedbackParameters();
/// The numbers of `kind=impedance`.
std::span<const SubjectParameter> impedanceParameters();
/// The numbers of `kind=plan`, the open-loop hand.
std::span<const SubjectParameter> planParameters();

}  // namespace reachlab::subjects

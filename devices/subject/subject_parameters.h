#pragma once
#include <span>
#include <string_view>

namespace reachlab::devices {

/// One number of a virtual subject: its key as an option, and where its default is from.
struct SubjectParameter {
  std::string_view key, unit;
  double usual = 0, least = 0, most = 0;
  bool published = false;  // the source's text or abstract was read; else assumed, or fitted by us
  std::string_view meaning, source;
};

/// Of `kind=ofc`, in the order of the documentation.
std::span<const SubjectParameter> feedbackParameters();
/// Of `kind=impedance`.
std::span<const SubjectParameter> impedanceParameters();
/// Of `kind=plan`, the open-loop hand.
std::span<const SubjectParameter> planParameters();

}  // namespace reachlab::devices

#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/device_options.h"

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

/// The options of a kind, as text. Each number lies within the range of its parameter.
class SubjectOptions : public DeviceOptions {
 public:
  SubjectOptions(const std::string& text, std::span<const SubjectParameter> parameters)
      : DeviceOptions(text, "device simulated"), parameters_(parameters) {}

  /// `otherwise` replaces the parameter's usual value. Throws FaultError.
  double number(std::string_view key, std::optional<double> otherwise = {});
  /// Throws FaultError for keys that were not taken, and for an item without a key.
  void done() const;

 private:
  std::span<const SubjectParameter> parameters_;
};

}  // namespace reachlab::subjects

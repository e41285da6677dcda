#include "sim/predict/numerics/work_limit.h"

#include <fmt/format.h>

#include "base/error.h"

namespace reachlab::predict {
namespace {

constexpr double kMaxWork = 1.5e10;  // multiplications: one to two seconds
constexpr double kMaxNumbers = 3e7;  // 240 MB

}  // namespace

void WorkLimit::spend(double multiplications) {
  spent_ += multiplications;
  if (spent_ > kMaxWork)
    throw RefusedError(
        fmt::format("no minimum was found with {:.1e} multiplications, which is what a prediction may cost; fewer masses, a longer "
                    "time or a way with fewer bends may help",
                    kMaxWork));
}

void WorkLimit::hold(double numbers) {
  if (numbers > kMaxNumbers)
    throw RefusedError(
        fmt::format("this minimum needs {:.1e} numbers at once; allowed: up to {:.0e}; fewer masses, softer springs or a shorter time "
                    "may help",
                    numbers, kMaxNumbers));
}

}  // namespace reachlab::predict

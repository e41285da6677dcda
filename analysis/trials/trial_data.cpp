#include "analysis/trials/trial_data.h"

#include <tuple>

#include "sim/record/log/run_names.h"

namespace reachlab::analysis {

bool recordedBefore(const TrialKey& a, const TrialKey& b) {
  if (a.day != b.day) return a.day < b.day;
  if (a.session != b.session) return record::labelBefore(a.session, b.session);
  return std::tie(a.run, a.trial) < std::tie(b.run, b.trial);
}

}  // namespace reachlab::analysis

#pragma once
#include <vector>

namespace reachlab::analysis {

/// Which of several models is the most frequent among people, when people may differ: random-effects Bayesian model selection
/// (Stephan et al. 2009, NeuroImage 46:1004, and Rigoux et al. 2014, NeuroImage 84:971).
struct ModelSelection {
  std::vector<double> alpha;                // of the Dirichlet posterior of the frequencies; prior 1 each
  std::vector<double> exceedance;           // probability that the model is the most frequent one
  double omnibusRisk = 1;                   // that all are equally frequent (Bayesian omnibus risk)
  std::vector<double> protectedExceedance;  // exceedance (1 - risk) + risk / models
};

/// `logEvidence` [person][model], at least one person and one model. No sampling: the same input gives the same bits. Any thread.
ModelSelection selectModel(const std::vector<std::vector<double>>& logEvidence);

}  // namespace reachlab::analysis

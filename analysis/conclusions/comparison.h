#pragma once
#include <span>
#include <vector>

#include "analysis/measures/statistics.h"

/// Tests and intervals over people, or over one person's trials. Distributions are Boost.Math's. Pure functions for any thread.
namespace reachlab::analysis {

/// Student's t of a mean against 0.
struct TTest {
  double mean = 0, error = 0;  // standard error
  double t = 0, freedom = 0;
  double p = 1;  // two-sided; 1 where there is no scatter to judge by
};

/// One number a person: paired differences, contrasts, slopes. Two or more, else p = 1.
TTest computeTTest(std::span<const double> values);

/// Autocorrelation at lag 1 of values in their order, 0 where it is negative or there are fewer than three.
double computeSerialCorrelation(std::span<const double> values);
/// One person's trials in their order: the number of trials counts as n (1 - rho) / (1 + rho), rho their serial correlation.
TTest computeSerialTTest(std::span<const double> values);
/// The mean of several conditions' means, each judged as above. Degrees of freedom by Welch and Satterthwaite.
TTest combineTTests(std::span<const TTest> conditions);

/// The mean over people of estimates that have a `variance` each, such as shares of few trials. It is judged by t as above. The interval is
/// never narrower, and p never smaller, than those variances alone make it (normal distribution). Otherwise two people whose shares agree
/// by chance would be certain.
struct PeopleMean {
  TTest test;
  Bounds interval;  // infinite for fewer than two people
};
PeopleMean computePeopleMean(std::span<const double> values, std::span<const double> variance, double level = 0.95);

/// Student's t below which the middle `level` of the distribution lies on both sides. `freedom` > 0.
double computeTQuantile(double level, double freedom);

/// The interval of a mean that was tested: mean -+ t * standard error at `level`. Not finite if there is no scatter to judge by.
Bounds intervalOf(const TTest& test, double level = 0.95);

/// The evidence that the mean of a test is not 0 over the evidence that it is: the JZS Bayes factor of Rouder et al. 2009 (Psychon. Bull. Rev.
/// 16:225) for freedom + 1 values, with the scale sqrt(1/2) of the effect. By quadrature, so that the same test gives the same bits. 1 of fewer
/// than two values, and infinite where each is the same number other than 0.
double computeBayesFactor(const TTest& test);

/// mean -+ t * standard error at `level`. Infinite for fewer than two values.
Bounds computeMeanInterval(std::span<const double> values, double level = 0.95);

/// Two-sided p of the mean under exchange of signs: every one of the 2^n up to n = 20. Nothing is assumed but symmetry.
double computeSignFlipP(std::span<const double> values);

/// Holm 1979: p multiplied so that the chance of any false rejection among them all stays below the level. Same order as given.
std::vector<double> adjustByHolm(std::span<const double> p);

}  // namespace reachlab::analysis

// What a prediction along a curve or on a surface says of its own error, on the whole catalogue, against path_reference.tsv: the same
// minimum by Pontryagin's conditions as a boundary value problem (path_reference.py). tests/long/prediction_errors.sh computes that anew.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "base/error.h"
#include "constraints/catalogue/definition.h"
#include "sim/predict/predict.h"
#include "test_paths.h"
#include "tests/predict/objects.h"
#include "tests/refusal.h"

namespace reachlab::predict {
namespace {

constexpr double kTooLow = 3;         // the real error over what is said
constexpr double kReference = 1e-11;  // what the reference has to be known to, of the peak

struct TrueMotion {
  double cost = 0;            // [m^2/s^5]
  double known = 0;           // of the peak
  std::vector<double> speed;  // [m/s] at equal intervals of a second
};

std::map<std::string, TrueMotion> readReference() {
  const char* other = std::getenv("REACHLAB_PATH_REFERENCE");
  std::ifstream file(other != nullptr ? other : REACHLAB_SOURCE_DIR "/tests/predict/path_reference.tsv");
  std::map<std::string, TrueMotion> motions;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    TrueMotion motion;
    words >> name >> motion.cost >> motion.known;
    for (double v = 0; words >> v;) motion.speed.push_back(v);
    motions[name] = motion;
  }
  return motions;
}

TEST(PathError, IsAtMostThriceWhatIsSaidOnTheWholeCatalogue) {
  const std::map<std::string, TrueMotion> truth = readReference();
  ASSERT_GT(truth.size(), 50u);
  int refused = 0;
  for (const constraints::Definition& definition : constraints::catalogue()) {
    SCOPED_TRACE(definition.name);
    experiment::Experiment e = makeChain(1, 1, 600, 1);
    e.constraint = {};
    e.constraint.name = definition.name;
    e.task->start = definition.start;
    e.task->target = definition.target;
    std::unique_ptr<Prediction> p;
    try {
      p = predict(e, Criterion::MinHandJerk, asHand());
    } catch (const RefusedError& reason) {
      EXPECT_TRUE(holds(reason.what(), "cusp"));
      ++refused;
      continue;
    }
    ASSERT_TRUE(truth.contains(definition.name)) << "no reference: what it says of itself is not known to be true";
    const TrueMotion& real = truth.at(definition.name);
    double error = 0, peak = 0;
    for (std::size_t i = 0; i < real.speed.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(real.speed.size() - 1);
      peak = std::max(peak, real.speed[i]);
      error = std::max(error, std::abs(p->handAt(t).velocity - real.speed[i]));
    }
    ASSERT_GT(peak, 0);
    error /= peak;
    const double said = p->profileError.value_or(1e-12), most = kTooLow * said + 2 * real.known;
    std::printf("[ measured ] %-28s error %.1e, said %.1e; cost off by %.1e\n", definition.name.c_str(), error, said,
                p->cost / real.cost - 1);
    EXPECT_LE(real.known, kReference);
    EXPECT_LE(error, most);
    // A minimum's cost is off by the square of the profile's error; rounding is left.
    EXPECT_NEAR(p->cost / real.cost, 1, std::max(1e-10, 1e3 * said * said));
  }
  EXPECT_LT(refused, 10);
}

}  // namespace
}  // namespace reachlab::predict

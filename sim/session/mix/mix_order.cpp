#include "sim/session/mix/mix_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "base/math/seeded.h"

namespace reachlab::session {
namespace {

constexpr std::uint64_t kKindStream = 0x6b696e64, kTargetStream = 0x74617267;  // draws that have nothing to do with each other

/// Draws in a row that depend on the seed alone.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t stream) : seed_(seed ^ stream) {}
  int below(int count) { return static_cast<int>(seededBits(seed_, next_++) % static_cast<std::uint64_t>(count)); }

 private:
  std::uint64_t seed_, next_ = 0;
};

int placeOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The rules of an order, by number of kind.
struct Rules {
  std::vector<bool> notFirst, notTwice;
  Rules(const TrialMix& mix, const std::vector<std::string>& kinds) : notFirst(kinds.size()), notTwice(kinds.size()) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      notFirst[k] = std::find(mix.notFirst.begin(), mix.notFirst.end(), kinds[k]) != mix.notFirst.end();
      notTwice[k] = std::find(mix.notTwice.begin(), mix.notTwice.end(), kinds[k]) != mix.notTwice.end();
    }
  }
};

// The kinds that may come next, so that the rest of the cycle can still be done. A kind that may not follow itself fits into the rest when
// each of its trials has a trial of another kind before it. The first one may do without, unless the trial before the rest is of this kind.
std::vector<int> choices(const std::vector<int>& left, const Rules& rules, int before, bool first) {
  const int total = std::accumulate(left.begin(), left.end(), 0);
  const auto crowds = [&](std::size_t k, int others) { return rules.notTwice[k] && left[k] > others; };
  int crowding = 0;  // kinds that only they themselves may be followed by
  for (std::size_t k = 0; k < left.size(); ++k) crowding += crowds(k, total - left[k]);
  std::vector<int> found;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const int kind = static_cast<int>(k);
    if (left[k] == 0 || (first && rules.notFirst[k]) || (kind == before && rules.notTwice[k])) continue;
    if (crowding == crowds(k, total - left[k]) && !crowds(k, total - left[k] + 1)) found.push_back(kind);
  }
  return found;
}

// How many trials of each kind are shuffled together: those of a cycle, or of the whole block.
std::vector<int> countsTogether(const TrialMix& mix, const std::vector<std::string>& kinds, int trials) {
  std::vector<int> counts(kinds.size(), 0);
  for (const KindCount& some : cycleOf(mix)) counts[static_cast<std::size_t>(placeOf(kinds, some.kind))] += some.count;
  const int cycles = mix.order == TrialOrder::Shuffled ? trials / std::accumulate(counts.begin(), counts.end(), 0) : 1;
  for (int& count : counts) count *= cycles;
  return counts;
}

std::vector<int> asWritten(const std::vector<KindCount>& cycle, const std::vector<std::string>& kinds, int trials) {
  std::vector<int> once, all;
  for (const KindCount& some : cycle) once.insert(once.end(), static_cast<std::size_t>(some.count), placeOf(kinds, some.kind));
  for (int i = 0; i < trials; ++i) all.push_back(once[static_cast<std::size_t>(i) % once.size()]);
  return all;
}

std::vector<int> orderKinds(const TrialMix& mix, const std::vector<std::string>& kinds, int trials, std::uint64_t seed) {
  if (mix.kinds.empty()) return std::vector<int>(static_cast<std::size_t>(trials), 0);
  if (mix.order == TrialOrder::AsWritten) return asWritten(cycleOf(mix), kinds, trials);
  const std::vector<int> counts = countsTogether(mix, kinds, trials);
  const Rules rules(mix, kinds);
  Draws draws(seed, kKindStream);
  std::vector<int> order;
  std::vector<int> left = counts;
  while (static_cast<int>(order.size()) < trials) {
    if (std::all_of(left.begin(), left.end(), [](int n) { return n == 0; })) left = counts;
    const std::vector<int> may = choices(left, rules, order.empty() ? -1 : order.back(), order.empty());
    int among = 0;
    for (const int kind : may) among += left[static_cast<std::size_t>(kind)];
    int drawn = draws.below(among);  // in proportion to what is left: without rules every order is as likely
    for (const int kind : may) {
      drawn -= left[static_cast<std::size_t>(kind)];
      if (drawn >= 0) continue;
      order.push_back(kind);
      --left[static_cast<std::size_t>(kind)];
      break;
    }
  }
  return order;
}

// In each run through the targets the rarest kind chooses first, among the targets that it had least often.
std::vector<int> orderTargets(const TrialMix& mix, const std::vector<int>& kinds, std::size_t kindCount, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(mix.targetCount());
  std::vector<int> order(kinds.size(), 0);
  if (mix.order == TrialOrder::AsWritten) {
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i % count);
    return order;
  }
  std::vector<int> often(kindCount, 0);
  for (const int kind : kinds) ++often[static_cast<std::size_t>(kind)];
  const std::size_t stretch = mix.order == TrialOrder::Shuffled ? kinds.size() : count;
  std::vector<std::vector<int>> met(kindCount, std::vector<int>(count, 0));
  Draws draws(seed, kTargetStream);
  for (std::size_t begin = 0; begin < order.size(); begin += stretch) {
    std::vector<int> left(count, static_cast<int>(stretch / count));
    std::vector<std::size_t> places(stretch);
    std::iota(places.begin(), places.end(), begin);
    std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return often[static_cast<std::size_t>(kinds[a])] < often[static_cast<std::size_t>(kinds[b])];
    });
    for (const std::size_t place : places) {
      std::vector<int>& had = met[static_cast<std::size_t>(kinds[place])];
      std::vector<std::size_t> best;
      for (std::size_t t = 0; t < count; ++t) {
        if (left[t] == 0 || (!best.empty() && had[t] > had[best.front()])) continue;
        if (!best.empty() && had[t] < had[best.front()]) best.clear();
        best.push_back(t);
      }
      const std::size_t target = best[static_cast<std::size_t>(draws.below(static_cast<int>(best.size())))];
      order[place] = static_cast<int>(target);
      --left[target];
      ++had[target];
    }
  }
  return order;
}

}  // namespace

std::vector<MixedTrial> orderTrials(const TrialMix& mix, int trials, std::uint64_t seed) {
  const std::vector<std::string> names = kindsInUse(mix);
  const std::vector<int> kinds = orderKinds(mix, names, trials, seed);
  const std::vector<int> targets = orderTargets(mix, kinds, names.size(), seed);
  std::vector<MixedTrial> order;
  for (std::size_t i = 0; i < kinds.size(); ++i) order.push_back({kinds[i], targets[i]});
  return order;
}

std::optional<Fault> orderFault(const TrialMix& mix, int trials) {
  if (mix.kinds.empty()) return std::nullopt;
  const std::vector<std::string> kinds = kindsInUse(mix);
  const Rules rules(mix, kinds);
  if (mix.order == TrialOrder::AsWritten) {
    const std::vector<int> written = asWritten(cycleOf(mix), kinds, trials);
    if (rules.notFirst[static_cast<std::size_t>(written.front())])
      return Fault{"not_first",
                   fmt::format("forbids {} as the first trial, and the mix is written with it first",
                               kinds[static_cast<std::size_t>(written.front())]),
                   "a mix that begins with another kind, or a shuffled order"};
    for (std::size_t i = 1; i < written.size(); ++i) {
      if (written[i] != written[i - 1] || !rules.notTwice[static_cast<std::size_t>(written[i])]) continue;
      return Fault{"not_twice",
                   fmt::format("forbids {} twice in a row, and the mix as written has it so in trials {} and {}",
                               kinds[static_cast<std::size_t>(written[i])], i, i + 1),
                   "a mix that keeps them apart, or a shuffled order"};
    }
    return std::nullopt;
  }
  const std::vector<int> counts = countsTogether(mix, kinds, trials);
  const int total = std::accumulate(counts.begin(), counts.end(), 0);
  const int most = trials > total ? total / 2 : (total + 1) / 2;  // the next cycle may begin with any kind
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (!rules.notTwice[k] || counts[k] <= most) continue;
    return Fault{"not_twice",
                 fmt::format("keeps {} from following itself, which no order can do: it is {} of {} trials of {}", kinds[k], counts[k],
                             total, mix.order == TrialOrder::Shuffled ? "the block" : "a cycle"),
                 fmt::format("at most {} of them, or {} without not_twice", most, kinds[k])};
  }
  if (choices(counts, rules, -1, true).empty())
    return Fault{"not_first", "leaves no kind that the block can begin with", "at least one kind of the mix that may be first"};
  return std::nullopt;
}

}  // namespace reachlab::session

#include "sim/predict/panel_profile.h"

#include <algorithm>
#include <cmath>

namespace reachlab::predict {
namespace {

using Vector = std::vector<double>;

// Forwards in time: the last panel becomes the first and odd terms change sign.
std::vector<Pack> reverse(const std::vector<Pack>& control, int blocks, int terms) {
  const size_t given = control.size() / static_cast<size_t>(blocks);
  std::vector<Pack> forward(static_cast<size_t>(blocks) * terms);
  for (int block = 0; block < blocks; ++block)
    for (int k = 0; k < terms && static_cast<size_t>(k) < given; ++k) {
      const Pack& from = control[static_cast<size_t>(blocks - 1 - block) * given + k];
      Pack& to = forward[static_cast<size_t>(block) * terms + k];
      for (int lane = 0; lane < kPack; ++lane) to[lane] = k % 2 ? -from[kPack - 1 - lane] : from[kPack - 1 - lane];
    }
  return forward;
}

// Each output by its few differences from the one before: neighbours in a chain share most of their row.
struct Difference {
  int output, state;  // state n is the control
  double factor;
};
std::vector<Difference> makeDifferences(const LineSystem<double>& system) {
  std::vector<Difference> differences;
  for (size_t o = 0; o < system.output.size(); ++o)
    for (int i = 0; i <= system.size; ++i) {
      const double factor = system.output[o][i] - (o > 0 ? system.output[o - 1][i] : 0.0);
      if (factor != 0) differences.push_back({static_cast<int>(o), i, factor});
    }
  return differences;
}

class Follower {
 public:
  Follower(const LineSystem<double>& system, const PanelGrid& grid, const PanelStep<double>& step, int terms,
           const std::vector<Pack>& control)
      : system_(system), grid_(grid), step_(step), n_(system.size), terms_(terms), control_(reverse(control, grid.blocks(), terms)),
        rows_(system, n_, false), drive_(system.b), taylor_(inverseFactorials<double>(terms)), states_(static_cast<size_t>(terms) * n_),
        middle_(static_cast<size_t>(grid.blocks()) * n_) {
    rows_.scale(grid.halfWidth);
    for (double& b : drive_) b *= grid.halfWidth;
  }

  LeastEffort run() {
    LeastEffort effort;
    effort.fastest = grid_.rate / grid_.halfWidth;
    findMiddles(effort);
    SeriesProfile& profile = effort.profile;
    profile.outputs = static_cast<int>(system_.output.size());
    profile.terms = terms_;
    profile.panels = grid_.panels;
    profile.width = 2 * grid_.halfWidth;
    profile.centre = 0.5;
    profile.coefficient.resize(static_cast<size_t>(profile.panels) * profile.outputs * terms_);
    const std::vector<Difference> differences = makeDifferences(system_);
    for (int block = 0; block < grid_.blocks(); ++block) {
      expand(block, &middle_[static_cast<size_t>(block) * n_]);
      writeOutputs(block, differences, profile);
    }
    return effort;
  }

 private:
  const Pack* controlOf(int block) const { return &control_[static_cast<size_t>(block) * terms_]; }

  void expand(int block, const Pack* middle) {
    if (middle != nullptr) std::copy_n(middle, n_, states_.begin());
    else std::fill_n(states_.begin(), n_, Pack{});
    expandPanels<double>(rows_, n_, terms_, states_.data(), drive_.data(), controlOf(block));
  }

  // The states in the middle of each panel, so that neighbours agree where they meet: q, the motion from zero in the middle under
  // the control alone, tells what the control adds until either end.
  void findMiddles(LeastEffort& effort) {
    Vector middle(n_, 0.0), gap(n_), end(n_, 0.0), border(n_);
    for (int block = 0; block < grid_.blocks(); ++block) {
      expand(block, nullptr);
      std::vector<Pack> atBegin(n_), atEnd(n_);
      for (int i = 0; i < n_; ++i) {
        Pack even{}, odd{};
        for (int k = terms_ - 1; k > 0; --k) addProduct(k % 2 ? odd : even, taylor_[k], states_[static_cast<size_t>(k) * n_ + i]);
        atEnd[i] = even + odd, atBegin[i] = even - odd;
      }
      for (int lane = 0; lane < kPack; ++lane) {
        for (int i = 0; i < n_; ++i) gap[i] = end[i] - atBegin[i][lane], end[i] = atEnd[i][lane];
        step_.apply(middle, border);
        for (int i = 0; i < n_; ++i) border[i] += gap[i];
        step_.apply(border, middle);
        for (int i = 0; i < n_; ++i) {
          middle_[static_cast<size_t>(block) * n_ + i][lane] = middle[i];
        }
      }
    }
    step_.apply(middle, border);
    for (int i = 0; i < system_.controlled; ++i) effort.miss = std::max(effort.miss, std::abs(border[i] + end[i] - system_.target[i]));
  }

  void writeOutputs(int block, const std::vector<Difference>& differences, SeriesProfile& profile) const {
    for (int k = 0; k < terms_; ++k) {
      Pack position{};
      const double unit = std::ldexp(taylor_[k], k);  // the profile counts in whole panels
      auto next = differences.begin();
      for (int o = 0; o < profile.outputs; ++o) {
        for (; next != differences.end() && next->output == o; ++next)
          position += next->factor * (next->state < n_ ? states_[static_cast<size_t>(k) * n_ + next->state] : controlOf(block)[k]);
        for (int lane = 0; lane < kPack; ++lane)
          profile.coefficient[(static_cast<size_t>(block * kPack + lane) * profile.outputs + o) * terms_ + k] = unit * position[lane];
      }
    }
  }

  const LineSystem<double>& system_;
  const PanelGrid& grid_;
  const PanelStep<double>& step_;
  int n_, terms_;
  std::vector<Pack> control_;
  SparseRows<double> rows_;
  Vector drive_, taylor_;
  std::vector<Pack> states_;  // of one block, [term][state]
  std::vector<Pack> middle_;  // [block][state]
};

}  // namespace

LeastEffort followControl(const LineSystem<double>& system, const PanelGrid& grid, const PanelStep<double>& step, int terms,
                          const std::vector<Pack>& control) {
  return Follower(system, grid, step, terms, control).run();
}

}  // namespace reachlab::predict

#pragma once
#include <array>
#include <cstddef>

#include "gui/widgets/colours.h"

namespace reachlab::gui::scene {

/// Colours of several hands, by their number from 0. The first hand is white, as a single hand is. Further hands have colours that no mass
/// has (after Okabe and Ito).
inline const widgets::Colour& handColour(std::size_t hand) {
  static constexpr std::array<widgets::Colour, 8> kHands{{widgets::colours::kHand,
                                                          {0.90, 0.52, 0.76},
                                                          {0.95, 0.90, 0.35},
                                                          {0.10, 0.75, 0.58},
                                                          {0.45, 0.78, 0.98},
                                                          {0.93, 0.45, 0.10},
                                                          {0.62, 0.55, 0.95},
                                                          {0.60, 0.60, 0.62}}};
  return kHands[hand % kHands.size()];
}

}  // namespace reachlab::gui::scene

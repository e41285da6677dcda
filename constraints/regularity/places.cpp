#include "constraints/regularity/places.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::constraints {

const char* nameOf(PlaceKind kind) {
  static constexpr const char* kNames[] = {"kink", "bend", "hole", "jump", "pole", "end", "spike", "cusp", "fold", "standstill"};
  return kNames[static_cast<int>(kind)];
}

bool isPassed(PlaceKind kind) {
  return kind != PlaceKind::Jump && kind != PlaceKind::Pole && kind != PlaceKind::End && kind != PlaceKind::Spike;
}

std::string describe(const Place& place, ConstraintKind kind) {
  const char* name = kind == ConstraintKind::Curve ? "phi" : place.parameter == 0 ? "u" : "v";
  return place.parameter < 0 ? fmt::format("{} along {} = 0", nameOf(place.kind), place.because)
                             : fmt::format("{} at {} = {:.9g}: {}", nameOf(place.kind), name, place.at, place.because);
}

int CurveRegularity::pieceAt(double phi) const {
  for (std::size_t i = pieces.size(); i-- > 0;)
    if (phi >= pieces[i].lo && phi <= pieces[i].hi) return static_cast<int>(i);
  return -1;
}

double CurveRegularity::reachFrom(double phi, bool upwards) const noexcept {
  // A step may end within a place, if it leads into it no farther than the place allows.
  double reach = std::numeric_limits<double>::infinity();
  const auto above =
      std::upper_bound(narrow.begin(), narrow.end(), phi, [](double value, const NarrowPlace& place) { return value < place.lo; });
  if (upwards) {
    for (auto place = above == narrow.begin() ? above : above - 1; place != narrow.end() && place->lo - phi < reach; ++place)
      if (place->hi > phi) reach = std::min(reach, std::max(place->lo - phi, 0.0) + place->reach);
  } else {
    for (auto place = above; place != narrow.begin() && phi - (place - 1)->hi < reach; --place)
      reach = std::min(reach, std::max(phi - (place - 1)->hi, 0.0) + (place - 1)->reach);
  }
  return reach;
}

std::vector<Place> placesBetween(const CurveRegularity& regularity, double from, double to) {
  std::vector<Place> between;
  for (const Place& place : regularity.places)
    if (place.at > std::min(from, to) && place.at < std::max(from, to)) between.push_back(place);
  return between;
}

}  // namespace reachlab::constraints

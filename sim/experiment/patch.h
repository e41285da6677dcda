#pragma once
#include <compare>
#include <span>
#include <string>
#include <vector>

#include "base/json/json_reader.h"

namespace reachlab::experiment {

/// One change to a file: `coupling.stiffness_n_per_m`, `object.masses_kg[2]` (from 0), `object.masses_kg[*]` (each element).
struct Patch {
  std::string path;
  std::string value;  // as JSON

  friend auto operator<=>(const Patch&, const Patch&) = default;
};

/// The changes of an object { "PATH": value, … } in its order. `key` is the key of the object. Paths are not checked before patchedText.
std::vector<Patch> readPatches(const JsonNode& node, const std::string& key, FaultList& faults);
/// A node as JSON, in one line.
std::string valueText(const JsonNode& node);

/// Whether two paths name a common value: `masses_kg[0]` and `masses_kg[*]`, or `object` and `object.kind`. False where patchedText refuses
/// one of them.
bool nameOneValue(const std::string& one, const std::string& other);

/// The file's text with these changes and without comments. A missing key is added, so that the file's reader judges it. A missing
/// element of a list is refused. Throws FaultError under the patch's path.
std::string patchedText(const std::string& text, const std::string& file, std::span<const Patch> patches);

}  // namespace reachlab::experiment

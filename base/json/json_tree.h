#pragma once
#include <string>
#include <utility>
#include <vector>

namespace reachlab {

/// A JSON value that remembers where it stood, so that a fault can name line and column. Parsed by nlohmann-json (comments allowed).
struct JsonNode {
  enum class Kind { Null, Boolean, Number, String, Array, Object };
  Kind kind = Kind::Null;
  bool boolean = false;
  double number = 0;
  bool integer = false;  // written without fraction and exponent
  std::string string;
  std::vector<JsonNode> items;                            // Array
  std::vector<std::pair<std::string, JsonNode>> members;  // Object, in file order
  int line = 0, column = 0;                               // from 1, of the first character
  int keyLine = 0, keyColumn = 0;                         // of the key, for a member of an object

  JsonNode();  // in the .cpp: clang 14 can't form it here, where the members' pair is incomplete
  const JsonNode* find(const std::string& key) const;
};
const char* nameOf(JsonNode::Kind kind);

/// Throws FaultError with its place on the first syntax fault, duplicate key or number beyond the range of a double.
JsonNode parseJson(const std::string& text, const std::string& file);

}  // namespace reachlab

#include "base/json_tree.h"

#include <gtest/gtest.h>

#include "base/fault.h"

namespace reachlab {
namespace {

void expectAtItsPlace(const JsonNode& node, const std::vector<std::string>& lines) {
  const std::string& line = lines[static_cast<std::size_t>(node.line - 1)];
  const std::string rest = line.substr(static_cast<std::size_t>(node.column - 1));
  const char* begin[] = {"null", node.boolean ? "true" : "false", "", "\"", "[", "{"};
  if (node.kind == JsonNode::Kind::Number) {
    ASSERT_GE(node.column, 2);
    EXPECT_NE(std::string(" [").find(line[static_cast<std::size_t>(node.column - 2)]), std::string::npos)
        << "not its first character: " << rest;
    EXPECT_EQ(std::stod(rest), node.number);
  } else {
    EXPECT_TRUE(rest.starts_with(begin[static_cast<int>(node.kind)])) << nameOf(node.kind) << ": " << rest;
  }
  for (const JsonNode& item : node.items) expectAtItsPlace(item, lines);
  for (const auto& [key, member] : node.members) {
    EXPECT_TRUE(
        lines[static_cast<std::size_t>(member.keyLine - 1)].substr(static_cast<std::size_t>(member.keyColumn - 1)).starts_with('"' + key));
    expectAtItsPlace(member, lines);
  }
}

TEST(JsonTree, IsOneValueAndNothingAfterIt) {
  for (const char* text : {"{} {}", "1 2", "[] ]", "{}x", "null,"}) EXPECT_THROW((void)parseJson(text, "made.json"), FaultError) << text;
  EXPECT_EQ(parseJson("{} // a remark\n", "made.json").kind, JsonNode::Kind::Object);
}

// A fault is told by line and column, so that every value, of whatever kind and form, is where its first character stands.
TEST(JsonTree, KnowsWhereEachValueBegins) {
  const std::vector<std::string> lines{"{ // a remark", R"(  "whole": 12, "below": -3, "part": 0.25, "small": 1e-3, "great": -2.5E+3,)",
                                       R"(  "yes": true, "no": false, "none": null, "word": "a \"b\" c",)",
                                       R"(  "list": [-1, 0.5, [true, "x"], {"in": -7}])", "}"};
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  const JsonNode root = parseJson(text, "made.json");
  ASSERT_EQ(root.members.size(), 10u);
  expectAtItsPlace(root, lines);
  EXPECT_TRUE(root.find("yes")->boolean);
  EXPECT_FALSE(root.find("no")->boolean);
  EXPECT_EQ(root.find("great")->number, -2500);
  EXPECT_EQ(root.find("word")->string, "a \"b\" c");
  EXPECT_TRUE(root.find("below")->integer);
  EXPECT_FALSE(root.find("small")->integer);
}

}  // namespace
}  // namespace reachlab

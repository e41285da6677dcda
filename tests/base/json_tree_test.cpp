#include "base/json/json_tree.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/text_file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace reachlab {
namespace {

void expectAtItsPlace(const JsonNode& node, const std::vector<std::string>& lines) {
  const std::string& line = lines[static_cast<std::size_t>(node.line - 1)];
  const std::string rest = line.substr(static_cast<std::size_t>(node.column - 1));
  const char* begin[] = {"null", node.boolean ? "true" : "false", "", "\"", "[", "{"};
  if (node.kind == JsonNode::Kind::Number) {
    ASSERT_GE(node.column, 2);
    EXPECT_TRUE(holds(" [", line.substr(static_cast<std::size_t>(node.column - 2), 1))) << "not its first character: " << rest;
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

Fault faultOf(const std::string& text) {
  const std::vector<Fault> told = faultsToldBy([&] { (void)parseJson(text, "made.json"); });
  return told.size() == 1 ? told[0] : Fault{.what = "read"};
}

TEST(JsonTree, TellsWhereASentenceOfItsSyntaxBreaks) {
  const Fault fault = faultOf("{\n  \"a\": ,\n}");
  EXPECT_EQ(fault.place, (FilePlace{"made.json", 2, 8}));
  EXPECT_EQ(toText(fault), "made.json:2:8: this is not a value; allowed: a number, true, false, null, text in double quotes, [ or {");
  EXPECT_EQ(faultOf("").place, (FilePlace{"made.json", 1, 1}));
  EXPECT_EQ(faultOf("x").place, (FilePlace{"made.json", 1, 1}));
}

// No text of the library, and one sentence for each way in which a text is no JSON.
TEST(JsonTree, TellsEachFaultOfSyntaxInItsOwnSentence) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "the text ends before the value is complete"},
      {"{\"a\":\n[1", "the text ends before the value is complete; the bracket of line 2 is not closed"},
      {"[\"a", "a string is not closed before the end of the text"},
      {"[\"a\n\"]", "a string contains a control character, such as the end of its line"},
      {"[\"\xE9\"]", "a string contains bytes that are not UTF-8"},
      {R"(["\d"])", "this character has no meaning after a backslash"},
      {R"(["\u12"])", "an escaped character is not complete"},
      {R"(["\uD834"])", "half of a pair of escaped characters is missing"},
      {"\xEF{}", "the mark at the beginning of the text is not complete"},
      {"{} /* x", "this comment is not complete"},
      {"[-]", "this number is not complete"},
      {"[1.]", "this number is not complete"},
      {"{a: 1}", "a key is missing here"},
      {"{1: 1}", "a key is missing here"},
      {"{\"a\" 1}", "a colon is missing behind the key"},
      {"{\"a\": 1 \"b\": 2}", "a comma or a closing bracket is missing here"},
      {"[1 2]", "a comma or a closing bracket is missing here"},
      {"[1, 2}", "a comma or a closing bracket is missing here"},
      {"{} {}", "the text continues behind its closing bracket"},
      {"[yes]", "this is not a value"},
      {"['; expected ':']", "this is not a value"}};
  for (const auto& [text, what] : cases) {
    const Fault fault = faultOf(text);
    EXPECT_EQ(fault.what, what) << text;
    EXPECT_NE(fault.allowed, "") << text;
  }
}

TEST(JsonTree, NamesACommaBehindTheLastElement) {
  for (const char* text : {"[1,\n  2 ,\n]", "{\"a\": [1],\n  \"\": 2 ,  }"}) {
    const Fault fault = faultOf(text);
    EXPECT_EQ(fault.what, "this comma has nothing behind it") << text;
    EXPECT_EQ(fault.place->line, 2) << text;
    EXPECT_EQ(text[std::string(text).find('\n') + static_cast<std::size_t>(fault.place->column)], ',') << text;
  }
}

TEST(JsonTree, RefusesANumberThatNoDoubleHolds) {
  EXPECT_EQ(toText(faultOf("[1,\n 22, 1e999]")), "made.json:2:6: this number is beyond the range of a double; allowed: finite numbers");
  EXPECT_EQ(parseJson("1.7976931348623157e308", "made.json").number, std::numeric_limits<double>::max());
}

TEST(JsonTree, HasEachKeyOnceInEachObject) {
  EXPECT_EQ(toText(faultOf("{\"a\": 1,\n \"b\": 2, \"a\": 3}")), "made.json:2:10: a: stands here twice; allowed: each key once");
  const JsonNode root = parseJson(R"({"a": {"b": 1, "c": 2}, "b": {"b": 3}, "c": [{"a": 4}, {"a": 5}]})", "made.json");
  EXPECT_EQ(root.find("b")->find("b")->number, 3);
  EXPECT_EQ(root.find("c")->items[1].find("a")->number, 5);
  EXPECT_EQ(root.find("d"), nullptr);
}

TEST(JsonTree, IsSixtyFourLevelsDeepAtMost) {
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  EXPECT_EQ(faultOf(nested(64)).what, "read");
  EXPECT_EQ(toText(faultOf(nested(65))), "made.json:1:65: nested too deeply; allowed: 64 levels");
}

// A column counts characters, not bytes; a quote behind a backslash ends no string, one behind two does.
TEST(JsonTree, CountsCharactersAndReadsEscapes) {
  const JsonNode root = parseJson(R"(["äöü€", "a\\", "\"", "\\\"x", 7])", "made.json");
  const std::vector<int> columns{2, 10, 17, 23, 32};
  ASSERT_EQ(root.items.size(), columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) EXPECT_EQ(root.items[i].column, columns[i]) << i;
  EXPECT_EQ(root.items[1].string, "a\\");
  EXPECT_EQ(root.items[3].string, "\\\"x");
  for (const char* first : {"\"x\"", "\"\"", "7", "12 ", "null", "[]"}) EXPECT_EQ(parseJson(first, "made.json").column, 1) << first;
}

std::string refusalOfFile(const std::string& file, std::uintmax_t most) {
  std::string read;
  const std::string refusal = refusalOf<FaultError>([&] { read = "read " + readTextFile(file, most); });
  return read.empty() ? refusal : read;
}

TEST(TextFile, IsReadWholeOrRefusedInWords) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.txt", "one\r\ntwo");
  EXPECT_EQ(refusalOfFile(file, 8), "read one\r\ntwo");
  EXPECT_EQ(refusalOfFile(file, 7), file + ": has 8 bytes; allowed: up to 7");
  folder.write("a.txt", "");
  EXPECT_EQ(refusalOfFile(file, 8), "read ") << "an empty file is one, too";
  EXPECT_EQ(refusalOfFile(folder / "b.txt", 8), (folder / "b.txt").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(refusalOfFile(folder.path(), 8), folder.path() + ": cannot be read: Is a directory");
  EXPECT_EQ(refusalOfFile("/dev/zero", 8), "/dev/zero: is no regular file; allowed: a file on a disk");
  EXPECT_EQ(kMostTextBytes, 16u * 1024 * 1024);
}

}  // namespace
}  // namespace reachlab

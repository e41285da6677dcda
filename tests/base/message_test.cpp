#include "base/terminal/message.h"

#include <gtest/gtest.h>

#include "tests/in_a_folder.h"

namespace reachlab {
namespace {

class Message : public InAFolder {};

TEST_F(Message, OfAFileHasItsLineACaretAndHelp) {
  const std::string file = folder_.write("f", "{\n  \"masses_kg\": [0.6, -1]\n}\n");
  EXPECT_EQ(messageOf(Fault{"object.masses_kg[1]", "is -1", "more than 0 kg", FilePlace{file, 2, 22}}),
            file +
                ":2:22: error: object.masses_kg[1]: is -1\n"
                "  2 |   \"masses_kg\": [0.6, -1]\n"
                "    |                      ^\n"
                "help: allowed: more than 0 kg\n");
}

TEST_F(Message, SaysTheProposalBeforeWhatIsAllowed) {
  EXPECT_EQ(messageOf(Fault{"lenght", "is not known here; did you mean length?", "height or length"}),
            "error: lenght: is not known here\nhelp: did you mean length? Allowed: height or length\n");
  EXPECT_EQ(messageOf(Fault{"curve[1]", "unknown name 'b'; expected phi or a; did you mean a?"}),
            "error: curve[1]: unknown name 'b'\nhelp: did you mean a? Expected phi or a\n");
}

TEST_F(Message, LeavesOutThePartsThatAreNotThere) {
  EXPECT_EQ(messageOf(Fault{"", "is empty", "", FilePlace{"study.json"}}), "study.json: error: is empty\n");
  EXPECT_EQ(messageOf(Fault{"--age", "is 200", "0 to 130 years"}), "error: --age: is 200\nhelp: allowed: 0 to 130 years\n");
  EXPECT_EQ(messageOf(Fault{"curve[1]", "ends", "a term", FilePlace{"", 1, 5}}),
            "error: curve[1], character 5: ends\nhelp: allowed: a term\n");
  EXPECT_EQ(messageOf(Fault{"a", "is 1", "", FilePlace{"/not/there.json", 2, 3}}), "/not/there.json:2:3: error: a: is 1\n");
  const std::string file = folder_.write("f", "{}\n");
  EXPECT_EQ(messageOf(Fault{"a", "is 1", "", FilePlace{file, 7, 1}}), file + ":7:1: error: a: is 1\n") << "a line that is not there";
  EXPECT_EQ(messageOf(Fault{"task", "is long", "", FilePlace{"e.json", 0, 0}}, "warning"), "e.json: warning: task: is long\n");
}

TEST_F(Message, OfASentenceEndsWithItsRemedies) {
  EXPECT_EQ(messageOf(std::string("the object is too stiff; allowed: up to 1e6 N/m")),
            "error: the object is too stiff\nhelp: allowed: up to 1e6 N/m\n");
  EXPECT_EQ(messageOf(std::string("a: is 1\nb: is 2; use 3")), "error: a: is 1\nerror: b: is 2\nhelp: use 3\n");
}

// Columns count characters, and a caret below a letter of two bytes stands where the letter stands.
TEST_F(Message, PointsAtCharactersAndNotAtBytes) {
  const std::string file = folder_.write("f", "\t\"größe\": 7");
  EXPECT_EQ(messageOf(Fault{"größe", "is 7", "", FilePlace{file, 1, 11}}),
            file + ":1:11: error: größe: is 7\n  1 |  \"größe\": 7\n    |           ^\n");
}

TEST_F(Message, CutsALongLineAroundItsCaret) {
  std::string text(1001, 'b');
  text.replace(0, 501, std::string(500, 'a') + '!');
  const std::string file = folder_.write("f", text);
  const std::string message = messageOf(Fault{"", "is wrong", "", FilePlace{file, 1, 501}});
  const std::size_t line = message.find("  1 | ") + 6, end = message.find('\n', line), caret = message.find('^');
  const std::string shown = message.substr(line, end - line);
  EXPECT_TRUE(shown.starts_with("…a") && shown.ends_with("b…")) << message;
  EXPECT_LE(shown.size(), 100u);
  // The ellipsis has three bytes and one column.
  EXPECT_EQ(shown[caret - (end + 1) - 6 + 2], '!') << message;
}

}  // namespace
}  // namespace reachlab

// The program of the window from the shell: what is refused before there is a window.
#include "tests/cli/program.h"

namespace reachlab::gui::app {
namespace {

const std::string kProgram = " \"" REACHLAB_BINARY_DIR "/gui/reachlab\" ";

TEST(WindowProgram, NamesADisplayThatDoesNotAnswerWithTheRemedy) {
  EXPECT_TRUE(test::says(test::shell("unset QT_QPA_PLATFORM; DISPLAY=:4242" + kProgram), 3,
                         "error: the display :4242 does not answer\nhelp: set DISPLAY to the display of your session, or use `reach run`, "
                         "which needs no window\n"));
}

TEST(WindowProgram, RefusesASeedThatWouldBecomeAnother) {
  for (const char* seed : {"-1", "18446744073709551616", "1e3"})  // with a display, and no terminal, the sentence waits in a box
    EXPECT_TRUE(test::says(test::shell("unset DISPLAY;" + kProgram + "--seed " + seed), 2, "allowed: 0 to 18446744073709551615"));
}

}  // namespace
}  // namespace reachlab::gui::app

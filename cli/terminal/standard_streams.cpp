#include "cli/terminal/standard_streams.h"

#include <ext/stdio_sync_filebuf.h>
#include <fmt/format.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <string>

#include "base/system/os.h"

namespace reachlab::cli {
namespace {

std::atomic<int> firstFault{0};  // errno of the standard output
std::atomic<bool> readerGone{false};

// Line ends, tabs and the carriage return of a progress line pass; other control characters, also those of C1 in UTF-8, are spelt out.
std::string spellControls(const char* text, std::size_t size) {
  std::string clean;
  clean.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool c1 = c == 0xC2 && i + 1 < size && (static_cast<unsigned char>(text[i + 1]) & 0xE0) == 0x80;
    if ((c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7F) clean += fmt::format("\\x{:02x}", c);
    else if (c1) clean += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
    else clean += text[i];
  }
  return clean;
}

ssize_t writeOut(void*, const char* text, std::size_t size) {
  if (firstFault == 0 && !readerGone) {
    const std::string clean = spellControls(text, size);
    const int fault = os::writeAll(STDOUT_FILENO, clean.data(), clean.size()) ? 0 : errno;
    if (fault == EPIPE) readerGone = true;
    else if (fault != 0) firstFault = fault;
  }
  return static_cast<ssize_t>(size);
}

ssize_t writeMessage(void*, const char* text, std::size_t size) {
  const std::string clean = spellControls(text, size);
  (void)os::writeAll(STDERR_FILENO, clean.data(), clean.size());  // nobody is left to be told of a fault
  return static_cast<ssize_t>(size);
}

std::FILE* makeStream(ssize_t (*write)(void*, const char*, std::size_t)) {
  cookie_io_functions_t functions{};
  functions.write = write;
  return ::fopencookie(nullptr, "w", functions);
}

void redirect(std::ostream& stream, std::FILE* to) {
  stream.rdbuf(new __gnu_cxx::stdio_sync_filebuf<char>(to));
}  // lives as long as the program

}  // namespace

void guardStandardStreams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::FILE* out = makeStream(writeOut);
  std::FILE* messages = makeStream(writeMessage);
  if (out == nullptr || messages == nullptr) return;  // out of memory at the start: the streams stay as they are
  std::setvbuf(out, nullptr, ::isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF, BUFSIZ);
  std::setvbuf(messages, nullptr, _IONBF, 0);
  stdout = out;
  stderr = messages;
  redirect(std::cout, out);
  redirect(std::cerr, messages);
  redirect(std::clog, messages);
}

bool isStandardOutputClosed() { return readerGone; }

int finishStandardOutput(int exitCode) {
  std::cout.flush();
  std::fflush(stdout);
  if (firstFault == 0) return exitCode;
  fmt::print(
      stderr,
      "error: standard output: cannot be written: {}\nhelp: the printed text is incomplete. Recordings and files are not concerned\n",
      std::strerror(firstFault));
  return exitCode == 0 ? 3 : exitCode;
}

}  // namespace reachlab::cli

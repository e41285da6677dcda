#include "base/system/error_report.h"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/fault.h"

namespace reachlab {

namespace {

constexpr char kNoMemory[] = "there is not enough memory for this. The recorded data are safe";
constexpr char kOwnFault[] = "stopped by a fault of the program itself. The recorded data are safe. Please report what you did";

// The standard library ends the program from functions of its own that may not throw (a directory that is read on), and then does not say why.
thread_local bool memoryRefused = false;

void onNoMemory() {
  memoryRefused = true;
  throw std::bad_alloc();
}

// Asks for no memory: there may be none.
[[noreturn]] void sayLastWord() {
  bool noMemory = memoryRefused && !std::current_exception();
  if (std::current_exception()) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      noMemory = true;
    } catch (...) {}
  }
  const char* sentence = noMemory ? kNoMemory : kOwnFault;
  if (::write(STDERR_FILENO, "error: ", 7) < 0 || ::write(STDERR_FILENO, sentence, std::strlen(sentence)) < 0 ||
      ::write(STDERR_FILENO, "\n", 1) < 0) {}  // nobody is left to tell
  ::_exit(noMemory ? 3 : kOwnFaultExit);
}

struct BeforeMain {
  BeforeMain() noexcept {
    std::set_terminate(sayLastWord);
    std::set_new_handler(onNoMemory);
  }
};
[[gnu::init_priority(101)]] const BeforeMain beforeMain;  // before every other object of the program

}  // namespace

void endOnUncaught() noexcept { std::set_terminate(sayLastWord); }

ErrorReport errorReportOf(const std::exception& error) {
  const auto* own = dynamic_cast<const Error*>(&error);
  if (dynamic_cast<const FaultError*>(own) != nullptr) return {own->what(), 2};
  if (dynamic_cast<const RefusedError*>(own) != nullptr) return {own->what(), 4};
  if (own != nullptr) return {own->what(), 3};
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr || dynamic_cast<const std::length_error*>(&error) != nullptr)
    return {kNoMemory, 3};
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return {file->path1().string() + (file->path1().empty() ? "" : ": ") + "cannot be used: " + file->code().message(), 3};
  if (const auto* system = dynamic_cast<const std::system_error*>(&error))
    return {"the operating system refuses: " + system->code().message(), 3};
  if (dynamic_cast<const nlohmann::json::exception*>(&error) != nullptr)
    return {"a file that was read does not hold what Reachlab wrote there, or should find there", 2};
  return {kOwnFault, kOwnFaultExit};
}

}  // namespace reachlab

#include "cli/terminal/exit_code.h"

#include <cstdio>

#include "base/fault.h"
#include "base/system/error_report.h"
#include "base/terminal/message.h"
#include "base/terminal/parse_fault.h"
#include "cli/terminal/option_words.h"
#include "sim/session/recorded_run.h"

namespace reachlab::cli {

int exitCodeOf(CLI::App& app, const std::function<int()>& work) {
  try {
    return work();
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fputs(messageOf(faultOf(app, e)).c_str(), stderr);
    return 2;
  } catch (const FaultError& e) {
    std::fputs(messageOf(inOptionWords(e.faults)).c_str(), stderr);
    return 2;
  } catch (const session::DatasetError& e) {
    std::fputs(messageOf(optionOf("data") + ": " + e.what()).c_str(), stderr);
    return 3;
  } catch (const std::exception& e) {
    const ErrorReport report = errorReportOf(e);
    std::fputs(messageOf(report.sentence).c_str(), stderr);
    return report.exitCode;
  }
}

}  // namespace reachlab::cli

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QMessageBox>
#include <QSettings>
#include <QIcon>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include <unistd.h>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/error_report.h"
#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/stop_signals.h"
#include "base/terminal/command_words.h"
#include "base/terminal/help_format.h"
#include "base/terminal/message.h"
#include "base/terminal/parse_fault.h"
#include "gui/app/display.h"
#include "gui/app/main_window.h"
#include "gui/session/remembered_session.h"
#include "gui/scene/picture_sheet.h"
#include "gui/widgets/theme.h"
#include "network/station/station_options.h"
#include "sim/experiment/resources.h"
#include "sim/record/configuration/limits.h"

namespace reachlab::gui::app {
namespace {

struct Arguments {
  session::SessionRequest request;
  std::string pictures;
  std::optional<network::StationSetup> station;
};

// What only a station has; `number`: which it is, 0 where it is none or only observes.
void parseStation(CLI::App& app, int number, bool observes, const CLI::App& options, network::StationSetup& setup, Arguments& a) {
  if (number == 0 && !observes) {
    if (options.count_all() > 0)
      throw FaultError(
          Fault{"--station", "is missing; give it with the other options of a station", "1 to " + std::to_string(network::kMaxStations)});
    return;
  }
  setup.link.station = number;
  network::completeStationSetup(setup, a.request.device, app.get_name());
  a.station = setup;
}

Arguments parse(CLI::App& app, int argc, char** argv) {
  app.formatter(std::make_shared<HelpFormat>());  // before the groups, which take it over
  Arguments a;
  session::SessionRequest& r = a.request;
  r.what = "chain-moderate";
  r.device = "mouse";
  app.set_version_flag("--version", "reachlab " REACHLAB_VERSION);
  app.add_option(
      "experiment", r.what,
      "Experiment or session plan: a file, or the name of a shipped one; or a recording: a dataset, a session, a log [default: chain-moderate]");
  app.add_option("--device", r.device,
                 "mouse, simulated[:KEY=VALUE,…], replay:FILE or replay:FOLDER, phantom …; `reach list devices` tells all "
                 "[default: that of the last start, at first mouse]");
  app.add_option("--instrument", r.instruments,
                 "Instrument: lsl, parallel:PATH, rts:PATH or byte:PATH. It is told go, onset and end. May be given several times")
      ->expected(1)
      ->take_all();
  app.add_option("--backup", r.backup, "Second data folder: every finished run is copied there and verified");
  app.add_option("--trials", r.trials, "Number of trials of an experiment. A plan has its own numbers [default: 20]")
      ->check(CLI::Range(1, session::kMaxTrials));
  app.add_option("--run", r.run, "Run number. A number that is taken is refused [default: the next free number]")
      ->check(CLI::Range(1, record::kMaxRun));
  app.add_option("--subject", r.place.subject, "Subject's label, letters and digits [default: that of the last start, at first 01]");
  app.add_option("--session", r.place.session, "Session's label, letters and digits [default: that of the last start, at first 01]");
  app.add_option("--data", r.place.data, "Folder of the dataset [default: that of the last start, at first ./data]");
  app.add_option("--day", r.day, "Day of the plan, when the session's label is no number")->check(CLI::Range(1, session::kMaxDay));
  app.add_option("--seed", r.seed, "Seed of noise and order [default: a seed is drawn and stored]")
      ->check(CLI::Validator(session::seedFault, "SEED"));
  app.add_flag("--resume", r.resume, "Continue with the trial at which this session broke off");
  app.add_option("--pictures", a.pictures, "Draw every constraint and every shipped experiment into this folder, and end");
  int number = 0;
  network::StationSetup setup;
  CLI::App* station = app.add_option_group("Station", "One of several stations that move one object together");
  auto* here = station->add_option("--station", number, "Which of the experiment's hands is here, from 1")
                   ->check(CLI::Range(1, network::kMaxStations));
  network::addStationOptions(*station, setup);
  bool observes = false;
  station->add_flag("--observe,--look-on", observes, "Without a hand: show the stations. Nothing is recorded, and they do not wait for it")
      ->excludes(here)
      ->excludes(station->get_option("--conductor"));
  app.footer(
      "Examples:\n  reachlab chain-moderate\n  reachlab paper --subject 03 --session 01\n  reachlab data\n  reachlab parallel --device simulated --trials "
      "5\n  reachlab chain-two-hands --station 1 --conductor --peers lab");
  checkEveryNumber(app);
  refuseEmptyWords(argc, argv);
  app.parse(argc, argv);
  parseStation(app, number, observes, *station, setup, a);
  if (a.station) return a;  // its partners rely on what is asked for
  // What is not asked for is as at the last start.
  const session::SessionRequest last = rememberedRequest(r);
  if (app.count("--device") == 0) r.device = last.device;
  if (app.count("--subject") == 0) r.place.subject = last.place.subject;
  if (app.count("--session") == 0) r.place.session = last.place.session;
  if (app.count("--data") == 0) r.place.data = last.place.data;
  return a;
}

int run(const Arguments& arguments, int argc, char** argv) {
  // The scene is drawn over GLX; on Wayland desktops XWayland serves it.
  if (std::getenv("QT_QPA_PLATFORM") == nullptr) {
    if (std::getenv("DISPLAY") == nullptr)
      throw ResourceError("there is no display, because DISPLAY is not set; use `reach run`, which needs no window");
    if (!displayAnswers())
      throw ResourceError("the display " + std::string(std::getenv("DISPLAY")) +
                          " does not answer; set DISPLAY to the display of your session, or use `reach run`, which needs no window");
    setenv("QT_QPA_PLATFORM", "xcb", 0);
  }
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QCoreApplication::setAttribute(Qt::AA_CompressHighFrequencyEvents, false);  // each move of the pointer is a sample of the hand
  scene::applySurfaceFormat();
  QApplication application(argc, argv);
  if (QSettings().value("window/theme").toString() == QLatin1String("light")) widgets::setTheme(widgets::Theme::Light);
  widgets::applyTheme(application);
  if (!arguments.pictures.empty()) {
    const int drawn = scene::drawPictures(QString::fromStdString(arguments.pictures));
    std::printf("%d pictures and their contact sheets in %s\n", drawn, arguments.pictures.c_str());
    return 0;
  }
  session::SessionRequest request = arguments.request;
  const QString what = QString::fromStdString(request.what);
  const bool recorded = isRecorded(what);
  if (recorded) request.what = "chain-moderate";
  MainWindow window(request, arguments.station);
  window.setWindowIcon(QIcon(QString::fromStdString(experiment::resourceFolder()) + "/icons/reachlab.png"));
  if (recorded) window.inspect(what);
  const auto trials = rememberedTrials();
  if (trials && !request.trials && !arguments.station) window.sessionDock().setTrials(*trials);
  window.show();
  if (!recorded && !request.resume && !arguments.station) window.offerResume();
  if (arguments.station) QTimer::singleShot(0, &window, &MainWindow::joinStations);
  return QApplication::exec();
}

// On the terminal, and where there is none (started from a menu) in a box.
int sayFault(const std::string& message, const std::string& sentence, int status, int argc, char** argv) {
  std::fputs(message.c_str(), stderr);
  if (isatty(STDERR_FILENO) == 1 || !displayAnswers()) return status;
  std::unique_ptr<QApplication> application;
  if (QCoreApplication::instance() == nullptr) application = std::make_unique<QApplication>(argc, argv);
  QMessageBox(QMessageBox::Critical, "Reachlab", QString::fromStdString(sentence), QMessageBox::Close).exec();
  return status;
}

}  // namespace
}  // namespace reachlab::gui::app

int main(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::gui::app;
  requireProcessorLevel();
  endOnUncaught();
  os::holdStandardDescriptors();
  endOnSignals();
  QCoreApplication::setOrganizationName("reachlab");  // by which the settings are found
  QCoreApplication::setApplicationName("reachlab");
  CLI::App app{"reachlab: the window of Reachlab", "reachlab"};
  try {
    return run(parse(app, argc, argv), argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    const Fault fault = faultOf(app, e);
    return sayFault(messageOf(fault), toText(fault), 2, argc, argv);
  } catch (const FaultError& e) {
    return sayFault(messageOf(e.faults), e.what(), 2, argc, argv);
  } catch (const std::exception& e) {
    const ErrorReport report = errorReportOf(e);
    return sayFault(messageOf(report.sentence), report.sentence, report.exitCode, argc, argv);
  }
}

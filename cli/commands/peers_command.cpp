#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "base/fault.h"
#include "cli/commands/commands.h"
#include "network/peers/peers.h"

namespace reachlab::cli {

void addPeersCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("peers", "Certificates of the stations that may move objects together");
  command->require_subcommand(1);
  struct Request {
    std::string folder, name, request;
    bool conductor = false;
    network::PeersOptions options;
  };
  const auto r = std::make_shared<Request>();
  const auto days = [r](CLI::App* to) {
    to->add_option("--days", r->options.days, "Days for which what is signed is valid")->check(CLI::Range(1, 36500))->capture_default_str();
  };

  CLI::App* init =
      command->add_subcommand("init", "Makes this station's key: with the authorities on the conductor, with a request elsewhere");
  init->footer("Examples:\n  reach peers init lab --conductor --name left\n  reach peers init lab --name right");
  init->add_option("folder", r->folder, "Folder of certificates, new or empty")->required();
  init->add_option("--name", r->name, "Name of this station: letters, digits and hyphens")->required();
  init->add_flag("--conductor", r->conductor, "Makes the two authorities too");
  days(init);
  init->callback([r, init] {
    if (!r->conductor && init->count("--days") > 0)
      throw FaultError(
          Fault{"--days", "is given without --conductor", "the conductor's `reach peers add … --days`, which signs for this station"});
    if (r->conductor) {
      network::initConductor(r->folder, r->name, r->options);
      fmt::print("{}: authorities and the certificate of {}\n", r->folder, r->name);
    } else {
      network::initStation(r->folder, r->name);
      fmt::print("{0}/request.pem: take it to the conductor, whose reach peers add answers it; its answer goes into {0}\n", r->folder);
    }
  });

  CLI::App* add = command->add_subcommand("add", "On the conductor: answers a station's request");
  add->footer("Example:\n  reach peers add lab request.pem");
  add->add_option("folder", r->folder, "The conductor's folder of certificates")->required();
  add->add_option("request", r->request, "The station's request.pem")->required();
  days(add);
  add->callback(
      [r] { fmt::print("{}: copy these files into the station's folder\n", network::addStation(r->folder, r->request, r->options)); });

  CLI::App* list =
      command->add_subcommand("list", "Says whose certificates a folder has and what is wrong with them; exits 1 when something is");
  list->footer("Example:\n  reach peers list lab");
  list->add_option("folder", r->folder, "Folder of certificates")->required();
  list->callback([r, &exitCode] {
    for (const network::PeerFolder& peer : network::listPeers(r->folder)) {
      fmt::print("name={} conductor={} complete={} valid_until={}{}\n", peer.name.empty() ? "?" : peer.name, peer.conductor ? "yes" : "no",
                 peer.complete ? "yes" : "no", peer.validUntil.empty() ? "?" : peer.validUntil,
                 peer.fault.empty() ? "" : "; " + peer.fault);
      if (!peer.fault.empty() || !peer.complete) exitCode = 1;
    }
  });
  command->footer(
      "Examples:\n"
      "  reach peers init lab --conductor --name left\n"
      "  reach peers init lab --name right                  (on the other station)\n"
      "  reach peers add lab request.pem                    (on the conductor; then copy lab/for-right/* to the other's lab)\n"
      "  reach peers list lab");
}

}  // namespace reachlab::cli

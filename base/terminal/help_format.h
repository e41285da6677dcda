#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace reachlab {

/// Help in one form for every command: `--trials <N>` on the left, and on the right the meaning, the range, and `[default: …]`. No line has more
/// than 100 columns.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_footer(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace reachlab

#include "base/terminal/help_format.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/terminal/parse_fault.h"

namespace reachlab {
namespace {

constexpr std::size_t kHelpColumns = 100;

// Letters, and not bytes: an ellipsis has three bytes and one column.
std::size_t widthOf(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// Lines of at most `columns`, broken at spaces. Line ends of the text stay.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& lineEnd = "\n") {
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::string current;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (!current.empty() && widthOf(current) + 1 + widthOf(word) > columns) {
        all += current + lineEnd;
        current.clear();
      }
      current += (current.empty() ? "" : " ") + word;
    }
    all += current + "\n";
  }
  if (!all.empty()) all.pop_back();
  return all;
}

}  // namespace

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
  for (std::size_t at = 0; (at = help.find("\n\n\n", at)) != std::string::npos;) help.erase(at, 1);
  return help;
}

std::string HelpFormat::make_description(const CLI::App* app) const { return wrapped(app->get_description(), kHelpColumns) + "\n"; }

// Paragraphs are filled. An indented line is an example: it goes on in the next line as a shell reads it.
std::string HelpFormat::make_footer(const CLI::App* app) const {
  std::string filled, paragraph;
  const auto flush = [&] {
    if (!paragraph.empty()) filled += wrapped(paragraph, kHelpColumns) + "\n";
    paragraph.clear();
  };
  std::istringstream lines(app->get_footer());
  for (std::string line; std::getline(lines, line);) {
    const bool heading = line.starts_with("Example");
    if (!line.empty() && !line.starts_with(' ') && !heading) {
      paragraph += (paragraph.empty() ? "" : " ") + line;
      continue;
    }
    flush();
    if (widthOf(line) <= kHelpColumns) filled += line + "\n";
    else filled += (heading ? "" : "  ") + wrapped(line, kHelpColumns - 8, " \\\n      ") + "\n";
  }
  flush();
  return filled.empty() ? filled : "\n" + filled;  // CLI11 before 2.4 begins it with an empty line, too
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_display_name(true), wrapped(command->get_description(), kHelpColumns - column_width_),
                           column_width_);
  return out.str();
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  const std::string type = typeOf(*option);
  if (type.empty()) return {};
  std::string text = type == "INT" || type == "UINT" ? " <N>" : type == "FLOAT" ? " <X>" : " <TEXT>";
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
  return text;
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  if (!option->get_type_name().empty()) {
    if (const std::string limit = allowedOf(*option); !limit.empty()) text += " [" + limit + "]";
    if (!option->get_default_str().empty()) text += " [default: " + option->get_default_str() + "]";
    if (option->get_required()) text += " (required)";
  }
  return wrapped(text, kHelpColumns - column_width_);
}

}  // namespace reachlab

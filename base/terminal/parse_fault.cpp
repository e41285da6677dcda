#include "base/terminal/parse_fault.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>
#include <vector>

#include "base/names.h"

namespace reachlab {
namespace {

const CLI::App& givenCommand(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

/// "`reach run --help`".
std::string helpCommand(const CLI::App& app, const CLI::App& command) {
  std::string words;
  for (const CLI::App* at = &command; at != &app && at != nullptr; at = at->get_parent()) words.insert(0, " " + at->get_name());
  return "`" + app.get_name() + words + " --help`";
}

std::vector<std::string> commandsOf(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* sub : command.get_subcommands([](const CLI::App*) { return true; })) names.push_back(sub->get_name());
  return names;
}

std::vector<const CLI::Option*> optionsOf(const CLI::App& app) {
  std::vector<const CLI::Option*> all;
  for (const CLI::App* command = &givenCommand(app); command != nullptr; command = command->get_parent()) {
    for (const CLI::Option* option : command->get_options()) all.push_back(option);
    for (const CLI::App* group : command->get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); }))
      for (const CLI::Option* option : group->get_options()) all.push_back(option);
  }
  return all;
}

/// The options that the library's text names, in its order. The texts around the names are not read: they are not ours.
std::vector<const CLI::Option*> namedIn(const CLI::App& app, const std::string& text) {
  const auto isOfName = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_'; };
  std::vector<std::pair<std::size_t, const CLI::Option*>> found;
  for (const CLI::Option* option : optionsOf(app)) {
    const std::string name = option->get_name();
    for (std::size_t at = text.find(name); !name.empty() && at != std::string::npos; at = text.find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if ((at > 0 && isOfName(text[at - 1])) || (end < text.size() && isOfName(text[end]))) continue;
      found.emplace_back(at, option);
      break;
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const CLI::Option*> options;
  for (const auto& [at, option] : found) options.push_back(option);
  return options;
}

std::string nearestOf(const CLI::App& command, const std::string& word) {
  std::vector<std::string> known;
  if (word.starts_with("--")) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  } else {
    known = commandsOf(command);
  }
  return didYouMean(word.substr(0, word.find('=')), known);
}

Fault unknownWord(const CLI::App& app, const CLI::App& command, const std::string& word) {
  const std::string near = nearestOf(command, word), lists = helpCommand(app, command);
  if (word.starts_with('-')) return {word, "is not a known option" + near + "; " + lists + " lists the options"};
  const std::vector<std::string> commands = commandsOf(command);
  if (!commands.empty()) return {word, "is not a command" + near, listOf(commands)};
  return {word, "is one word too many" + near + "; " + lists + " shows the form of the command"};
}

Fault missing(const CLI::App& app) {
  const CLI::App& command = givenCommand(app);
  const std::vector<std::string> rest = app.remaining(true);
  for (const std::string& word : rest)  // a misspelt option is the likeliest reason
    if (word.starts_with("--") && !nearestOf(command, word).empty()) return unknownWord(app, command, word);
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->empty()) {
      if (const std::string limit = allowedOf(*option); !limit.empty()) return {option->get_name(), "is missing", limit};
      return {option->get_name(), "is missing; " + option->get_name() + ": " + option->get_description()};
    }
  if (!rest.empty() && !rest.front().starts_with('-')) return unknownWord(app, command, rest.front());
  return {command.get_parent() == nullptr ? std::string() : command.get_name(),
          "a command is missing; " + helpCommand(app, command) + " explains the commands", listOf(commandsOf(command))};
}

Fault wrongValue(const CLI::Option& option) {
  const std::string type = typeOf(option), limit = allowedOf(option);
  std::string allowed = type == "INT" || type == "UINT" ? "a whole number" : type == "FLOAT" ? "a number" : limit;
  if (!limit.empty() && allowed != limit) allowed += ", " + limit;
  return {option.get_name(), "is " + CLI::detail::join(option.results(), " "), allowed};
}

}  // namespace

std::string typeOf(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

std::string allowedOf(const CLI::Option& option) {  // "INT:INT in [1 - 9]" is a type and its range
  const std::string name = option.get_type_name();
  const std::size_t colon = name.find(':');
  const std::string limit = colon == std::string::npos ? std::string() : name.substr(colon + 1);
  if (limit == "POSITIVE") return "more than 0";
  if (limit == "NONNEGATIVE") return "0 or more";
  if (limit.starts_with('{')) return listOf(CLI::detail::split(limit.substr(1, limit.size() - 2), ','));
  const std::size_t begin = limit.find(" in ["), dash = limit.find(" - ");
  if (begin == std::string::npos || dash == std::string::npos) return {};
  return limit.substr(begin + 5, dash - begin - 5) + " to " + limit.substr(dash + 3, limit.size() - dash - 4);
}

Fault faultOf(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = givenCommand(app);
  const std::string text = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing(app);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::vector<std::string> rest = app.remaining(true);
    return unknownWord(app, command, rest.empty() ? text : rest.front());
  }
  const std::vector<const CLI::Option*> named = namedIn(app, text);
  if (named.empty()) return {{}, "the command line cannot be read; " + helpCommand(app, command) + " shows its form"};
  const CLI::Option& option = *named.front();
  const std::string other = named.size() > 1 ? named[1]->get_name() : std::string();
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr)
    return {option.get_name(), "is given without " + other + "; give " + other + ", too, or leave " + option.get_name() + " out"};
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr)
    return {option.get_name(), "is given together with " + other + "; leave out one of the two"};
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return typeOf(option).empty()
               ? Fault{option.get_name(), "is a switch without a value; leave the value out"}
               : Fault{option.get_name(), "has the wrong number of values; " + option.get_name() + ": " + option.get_description()};
  // A rule of our own answers in our words, behind the option's name.
  if (const std::size_t own = text.find(": is "); dynamic_cast<const CLI::ValidationError*>(&error) != nullptr && own != std::string::npos)
    return {option.get_name(), text.substr(own + 2)};
  return wrongValue(option);
}

}  // namespace reachlab

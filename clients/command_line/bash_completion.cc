// SPDX-License-Identifier: BSD-3-Clause
#include "clients/command_line/bash_completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "clients/command_line/version.h"

namespace dhpmap {
namespace {

/// Walks the words before the one to complete; PROGRAM, FUNCTION and LIST are substituted. Words come from the tables
/// below or from the program, and the shell never expands them. Bash splits words at ':' and '='.
constexpr const char* kWalk = R"(FUNCTION() {
  local current=${COMP_WORDS[COMP_CWORD]} path= option= values= left=0 position=0 i item name word server=
  local commands options positionals
  COMPREPLY=()
  FUNCTION_table ''
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    case "$word" in
      :) ((i++)); continue ;;
      =) continue ;;
    esac
    if ((left > 0)) && [[ $word != --* ]]; then
      ((left--))
      continue
    fi
    left=0
    if [[ $word == -* ]]; then
      for item in $options; do
        name=${item%%:*}
        [[ $name == "$word" ]] || continue
        option=${item#*:}
        left=${option%%:*}
      done
    elif [[ " $commands " == *" $word "* ]]; then
      path="$path $word"
      FUNCTION_table "${path# }"
    else
      ((position++))
    fi
  done
  [[ $current == [=:] ]] && current=
  if ((left > 0)) && [[ $current != -* ]]; then
    values=${option#*:}
    values=${values//,/ }
  elif [[ $current == -* ]]; then
    for item in $options; do values+=" ${item%%:*}"; done
  elif [[ -n $commands ]]; then
    values=$commands
  else
    for item in $positionals; do
      ((position-- == 0)) && values=$item
    done
  fi
  if [[ $values == '@' ]]; then
    [[ ${COMP_LINE-} =~ --server[=\ ]+([^\ ]+) ]] && server=${BASH_REMATCH[1]}
    values=$("${COMP_WORDS[0]}" ${server:+--server "$server"} LIST 2>/dev/null)
  fi
  while read -r word; do
    [[ -n $word && $word == "$current"* ]] && COMPREPLY+=("$word")
  done <<<"${values// /$'\n'}"
}
complete -o bashdefault -o default -F FUNCTION PROGRAM
)";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string FunctionName(const std::string& program) {
  std::string name = "_" + program;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// The set of values in an option's description: "{thing,stuff}".
std::string SetOfValues(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::string values = type.substr(begin + 1, end - begin - 1);
  return values.find_first_of(" :'") == std::string::npos ? values : std::string();
}

/// The maximum number of words after an option: 0 for a flag.
int NumWords(const CLI::Option& option) {
  constexpr int kMost = 99;
  const int least = option.get_items_expected_min();
  return least > 0 && option.get_allow_extra_args() ? std::min(option.get_items_expected_max(), kMost) : least;
}

/// "--kind:1:thing,stuff": name, number of words after it, and their values; "@" for values that the program lists.
std::string OptionEntry(const CLI::Option& option, const std::string& name, const ListedValues& listed) {
  const auto& names = option.get_lnames();
  const bool is_listed = std::find(names.begin(), names.end(), listed.name) != names.end();
  return name + ":" + std::to_string(NumWords(option)) + ":" + (is_listed ? "@" : SetOfValues(option));
}

/// One command's row: its subcommands, its options and those of its parents, its positionals.
std::string Row(const CLI::App& command, const std::string& path, const ListedValues& listed) {
  std::string commands, options, positionals;
  for (const CLI::App* sub : command.get_subcommands({})) {
    if (!sub->get_group().empty()) commands += " " + sub->get_name();
  }
  std::set<std::string> known;
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
    for (const CLI::Option* option : app->get_options()) {
      std::vector<std::string> names;
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
      for (const std::string& name : names) {
        if (known.insert(name).second) options += " " + OptionEntry(*option, name, listed);
      }
      if (app != &command || !option->get_positional()) continue;
      const std::string values = option->get_name(true) == listed.name ? "@" : SetOfValues(*option);
      positionals += " " + (values.empty() ? "-" : values);
    }
  }
  const auto trimmed = [](const std::string& list) { return list.empty() ? list : list.substr(1); };
  return "    '" + path + "') commands='" + trimmed(commands) + "' options='" + trimmed(options) + "' positionals='" +
         trimmed(positionals) + "' ;;\n";
}

std::string Rows(const CLI::App& command, const std::string& path, const ListedValues& listed) {
  std::string rows = Row(command, path, listed);
  for (const CLI::App* sub : command.get_subcommands({})) {
    rows += Rows(*sub, path + (path.empty() ? "" : " ") + sub->get_name(), listed);
  }
  return rows;
}

}  // namespace

std::string BashCompletion(const CLI::App& app, const ListedValues& listed) {
  const std::string program = app.get_name(), function = FunctionName(program);
  const std::string table = function + "_table() {\n  commands= options= positionals=\n  case \"$1\" in\n" +
                            Rows(app, "", listed) + "  esac\n}\n";
  const std::string walk = Replaced(Replaced(kWalk, "PROGRAM", program), "LIST", listed.command);
  return "# Completes " + VersionOf(program) + " in bash: source <(" + program + " completion bash)\n" + table +
         Replaced(walk, "FUNCTION", function);
}

}  // namespace dhpmap

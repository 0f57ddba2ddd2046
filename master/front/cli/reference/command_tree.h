// The command line of the program, as plain data: what its reference is made of.
#ifndef STRIDE_MASTER_FRONT_CLI_REFERENCE_COMMAND_TREE_H
#define STRIDE_MASTER_FRONT_CLI_REFERENCE_COMMAND_TREE_H

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stride::cli::reference {

/// What the value of an option, or an argument, can be.
struct Value {
  enum class Kind {
    Anything,
    Choice,    ///< one of `choices`
    Scenario,  ///< a file as below, or the name of one that comes with stride
    File,      ///< with one of `extensions`, if there are any
    Folder,
    Component,          ///< of the scenario
    ComponentVariable,  ///< "sensor.led=…"
    ComponentFile,      ///< "sensor=" and a file
  };
  Kind kind = Kind::Anything;
  std::vector<std::string> choices;
  std::vector<std::string> extensions;  ///< "ssd"
};

/// An option, or an argument, which has one name without dashes.
struct Option {
  std::vector<std::string> names;  ///< "-o", "--out"
  std::string placeholder;         ///< "SECONDS"; empty for what takes no value
  bool is_value_optional = false;  ///< "--isolate" or "--isolate=COMPONENT"
  bool is_required = false;
  bool is_repeatable = false;
  bool is_help = false;  ///< which every command has
  std::string description;
  std::string default_text;
  Value value;

  bool takes_value() const { return !placeholder.empty(); }
};

struct Command {
  std::vector<std::string> words;  ///< "stride", "trace", "info"
  std::string description;         ///< a line without a full stop
  std::string footer;
  std::vector<Option> arguments, options;
  std::vector<Command> commands;

  const std::string& name() const { return words.back(); }
  /// "stride trace info"
  std::string full_name(const std::string& separator = " ") const;
};

/// Of a command and all below it, in the order in which they were added; hidden ones are left out.
/// What an option's value can be is read from its placeholder, such as FOLDER or "hold|linear", and
/// for files from the extensions that its description names.
Command describe(const CLI::App& app);

/// The command and all below it, each before those below it.
std::vector<const Command*> all_of(const Command& command);

/// The options on the page of a command: --help is on the page of the program only.
std::vector<Option> documented_options(const Command& command);

/// "SECONDS", "[=COMPONENT]": what follows the names of an option in a synopsis.
std::string value_text(const Option& option);

/// "stride run [OPTION]... FILE"
std::string synopsis(const Command& command);

/// The description with the default and whether the option can be repeated.
std::string meaning(const Option& option);

}  // namespace stride::cli::reference

#endif

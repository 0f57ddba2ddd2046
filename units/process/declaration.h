// What is declared of a program: how it is started, and its variables.
#ifndef STRIDE_UNITS_PROCESS_DECLARATION_H
#define STRIDE_UNITS_PROCESS_DECLARATION_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>
#include <stride/unit/unit_of_measure_definition.h>

#include "units/process/variable.h"

namespace process {

/// The program or one of its arguments.
struct Word {
  enum class Kind {
    Text,      ///< as it is; of the program: a path, or a name that is looked for in PATH
    Resource,  ///< a file that is packed, by its name in the resources
    Outside,   ///< a file that stays where it is, relative to the declaration
  };
  Kind kind = Kind::Text;
  std::string text;
};

struct Declaration {
  std::string description;
  std::vector<Word> command;  ///< the program, then its arguments
  std::vector<Variable> variables;
  std::vector<stride::UnitOfMeasureDefinition> units_of_measure;
  bool may_stop = false;         ///< a step may end early
  bool split_invariant = false;  ///< as UnitInfo has it
  bool has_trace = false;        ///< it can write one
  stride::Duration time_unit{1};
  std::optional<stride::Duration> maximum_step;
};

/// Reads `process.xml` in a folder of resources. Throws std::runtime_error with file and line, and
/// what was expected.
Declaration load_declaration(const std::filesystem::path& resources);

/// The command with the paths that it has on this machine: files in the resources, files outside
/// relative to the folder of the declaration when it was packed, which is in `origin.txt`.
/// `other_program` is run in the place of the program unless it is empty. Throws std::runtime_error
/// where a file cannot be found.
std::vector<std::string> command_line(const Declaration& declaration,
                                      const std::filesystem::path& resources,
                                      const std::string& other_program);

}  // namespace process

#endif

// The reference of the command line in its formats.
#ifndef STRIDE_MASTER_FRONT_CLI_REFERENCE_WRITERS_H
#define STRIDE_MASTER_FRONT_CLI_REFERENCE_WRITERS_H

#include <map>
#include <string>

#include "master/front/cli/reference/command_tree.h"

namespace stride::cli::reference {

/// A page with a section for each command.
std::string markdown(const Command& program);

/// Pages of section 1 (man(7)) by the names of their files: one for the program, and one for each
/// command below it, with what is below that.
std::map<std::string, std::string> man_pages(const Command& program, const std::string& version);

/// What completes a command line in each of these shells. Names of components are asked from the
/// program that is on the line.
std::string bash_completion(const Command& program);
std::string zsh_completion(const Command& program);
std::string fish_completion(const Command& program);

/// The words of a text in lines of `width` characters at most, each ended by a newline; paragraphs
/// and lines that begin with a blank stay apart.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace stride::cli::reference

#endif

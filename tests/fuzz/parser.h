// Parsers as the fuzzers see them: each is a function of bytes, and registered once.
#ifndef STRIDE_TESTS_FUZZ_PARSER_H
#define STRIDE_TESTS_FUZZ_PARSER_H

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace stride::tests {

/// The clear error by which a parser refuses what it cannot read.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Parser {
  std::string name;  ///< none is that of a group
  /// Reads the bytes as the program would, and returns if they are accepted. Throws Refusal if they
  /// are refused with the error that the parser's header promises. Anything else is a finding:
  /// another exception, a crash, the report of a sanitizer, too much time or memory.
  void (*read)(const std::string& bytes);
  /// Files and folders of the repository with what it accepts.
  std::vector<std::string> seed_files{};
  std::vector<std::string> seeds{};           ///< further ones
  std::string (*make_seed)() = nullptr;       ///< one more, for which there is a working folder
  std::string alphabet = "<>&\"'/=:.%-0 \n";  ///< what means something to it
  /// It accepts, or refuses, some of what a seed becomes by damage.
  bool may_accept = true;
  bool may_refuse = true;
  std::string group{};  ///< by Registration
};

/// In the order of their names.
const std::vector<Parser>& parsers();
/// Throws std::invalid_argument that lists all names.
const Parser& find_parser(const std::string& name);
/// Those of a group, or the one of this name. Throws likewise.
std::vector<Parser> find_parsers(const std::string& name_or_group);
/// All of its seeds. Throws std::runtime_error for a file that cannot be read.
std::vector<std::string> seeds_of(const Parser& parser);

/// A variable of this type in parsers/GROUP.cpp adds to parsers().
struct Registration {
  Registration(const char* group, std::initializer_list<Parser> added);
};

/// Throws what is no Refusal.
inline void ensure(bool holds, const std::string& property) {
  if (!holds) throw std::logic_error("this does not hold: " + property);
}

/// Calls read(). Its errors of the type Error are refusals if their text contains `part`.
template <class Error, class Read>
void refusing(std::string_view part, Read&& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string text = error.what();
    ensure(text.find(part) != std::string::npos, "'" + text + "' contains " + std::string(part));
    throw Refusal(text);
  }
}

}  // namespace stride::tests

#endif

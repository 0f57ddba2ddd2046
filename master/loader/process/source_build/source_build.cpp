#include "master/loader/process/source_build/source_build.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/sandbox.h"
#include "master/base/error.h"
#include "master/loader/process/source_build/fmi_headers.h"

namespace stride::isolation {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Where a program that could not be started ends, as a shell has it.
constexpr int kNoProgram = 127;

std::string compiler(const char* variable, const char* otherwise) {
  const char* const named = std::getenv(variable);
  return named != nullptr && *named != '\0' ? named : otherwise;
}

bool is_cpp(const importer::SourceFileSet& set, const fs::path& file) {
  if (!set.language.empty()) return set.language.starts_with("C++");
  const std::string end = file.extension().string();
  return end == ".cpp" || end == ".cc" || end == ".cxx" || end == ".C";
}

/// "C99" is "gnu99", so that what POSIX has is declared.
std::string standard(const std::string& language) {
  if (language.starts_with("C++")) return "-std=gnu++" + language.substr(3);
  return "-std=gnu" + language.substr(1);
}

/// Runs a program in this process's place and waits for it.
int run(Words words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), ::environ) != 0) {
    return kNoProgram;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

void run_or_throw(const Words& words, const std::string& what) {
  const int code = run(words);
  if (code == kNoProgram) {
    throw std::runtime_error(fmt::format("there is no compiler '{}'", words.front()));
  }
  if (code != 0) throw std::runtime_error(what);
}

class Compilation {
 public:
  explicit Compilation(const SourceBuild& build) : build_(build) {}

  /// Throws std::exception with what went wrong; the compiler prints the rest.
  void run_all() {
    for (const importer::SourceFileSet& set : build_.description.sets) {
      for (const fs::path& file : set.files) compile(set, file);
    }
    link();
  }

 private:
  void compile(const importer::SourceFileSet& set, const fs::path& file) {
    const bool cpp = is_cpp(set, file);
    has_cpp_ |= cpp;
    const fs::path object = build_.folder / fmt::format("{}.o", objects_.size());
    Words words{cpp ? compiler("CXX", "c++") : compiler("CC", "cc"),
                "-c",
                "-fPIC",
                "-O2",
                "-w",
                "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
                "-DFMI3_OVERRIDE_FUNCTION_PREFIX",
                "-DNO_FUNCTION_PREFIX"};  // of 20-sim, whose headers do not know the others
    if (set.language.size() > 1) words.push_back(standard(set.language));
    words.insert(words.end(), set.options.begin(), set.options.end());
    for (const std::string& definition : set.definitions) words.push_back("-D" + definition);
    for (const std::string& definition : build_.definitions) words.push_back("-D" + definition);
    words.push_back("-I" + build_.sources.string());
    for (const fs::path& folder : set.includes) {
      words.push_back("-I" + (build_.sources / folder).string());
    }
    for (const fs::path& folder : build_.includes) words.push_back("-I" + folder.string());
    words.push_back("-I" + (build_.folder / kHeaders).string());
    words.insert(words.end(), {"-o", object.string(), (build_.sources / file).string()});
    run_or_throw(words, fmt::format("the source '{}' does not compile", file.string()));
    objects_.push_back(object.string());
  }

  /// Bound to its own symbols, whatever program loads it.
  void link() {
    Words words{has_cpp_ ? compiler("CXX", "c++") : compiler("CC", "cc"), "-shared",
                "-Wl,-Bsymbolic", "-o", build_.library.string()};
    words.insert(words.end(), objects_.begin(), objects_.end());
    for (const std::string& library : build_.description.libraries) words.push_back("-l" + library);
    words.push_back("-lm");
    run_or_throw(words, "the sources compile, but cannot be linked");
  }

  const SourceBuild& build_;
  Words objects_;
  bool has_cpp_ = false;
};

/// Headers of the standards, which an FMU need not have.
void write_headers(const fs::path& folder) {
  for (const FmiHeader& header : fmi_headers()) {
    fs::create_directories((folder / header.name).parent_path());
    std::ofstream(folder / header.name) << header.text;
  }
}

std::string hint_for(const std::string& printed) {
  if (printed.find("No such file or directory") != std::string::npos) {
    return "name the folder that has the header: -I FOLDER";
  }
  return "what the sources need and their description does not say is given by -D NAME=VALUE and "
         "-I FOLDER";
}

}  // namespace

void build_library(const SourceBuild& build) {
  write_headers(build.folder / kHeaders);
  const ChildOutcome outcome = run_in_child([&] {
    const WritableFolder writable{build.folder, "the folder of the build"};
    enter_sandbox({&writable, 1});
    ::setenv("TMPDIR", build.folder.c_str(), 1);
    Compilation(build).run_all();
    return std::string();
  });
  using End = ChildOutcome::End;
  if (outcome.end == End::Answered) return;
  const std::string why = outcome.end == End::Threw ? outcome.text : "the compiler has crashed";
  const std::string printed = outcome.printed.empty() ? "" : ":\n" + outcome.printed;
  core::fail_input({}, why + printed, hint_for(outcome.printed));
}

}  // namespace stride::isolation

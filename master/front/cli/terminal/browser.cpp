#include "master/front/cli/terminal/browser.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::cli {
namespace {

/// The words of a command, with the file in place of %s or behind them.
std::vector<std::string> words(const std::string& command, const std::string& file) {
  std::vector<std::string> words;
  std::istringstream stream(command);
  bool has_file = false;
  for (std::string word; stream >> word;) {
    if (const std::size_t at = word.find("%s"); at != std::string::npos) {
      word.replace(at, 2, file);
      has_file = true;
    }
    words.push_back(word);
  }
  if (!has_file) words.push_back(file);
  return words;
}

/// What $BROWSER lists, separated by colons, or else the desktop's own program.
std::vector<std::string> browsers() {
  const char* const variable = std::getenv("BROWSER");
  if (variable == nullptr || *variable == '\0') return {"xdg-open"};
  std::vector<std::string> commands;
  std::istringstream list(variable);
  for (std::string command; std::getline(list, command, ':');) commands.push_back(command);
  return commands;
}

/// Whether there is such a program.
bool start(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  return ::posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ) == 0;
}

void open(const std::string& what, const std::string& shown) {
  for (const std::string& browser : browsers()) {
    if (start(words(browser, what))) return;
  }
  core::fail_run({},
                 fmt::format("cannot open {}: there is no xdg-open, and BROWSER names no program "
                             "that can be started",
                             shown),
                 fmt::format("open {} in a browser", what));
}

}  // namespace

void open_in_browser(const std::filesystem::path& file) {
  open(std::filesystem::absolute(file).string(), file.string());
}

void open_address_in_browser(const std::string& address) { open(address, address); }

}  // namespace stride::cli

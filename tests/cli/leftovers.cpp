#include "tests/cli/leftovers.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

namespace stride::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "STRIDE_TEST_RUN";

/// Empty for a process that ends meanwhile.
std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The names in a folder, of which files may go meanwhile.
std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code gone;
  for (fs::directory_iterator it(folder, gone), end; it != end; it.increment(gone)) {
    names.insert(it->path().filename().string());
    if (gone) break;
  }
  return names;
}

std::string name_of(const fs::path& process) {
  std::string name = content(process / "comm");
  if (!name.empty()) name.pop_back();
  return name;
}

}  // namespace

Leftovers::Leftovers() : shared_memory_(names_in("/dev/shm")) {
  static int count = 0;
  mark_ = std::to_string(::getpid()) + "-" + std::to_string(++count);
  ::setenv(kVariable, mark_.c_str(), 1);
}

Leftovers::~Leftovers() { ::unsetenv(kVariable); }

std::vector<pid_t> Leftovers::processes(const std::string& name) const {
  const std::string wanted = std::string(1, '\0') + kVariable + "=" + mark_ + '\0';
  std::vector<pid_t> found;
  for (const std::string& entry : names_in("/proc")) {
    if (entry.find_first_not_of("0123456789") != std::string::npos) continue;
    const fs::path process = fs::path("/proc") / entry;
    const std::string environment = '\0' + content(process / "environ");  // of a dead one: empty
    if (environment.find(wanted) == std::string::npos) continue;
    if (name.empty() || name_of(process) == name) found.push_back(std::stoi(entry));
  }
  return found;
}

std::vector<std::string> Leftovers::all() const {
  std::vector<std::string> found;
  for (const pid_t process : processes()) {
    const std::string id = std::to_string(process);
    found.push_back("process " + id + " " + name_of("/proc/" + id));
  }
  for (const std::string& name : names_in("/dev/shm")) {
    const bool is_of_another_test = name.rfind("stride-test-", 0) == 0;
    if (shared_memory_.count(name) == 0 && !is_of_another_test) found.push_back("/dev/shm/" + name);
  }
  return found;
}

std::vector<std::string> Leftovers::after_a_while() const {
  using namespace std::chrono_literals;
  for (int i = 0; i < 1000 && !all().empty(); ++i) std::this_thread::sleep_for(10ms);
  return all();
}

}  // namespace stride::tests

// What the tests of units in processes of their own share.
#ifndef STRIDE_TESTS_MASTER_LOADER_PROCESS_SUPPORT_H
#define STRIDE_TESTS_MASTER_LOADER_PROCESS_SUPPORT_H

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include "master/loader/process/hosted_unit.h"
#include "tests/master/loader/fmu/support.h"

namespace stride::tests {

/// Those that have not been waited for, living or not.
inline std::vector<pid_t> children(pid_t parent = ::getpid()) {
  const std::string id = std::to_string(parent);
  std::ifstream file("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> found;
  for (pid_t child = 0; file >> child;) found.push_back(child);
  return found;
}

inline bool lives(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text[name_end + 2] != 'Z' && text[name_end + 2] != 'X';
}

/// Whoever adopts a process may take a while to bury it.
inline bool has_ended(pid_t process) {
  for (int i = 0; i < 1000 && lives(process); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !lives(process);
}

/// What has to be as it was when a unit is gone: the children and the open files of this process.
struct Belongings {
  std::vector<pid_t> processes = children();
  std::ptrdiff_t files = std::distance(fs::directory_iterator("/proc/self/fd"), {});
  bool operator==(const Belongings&) const = default;
};

/// The temporary folders of this user that are still there.
inline std::vector<fs::path> left_folders(const Scratch& scratch) {
  std::vector<fs::path> found;
  const fs::path parent = scratch / "tmp" / ("stride-" + std::to_string(::getuid()));
  for (const auto& entry : fs::directory_iterator(parent)) found.push_back(entry.path());
  return found;
}

/// A unit with access by name, and what reaches its log.
class Fixture {
 public:
  struct Line {
    importer::Status status;
    std::string category, text;
  };

  explicit Fixture(const std::string& unit, bool is_hosted = true, isolation::HostOptions host = {},
                   importer::InstanceOptions options = {}, const std::string& name = "u")
      : fmu_(importer::Fmu::load(test_fmu(unit))) {
    options.where = {"system.ssd", 7};
    options.log = [this](const std::string&, importer::Status status, const std::string& category,
                         const std::string& text) {
      log.push_back({status, category, text});
    };
    unit_ = is_hosted ? isolation::instantiate(fmu_, name, std::move(options), std::move(host))
                      : fmu_->instantiate(name, std::move(options));
  }

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }
  void destroy() { unit_.reset(); }

  const core::Variable& variable(const std::string& name) const {
    return fmu_->description()->variables.at(fmu_->description()->find(name).value());
  }
  core::ValueBlock get(const std::string& name) {
    core::ValueBlock block(variable(name).type, variable(name).size);
    unit_->get(std::span(&variable(name).reference, 1), block);
    return block;
  }
  void set(const std::string& name, const core::ValueBlock& values) {
    unit_->set(std::span(&variable(name).reference, 1), values);
  }
  /// The value from its text, as a scenario gives it.
  void set(const std::string& name, const std::string& text) {
    set(name, core::parse(variable(name), text));
  }
  double number(const std::string& name) { return get(name).numbers<double>()[0]; }

  void start(std::initializer_list<std::pair<std::string, std::string>> values = {}) {
    for (const auto& [name, text] : values) set(name, text);
    unit_->enter_initialization({}, std::nullopt);
    unit_->exit_initialization();
    if (!fmu_->description()->has_event_mode) return;
    unit_->update_discrete_states();
    unit_->enter_step_mode();
  }
  core::StepResult step(double from, double to) {
    return unit_->step({time_from_seconds(from), time_from_seconds(to)});
  }

  /// The process in which the unit lives, and the one between it and this one.
  static pid_t supervisor() { return children().at(0); }
  static pid_t server() { return children(supervisor()).at(0); }

  std::vector<Line> log;

 private:
  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

}  // namespace stride::tests

#endif

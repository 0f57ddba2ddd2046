// Designs of SystemC's own distribution, each of their modules as a unit, beside their own sc_main.
#ifndef STRIDE_TESTS_INTEROP_SYSTEMC_NETWORK_H
#define STRIDE_TESTS_INTEROP_SYSTEMC_NETWORK_H

#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"

namespace stride::tests {

/// What is printed while f runs, by C or by C++.
template <class Function>
std::string printed(Function f) {
  std::cout.flush();
  std::fflush(nullptr);
  std::FILE* const file = std::tmpfile();
  const int saved = dup(1);
  dup2(fileno(file), 1);
  f();
  std::cout.flush();
  std::fflush(nullptr);
  dup2(saved, 1);
  close(saved);
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

/// What f prints in a process of its own, for a design that keeps its state in globals.
template <class Function>
std::string printed_apart(Function f) {
  return printed([&] {
    const pid_t child = fork();
    if (child == 0) {
      f();
      std::cout.flush();
      std::fflush(nullptr);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
  });
}

/// Without SystemC's own lines, which a unit sends to its log.
inline std::string without_reports(const std::string& text) {
  return text.substr(0, text.find("\nInfo: "));
}

/// Units that exchange values at the ends of equal steps.
class Network {
 public:
  template <class Module, class Function>
  UnitDriver& add(Function rows) {
    units_.push_back(std::make_unique<UnitDriver>(std::make_unique<Rows<Module>>(rows)));
    return *units_.back();
  }
  template <class T>
  void connect(UnitDriver& from, const std::string& output, UnitDriver& to,
               const std::string& input) {
    T& source = from.value<T>(output);
    T& sink = to.value<T>(input);
    transfers_.push_back([&source, &sink] { sink = source; });
  }
  void initialize() {
    for (auto& unit : units_) unit->initialize();
    exchange();
  }
  /// Returns whether the simulation goes on.
  bool step(Duration size) {
    bool goes_on = true;
    for (auto& unit : units_) {
      unit->step(unit->now() + size, false);
      goes_on &= !unit->terminates();
    }
    exchange();
    return goes_on;
  }

 private:
  void exchange() {
    for (const auto& transfer : transfers_) transfer();
  }
  std::vector<std::unique_ptr<UnitDriver>> units_;
  std::vector<std::function<void()>> transfers_;
};

/// What two of these networks print that are advanced in turns, each for so many steps at most.
template <class Make>
std::pair<std::string, std::string> printed_by_two(Make make, Duration step, int steps) {
  Network networks[2];
  std::string texts[2];
  bool go_on[2] = {true, true};
  for (int n = 0; n < 2; ++n) make(networks[n]);
  for (int n = 0; n < 2; ++n) texts[n] += printed([&] { networks[n].initialize(); });
  for (int i = 0; i < steps; ++i) {
    for (int n = 0; n < 2; ++n) {
      if (go_on[n]) texts[n] += printed([&] { go_on[n] = networks[n].step(step); });
    }
  }
  return {texts[0], texts[1]};
}

}  // namespace stride::tests

#endif

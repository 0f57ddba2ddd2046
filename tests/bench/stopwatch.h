// How long a run's communication steps take, without its initialisation.
#ifndef STRIDE_TESTS_BENCH_STOPWATCH_H
#define STRIDE_TESTS_BENCH_STOPWATCH_H

#include <chrono>

#include "master/engine/run/simulation.h"

namespace stride::bench {

using Wall = std::chrono::steady_clock;

inline double seconds_since(Wall::time_point began) {
  return std::chrono::duration<double>(Wall::now() - began).count();
}

/// Notes when the initial instant is done.
struct Started : core::Observer {
  Wall::time_point at{};
  void on_communication_point(Time time) override {
    if (time == Time{}) at = Wall::now();
  }
};

/// Runs it from 0 s and returns the seconds from the initial instant to the end.
inline double time_steps(core::Simulation& simulation) {
  Started started;
  simulation.add_observer(started);
  simulation.run();
  return seconds_since(started.at);
}

}  // namespace stride::bench

#endif

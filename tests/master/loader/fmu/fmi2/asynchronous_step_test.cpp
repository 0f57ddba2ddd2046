#include "master/loader/fmu/fmi2/asynchronous_step.h"

#include <thread>

#include <catch2/catch.hpp>

using namespace std::chrono_literals;
using stride::importer::AsynchronousStep;
using stride::importer::Status;

TEST_CASE("a wait for a step that does not finish ends after the given time") {
  AsynchronousStep step;
  step.begin();
  CHECK_FALSE(step.wait(1us));
}

TEST_CASE("a step may finish before anyone waits, and a new one is not finished") {
  AsynchronousStep step;
  step.begin();
  step.finish(Status::Discard);
  CHECK(step.wait(1us) == Status::Discard);
  CHECK(step.wait(1us) == Status::Discard);
  step.begin();
  CHECK_FALSE(step.wait(1us));
}

TEST_CASE("a step finishes on another thread") {
  AsynchronousStep step;
  for (int i = 0; i < 200; ++i) {
    step.begin();
    std::thread unit([&] { step.finish(Status::Warning); });
    CHECK(step.wait(1h) == Status::Warning);
    unit.join();
  }
}

TEST_CASE("a callback that comes late is not that of the next step") {
  AsynchronousStep step;
  step.begin();
  step.note_polled();  // the unit has said how it ended, before its callback came
  step.begin();
  step.finish(Status::Ok);
  CHECK_FALSE(step.wait(1us));
  step.finish(Status::Error);
  CHECK(step.wait(1us) == Status::Error);
  step.note_polled();  // but that one has come
  step.begin();
  step.finish(Status::Ok);
  CHECK(step.wait(1us) == Status::Ok);
}

TEST_CASE("a callback with the status pending has no effect") {
  AsynchronousStep step;
  step.begin();
  step.finish(Status::Pending);
  CHECK_FALSE(step.wait(1us));
}

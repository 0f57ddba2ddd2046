#include "master/loader/fmu/instance/unit_call.h"

#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "master/loader/fmu/instance/present_call.h"

using namespace stride;
using namespace stride::importer;

TEST_CASE("the calls that a process has left are named, whatever it has done to its memory") {
  share_calls();
  const pid_t process = ::fork();
  if (process == 0) {
    auto& call = *new PresentCall("fuse", core::Location{"a.ssd", 7}, nullptr);
    call.begin("fmi3DoStep", Time(std::chrono::seconds(2)));
    auto& other = *new PresentCall("idle", core::Location{}, nullptr);
    other.begin("fmi3GetFloat64", {});
    other.end();
    auto& damaged = *new PresentCall("wild", core::Location{}, nullptr);
    damaged.begin(reinterpret_cast<const char*>(8), {});
    ::_exit(0);
  }
  ::waitpid(process, nullptr, 0);
  const std::vector<UnitCall> calls = left_calls(&this_thread);
  REQUIRE(calls.size() == 2);
  CHECK(calls[0].function == "fmi3DoStep");
  CHECK(calls[0].unit == "fuse");
  CHECK(calls[0].where.file == "a.ssd");
  CHECK(calls[0].where.line == 7);
  CHECK(calls[0].time == Time(std::chrono::seconds(2)));
  CHECK(calls[0].is_by_thread);
  CHECK(calls[1].unit == "wild");
  CHECK(calls[1].function == "a function whose name is lost");
  CHECK_FALSE(left_calls(nullptr)[0].is_by_thread);
  CHECK(left_library_work().what.view().empty());
}

TEST_CASE("the call that a process has left in a row is that of one of its instances") {
  share_calls();
  const bool is_within = GENERATE(true, false);
  const pid_t process = ::fork();
  if (process == 0) {
    auto& fuse = *new PresentCall("fuse", core::Location{"a.ssd", 7}, nullptr);
    auto& lamp = *new PresentCall("lamp", core::Location{"a.ssd", 9}, nullptr);
    PresentCall* const members[] = {&fuse, &lamp};
    auto& row = *new RowCall(members);
    row.begin(fuse, fuse.left(), Time(std::chrono::seconds(2)));
    row.begin_next("fmi3DoStep");
    row.begin_member(lamp, lamp.left(), Time(std::chrono::seconds(2)));
    row.begin_next("fmi3SetFloat64");
    if (!is_within) row.end();
    ::_exit(0);
  }
  ::waitpid(process, nullptr, 0);
  const std::vector<UnitCall> calls = left_calls(&this_thread);
  REQUIRE(calls.size() == (is_within ? 1 : 0));
  if (!is_within) return;
  CHECK(calls[0].function == "fmi3SetFloat64");
  CHECK(calls[0].unit == "lamp");
  CHECK(calls[0].where.line == 9);
  CHECK(calls[0].time == Time(std::chrono::seconds(2)));
  CHECK(calls[0].is_by_thread);
}

TEST_CASE("the present call of a row is one of the instance that is called, and of no other") {
  PresentCall fuse("fuse", core::Location{}, nullptr), lamp("lamp", core::Location{}, nullptr);
  PresentCall* const members[] = {&fuse, &lamp};
  RowCall row(members);
  for (PresentCall* const member : members) member->set_row(&row);
  row.begin(fuse, fuse.left(), {});
  row.begin_next("fmi3DoStep");
  CHECK(fuse.is_by_this_thread());
  CHECK(std::string(fuse.function()) == "fmi3DoStep");
  CHECK(lamp.function() == nullptr);
  row.begin_member(lamp, lamp.left(), {});
  CHECK(fuse.function() == nullptr);
  CHECK(lamp.is_in_sequence());
  std::thread([&] {
    CHECK(lamp.function() != nullptr);
    CHECK_FALSE(lamp.is_by_this_thread());
  }).join();
  row.end();
  CHECK(lamp.function() == nullptr);
  CHECK(fuse.last_function_of_thread() == nullptr);
  CHECK(std::string(lamp.last_function_of_thread()) == "fmi3DoStep");
  fuse.begin("fmi3GetFloat64", {});
  fuse.end();
  CHECK(lamp.last_function_of_thread() == nullptr);
  CHECK(std::string(fuse.last_function_of_thread()) == "fmi3GetFloat64");
}

TEST_CASE("the last call of a thread is known when it has returned") {
  PresentCall fuse("fuse", core::Location{}, nullptr), idle("idle", core::Location{}, nullptr);
  fuse.begin("fmi3DoStep", {});
  fuse.end();
  CHECK(std::string(fuse.last_function_of_thread()) == "fmi3DoStep");
  idle.begin("fmi3GetFloat64", {});
  idle.end();
  CHECK(fuse.last_function_of_thread() == nullptr);
  CHECK(std::string(idle.last_function_of_thread()) == "fmi3GetFloat64");
  std::thread([&] { CHECK(idle.last_function_of_thread() == nullptr); }).join();
}

#include "master/isolation/process/shared_note.h"

#include <csignal>
#include <string>

#include <catch2/catch.hpp>

#include "master/isolation/process/child.h"

using namespace stride::isolation;

TEST_CASE("a note outlives its writer, and is cut off where it is too long") {
  SharedNote note;
  run_in_child([&] {
    note.write(std::string(1000, 'x').c_str(), -7);
    std::raise(SIGKILL);
    return std::string();
  });
  CHECK(note.what() == std::string(119, 'x'));
  CHECK(note.picoseconds() == -7);
  note.clear();
  CHECK(note.what().empty());
}

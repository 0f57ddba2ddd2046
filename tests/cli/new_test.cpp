// stride new: first files, which run as they are. install_test builds those of units.
#include "master/base/files/input_file.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

Outcome make_new(const Scratch& scratch, Arguments further) {
  further.insert(further.begin(), "new");
  return run_program(further, scratch.path());
}

}  // namespace

TEST_CASE("a new scenario runs as it is, and its checks pass") {
  const Scratch scratch;
  const Outcome made = make_new(scratch, {"cold_room"});
  CHECK(made.err == "");
  CHECK(made.exit_code == 0);
  CHECK(made.out ==
        "cold_room/cold_room.ssd\n\nNext:\n  cd cold_room\n  stride run cold_room.ssd\n");
  const Outcome ran = run_program({"run", "cold_room.ssd"}, scratch / "cold_room");
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("it is warm again    passed") && !Contains("undecided"));
}

TEST_CASE("new units have their name everywhere, and the commands to build them are shown") {
  const Scratch scratch;
  const bool is_systemc = GENERATE(false, true);
  const Outcome made = make_new(
      scratch, {"two_point", is_systemc ? "--systemc" : "--unit", "--out", "some where/else"});
  CHECK(made.exit_code == 0);
  CHECK_THAT(made.out, Contains("some where/else/two_point.ssd\n") &&
                           Contains("  cd 'some where/else'\n  cmake -B build") &&
                           Contains("  ctest --test-dir build"));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(scratch / "some where/else")) {
    const std::string text = stride::core::read_input(entry.path());
    CHECK_THAT(text, Contains("two_point") && !Contains("@"));
    ++files;
  }
  CHECK(files == (is_systemc ? 4 : 3));
  CHECK_THAT(stride::core::read_input(scratch / "some where/else/unit.cpp"),
             Contains("class TwoPointUnit : "));
}

TEST_CASE("what cannot be a name, or is there already, is refused and changes nothing") {
  const Scratch scratch;
  for (const char* name :
       {"1st", "a-b", "a__b", "_a", "double", "test", "stride", "", "a/b", "ä"}) {
    const Outcome refused = make_new(scratch, {name});
    INFO(name);
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains(std::string("NAME is '") + name + "'"));
  }
  CHECK(std::distance(fs::directory_iterator(scratch.path()), {}) ==
        1);  // that for temporary files
  scratch.write("there/file", "mine");
  const Outcome there = make_new(scratch, {"there"});
  CHECK(there.exit_code == 2);
  CHECK_THAT(there.err, Contains("there: it is there already, and is no empty folder"));
  const Outcome behind = make_new(scratch, {"a", "--out", "there/file/a"});
  CHECK(behind.exit_code == 2);
  CHECK_THAT(behind.err, Contains("there/file/a: cannot make the folder"));
  CHECK(stride::core::read_input(scratch / "there/file") == "mine");
}

TEST_CASE("an empty folder is taken") {
  const Scratch scratch;
  fs::create_directory(scratch / "empty");
  CHECK(make_new(scratch, {"empty"}).exit_code == 0);
  CHECK(fs::exists(scratch / "empty/empty.ssd"));
}

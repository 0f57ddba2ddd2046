// What a report is made of: damaged results are read, or refused with file and line.
#include <array>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "master/report/results.h"
#include "master/util/error.h"
#include "tests/fuzz/mutator.h"
#include "tests/master/ssp/support.h"

using namespace stride;
using tests::Mutator;

namespace {

struct File {
  const char* name;
  std::string text;
};

const std::array<File, 5> kFiles{{
    {"run.json", R"({"outcome": "completed", "files": {"signals": "signals.csv"},
"signals": [{"name": "a.x", "unit": "m", "type": "Float64", "variability": "continuous"},
{"name": "a.n", "unit": "", "type": "UInt64", "variability": "discrete"}],
"units": [{"name": "a", "model": "A"}], "connections": [{"from": "a.x", "to": "b.u"}],
"plots": [{"title": "X", "signals": ["a.x"]}]})"},
    {"signals.csv",
     "time,a.x [m],a.n,a.text,a.on\n0,1,7,\"a\"\"b\",true\n0.001,1e-9,18446744073709551615,\"\","
     "false\n1,nan,0,\"x, y\",true\n"},
    {"events.csv",
     "time,index,component,variable,direction,payload,content\n0.5,0,a,y,sent,00ff,\"set, on\"\n"},
    {"activity.csv", "time,until,component,kind\n0,0,a,event\n0,1,\"b, c\",idle\n"},
    {"units/world/film/frames.csv", "time,file\n0,0.jpg\n0.5,1.jpg\n"},
}};

/// All columns have as many rows as there are times.
void check(const report::Results& results) {
  for (const report::Column& column : results.signals.columns) {
    REQUIRE(column.size() == results.signals.times.size());
  }
  for (const report::Activities& activities : results.activities) {
    REQUIRE(activities.from.size() == activities.until.size());
  }
  for (const report::Film& film : results.films) REQUIRE(film.times.size() == film.pictures.size());
}

}  // namespace

TEST_CASE("mutated results are read, or refused with the file that is wrong") {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "units/world/film");
  folder.write("units/world/film/0.jpg", "");
  folder.write("units/world/film/1.jpg", "");
  for (const File& file : kFiles) folder.write(file.name, file.text);
  check(report::read_results(folder / "", {}));
  for (const File& file : kFiles) {
    Mutator mutator(20260509, ",\"\n.0123456789-e[]{}:truefalsn");
    int accepted = 0;
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
      folder.write(file.name, mutator.mutate(file.text));
      try {
        check(report::read_results(folder / "", {}, {.signals = {.values = 20}, .messages = 3}));
        ++accepted;
      } catch (const core::Error& error) {
        ++refused;
        const std::string expected = (folder / file.name).string() + ":";
        CHECK(std::string(error.what()).rfind(expected, 0) == 0);
      }
    }
    INFO(file.name);
    CHECK(accepted > 10);
    CHECK(refused > 20);
    folder.write(file.name, file.text);
  }
}

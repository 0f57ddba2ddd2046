#include "master/front/cli/program/repeated_options.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "tests/scratch_folder.h"

using stride::cli::with_repeated_options;
using Words = std::vector<std::string>;

TEST_CASE("an option that may be repeated takes all values behind it") {
  CHECK(with_repeated_options({"run", "--set", "a=1", "b.c=2", "x.ssd"}) ==
        Words{"run", "--set", "a=1", "--set", "b.c=2", "x.ssd"});
  CHECK(with_repeated_options({"--set=a=1", "b=2", "c=3"}) ==
        Words{"--set=a=1", "--set", "b=2", "--set", "c=3"});
  CHECK(with_repeated_options({"--swap", "a=x.fmu", "b=y.fmu", "--set", "c=1"}) ==
        Words{"--swap", "a=x.fmu", "--swap", "b=y.fmu", "--set", "c=1"});
}

TEST_CASE("other words stay what they are") {
  for (const Words& words : {Words{}, Words{"--set"}, Words{"run", "x.ssd", "a=1"},
                             Words{"--set", "a=1", "--stop", "b=2"},
                             Words{"--set", "a=1", "x.ssd", "b=2"}, Words{"--out", "a=1", "b=2"},
                             Words{"--set", "a=1", "=2"}, Words{"--settings", "a=1", "b=2"}}) {
    CHECK(with_repeated_options(words) == words);
  }
}

TEST_CASE("a file whose name has an equals sign is a file") {
  const stride::tests::ScratchFolder folder;
  const std::string file = folder / "a=1.ssd";
  std::ofstream(file) << "";
  CHECK(with_repeated_options({"--set", "b=1", file}) == Words{"--set", "b=1", file});
}

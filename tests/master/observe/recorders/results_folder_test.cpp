#include "master/observe/recorders/results_folder.h"

#include <catch2/catch.hpp>
#include <sys/prctl.h>
#include <unistd.h>

#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using Catch::Contains;

TEST_CASE("The folder is made with those above it, and may exist") {
  const TemporaryFolder folder;
  make_results_folder(folder / "a/b/c");
  CHECK(std::filesystem::is_directory(folder / "a/b/c"));
  CHECK_NOTHROW(make_results_folder(folder / "a/b/c"));
}

TEST_CASE("What cannot be a results folder is named with the reason") {
  const TemporaryFolder folder;
  folder.write("file", "");
  CHECK_THROWS_WITH(make_results_folder(folder / "file"),
                    Contains((folder / "file").string() + ": cannot write results") &&
                        Contains("it is a file") && Contains("choose another results folder"));
  CHECK_THROWS_WITH(make_results_folder(folder / "file/b"), Contains("Not a directory"));
  CHECK_THROWS_WITH(make_results_folder("/proc/stride"), Contains("cannot write results"));
  CHECK_THROWS_WITH(make_results_folder(""), Contains("its name is empty"));
}

TEST_CASE("Only one run at a time has a results folder, and the process that has it is named") {
  const TemporaryFolder folder;
  ::prctl(PR_SET_NAME, "sensor");  // as that of a unit
  {
    const ResultsLock lock(folder / ".");
    CHECK_THROWS_WITH(ResultsLock(folder / "."), Contains("process " + std::to_string(::getpid()) +
                                                          " ('sensor') has locked this folder") &&
                                                     Contains("--out"));
  }
  CHECK_NOTHROW(ResultsLock(folder / "."));
}

TEST_CASE("The files of an earlier run go, and nothing else") {
  const TemporaryFolder folder;
  for (const char* file : {"run.json", "page.html", "report.html", "signals.csv"}) {
    folder.write(file, "");
  }
  ResultFiles files;
  files.report = "page.html";
  remove_results(folder / "", files);
  CHECK_FALSE(std::filesystem::exists(folder / "run.json"));
  CHECK_FALSE(std::filesystem::exists(folder / "page.html"));
  CHECK_FALSE(std::filesystem::exists(folder / "signals.csv"));
  CHECK(std::filesystem::exists(folder / "report.html"));
  std::filesystem::create_symlink("signals.csv", folder / "run.json");
  files.report.clear();
  remove_results(folder / "", files);
  CHECK(std::filesystem::is_symlink(folder / "run.json"));
}

TEST_CASE("A link that leads nowhere is no results folder") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("nowhere", folder / "link");
  CHECK_THROWS_WITH(
      make_results_folder(folder / "link"),
      Contains("it is a link to 'nowhere', which does not exist") && Contains("make that folder"));
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const char* name : {"loop", "loop/further"}) {
    CHECK_THROWS_WITH(make_results_folder(folder / name),
                      Contains("symbolic link") && Contains("leads back to itself"));
  }
}

TEST_CASE("The names of results are not longer than the folder allows") {
  const TemporaryFolder folder;
  ResultFiles files;
  files.statistics = std::string(255, 'x');
  CHECK_NOTHROW(check_name_lengths(folder / "", files));
  files.statistics += 'x';
  CHECK_THROWS_WITH(
      check_name_lengths(folder / "", files),
      Contains("has 256 bytes, and 255 at most") && Contains("<stride:Results statistics="));
}

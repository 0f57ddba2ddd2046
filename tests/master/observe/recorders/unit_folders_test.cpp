#include "master/observe/recorders/unit_folders.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/master/system/ssp/support.h"

using namespace stride::recorders;
using namespace stride::tests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// With the folders above it.
void write(const TemporaryFolder& folder, const std::string& file) {
  fs::create_directories((folder / file).parent_path());
  folder.write(file, "");
}

}  // namespace

TEST_CASE("Each component has the name of a folder, and the other way round") {
  const auto [component, folder] = GENERATE(table<std::string, std::string>({
      {"sensor", "sensor"},
      {"arm.joint 1", "arm.joint 1"},
      {"a/b", "a%2Fb"},
      {"a%2Fb", "a%252Fb"},
      {"100%", "100%25"},
      {"%", "%25"},
      {"", "%"},
      {".", "%2E"},
      {"..", "%2E%2E"},
      {"...", "..."},
      {"../x", "..%2Fx"},
      {"%2E", "%252E"},
      {"Füllstand", "Füllstand"},
  }));
  CHECK(unit_folder_name(component) == folder);
  CHECK(component_of_folder(folder) == component);
  CHECK(unit_folder("out", component) == fs::path("out/units") / folder);
}

TEST_CASE("The folders exist as long as the object, and longer if something is in them") {
  const TemporaryFolder folder;
  const std::vector<std::string> components{"a", "b/c"};
  {
    const UnitFolders folders(folder / "", components);
    CHECK(fs::is_directory(folder / "units/a"));
    CHECK(fs::is_directory(folder / "units/b%2Fc"));
    CHECK_FALSE(has_unit_files(folder / ""));
    folder.write("units/a/trace.vcd", "");
    CHECK(has_unit_files(folder / ""));
    CHECK_NOTHROW(UnitFolders(folder / "", {}));
  }
  CHECK(fs::exists(folder / "units/a/trace.vcd"));
  CHECK_FALSE(fs::exists(folder / "units/b%2Fc"));
  fs::remove(folder / "units/a/trace.vcd");
  { const UnitFolders folders(folder / "", components); }
  CHECK_FALSE(fs::exists(folder / "units"));
  CHECK_FALSE(has_unit_files(folder / ""));
}

TEST_CASE("A file in the place of a component's folder is an error") {
  const TemporaryFolder folder;
  write(folder, "units/a");
  const std::vector<std::string> components{"a"};
  CHECK_THROWS_WITH(
      UnitFolders(folder / "", components),
      Contains((folder / "units/a").string() + ": cannot make this folder for files of a unit"));
}

TEST_CASE("Of a film of an earlier run nothing else goes") {
  const TemporaryFolder folder;
  for (const char* file :
       {"units/world/film/frames.csv", "units/world/film/00000.jpg", "units/arm/film/frames.csv",
        "units/arm/film/00000.jpg", "units/arm/film/notes.jpg", "units/mine/film/00001.jpg"}) {
    write(folder, file);
  }
  clean_unit_folders(folder / "", {});
  CHECK_FALSE(fs::exists(folder / "units/world"));
  CHECK_FALSE(fs::exists(folder / "units/arm/film/frames.csv"));
  CHECK_FALSE(fs::exists(folder / "units/arm/film/00000.jpg"));
  CHECK(fs::exists(folder / "units/arm/film/notes.jpg"));
  CHECK(fs::exists(folder / "units/mine/film/00001.jpg"));
}

TEST_CASE("Links of an earlier run go before its films, and are not followed") {
  const TemporaryFolder folder;
  write(folder, "album/frames.csv");
  write(folder, "album/00000.jpg");
  write(folder, "units/world/trace.vcd");
  fs::create_symlink(folder / "album", folder / "units/world/film");
  fs::create_symlink(folder / "album", folder / "units/link");
  fs::create_directory(folder / "units/mine");
  fs::create_symlink(folder / "album", folder / "units/mine/film");
  REQUIRE(::mkfifo((folder / "units/world/fifo").c_str(), 0600) == 0);
  const std::vector<std::string> components{"world"};
  clean_unit_folders(folder / "", components);
  CHECK(fs::exists(folder / "album/00000.jpg"));
  CHECK(fs::exists(folder / "album/frames.csv"));
  CHECK(fs::exists(folder / "units/world/trace.vcd"));
  for (const char* file : {"units/world/film", "units/world/fifo"}) {
    CHECK_FALSE(fs::exists(fs::symlink_status(folder / file)));
  }
  for (const char* file : {"units/link", "units/mine/film"}) {  // of no unit of this run
    CHECK(fs::exists(fs::symlink_status(folder / file)));
  }
}

TEST_CASE("A name that is too long for a folder is shortened, differently for each") {
  const std::string longest(255, 'n');
  CHECK(unit_folder_name(longest) == longest);
  const std::string one = longest + "a", other = longest + "b";
  CHECK(unit_folder_name(one).size() == 255);
  CHECK(unit_folder_name(one) != unit_folder_name(other));
  CHECK(unit_folder_name(one) == unit_folder_name(one));
  CHECK_THAT(component_of_folder(unit_folder_name(one)),
             Catch::StartsWith("nnn") && Catch::EndsWith("n…"));
  const TemporaryFolder folder;
  const std::vector<std::string> components{one, std::string(200, '/'), std::string(200, '%')};
  const UnitFolders folders(folder / "", components);
  for (const std::string& component : components) {
    CHECK(fs::is_directory(unit_folder(folder / "", component)));
  }
}

TEST_CASE("A path into the folders of units is recognized, also through links") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "out/units/a");
  fs::create_directory_symlink(folder / "out/units/a", folder / "link");
  fs::create_symlink(folder / "out/units/a/x", folder / "file");
  const fs::path out = folder / "out";
  for (const char* inside : {"out/units/a/x", "out/units/b/x", "out/units",
                             "out/./units/../units/x", "link/x", "file"}) {
    INFO(inside);
    CHECK(is_in_unit_folders(out, folder / inside));
  }
  for (const char* outside : {"out/x", "out/unitsx", "out/units/../x", "x", "other/units/x"}) {
    INFO(outside);
    CHECK_FALSE(is_in_unit_folders(out, folder / outside));
  }
}

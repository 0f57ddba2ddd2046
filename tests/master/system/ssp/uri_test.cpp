#include "master/system/ssp/uri.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::filesystem::path resolve(const std::string& source,
                              const std::filesystem::path& base = "runs") {
  const TemporaryFolder folder;
  const stride::xml::Document document(folder.write("x.ssd", "<a source='" + source + "'/>"));
  std::vector<std::string> warnings;
  return source_path(document.root(), {&base, 1}, warnings);
}

}  // namespace

TEST_CASE("A source is a path relative to the scenario's folder") {
  CHECK(resolve("unit.fmu") == "runs/unit.fmu");
  CHECK(resolve("unit.fmu", "") == "unit.fmu");
  CHECK(resolve("./a/../unit.fmu") == "runs/unit.fmu");
  CHECK(resolve("../units/unit.fmu") == "units/unit.fmu");
  CHECK(resolve("/opt/unit.fmu") == "/opt/unit.fmu");
  CHECK(resolve("my%20unit%2b.fmu") == "runs/my unit+.fmu");
  CHECK(resolve(" unit.fmu\n") == "runs/unit.fmu");
}

TEST_CASE("The scheme file is understood") {
  CHECK(resolve("file:///opt/unit.fmu") == "/opt/unit.fmu");
  CHECK(resolve("file://localhost/opt/unit.fmu") == "/opt/unit.fmu");
  CHECK(resolve("FILE:/opt/unit.fmu") == "/opt/unit.fmu");
  CHECK(resolve("file:unit.fmu") == "runs/unit.fmu");
}

TEST_CASE("What names no file here is refused") {
  CHECK_THROWS_WITH(resolve("https://example.org/unit.fmu"),
                    Contains("only files can be read, not 'https:'") && Contains("download it"));
  CHECK_THROWS_WITH(resolve("file://server/unit.fmu"), Contains("on another machine"));
  CHECK_THROWS_WITH(resolve("//server/unit.fmu"), Contains("on another machine"));
  CHECK_THROWS_WITH(resolve("file://server"), Contains("on another machine"));
  CHECK_THROWS_WITH(resolve("a.ssp#b.ssd"), Contains("does not support a source with a fragment"));
  CHECK_THROWS_WITH(resolve("a.fmu?b"), Contains("has a query") && Contains("%3F"));
  CHECK_THROWS_WITH(resolve("50%.fmu"), Contains("not followed by two hexadecimal digits"));
  CHECK_THROWS_WITH(resolve("a%2"), Contains("not followed by two hexadecimal digits"));
  CHECK_THROWS_WITH(resolve("a%00b"), Contains("not followed by two hexadecimal digits"));
  CHECK_THROWS_WITH(resolve(""), Contains("'source' of <a> is empty"));
}

TEST_CASE("a source that is no proper URI names the file that it can only mean") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "resources");
  std::filesystem::create_directory(folder / "sub");
  for (const char* name : {"50%.fmu", "a#b.fmu", "resources/in.fmu", "sub/unit.fmu"}) {
    folder.write(name, "");
  }
  const std::filesystem::path base = folder / "";
  CHECK(resolve("50%.fmu", base) == folder / "50%.fmu");
  CHECK(resolve("a#b.fmu", base) == folder / "a#b.fmu");
  CHECK(resolve("sub\\unit.fmu", base) == folder / "sub/unit.fmu");
  CHECK(resolve("in.fmu", base) == folder / "resources/in.fmu");
  CHECK(resolve("file://resources/in.fmu", base) == folder / "resources/in.fmu");
  CHECK(resolve("absent.fmu", base) == folder / "absent.fmu");
  CHECK(resolve("IN.fmu", base) == folder / "resources/in.fmu");
  CHECK(resolve("SUB\\Unit.fmu", base) == folder / "sub/unit.fmu");
}

TEST_CASE("a path of Windows and a server for FMUs are refused by name") {
  CHECK_THROWS_WITH(resolve("C:/units/unit.fmu"), Contains("is a path of Windows"));
  CHECK_THROWS_WITH(resolve("file:///C:/units/unit.fmu"), Contains("is a path of Windows"));
  CHECK_THROWS_WITH(resolve("file:///c%3A/units/unit.fmu"), Contains("is a path of Windows"));
  for (const std::string scheme : {"proxyfmu", "proxy-fmu"}) {
    CHECK_THROWS_WITH(resolve(scheme + "://localhost?file=unit.fmu"),
                      Contains("proxy-fmu") && Contains("<stride:Host"));
  }
}

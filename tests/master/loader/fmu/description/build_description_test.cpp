#include "master/loader/fmu/description/build_description.h"

#include "master/loader/fmu/description/binaries.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::BuildDescription;

namespace {

core::UnitDescription unit(const std::string& version) {
  core::UnitDescription unit;
  unit.fmi_version = version;
  unit.model_identifier = "tank";
  return unit;
}

BuildDescription read_fmi3(const Scratch& scratch, const std::string& configurations) {
  scratch.write("sources/buildDescription.xml", "<fmiBuildDescription fmiVersion=\"3.0\">" +
                                                    configurations + "</fmiBuildDescription>");
  return importer::read_build_description(scratch / "modelDescription.xml", unit("3.0"));
}

std::string configuration(const std::string& inside, const std::string& attributes = "") {
  return "<BuildConfiguration modelIdentifier=\"tank\" " + attributes + ">" + inside +
         "</BuildConfiguration>";
}

}  // namespace

TEST_CASE("a build description of FMI 3.0 is read") {
  const Scratch scratch;
  const BuildDescription build = read_fmi3(
      scratch, configuration("<SourceFileSet language=\"C99\" compilerOptions=\"-O1 -g\">"
                             "<SourceFile name=\"tank.c\"/><SourceFile name=\"more/pipe.c\"/>"
                             "<PreprocessorDefinition name=\"SIZE\" value=\"3\"/>"
                             "<PreprocessorDefinition name=\"FAST\"/>"
                             "<PreprocessorDefinition name=\"DEBUG\" optional=\"true\"/>"
                             "<IncludeDirectory name=\"include\"/></SourceFileSet>"
                             "<SourceFileSet compiler=\"msvc\" compilerOptions=\"/W4\">"
                             "<SourceFile name=\"valve.cpp\"/></SourceFileSet>"
                             "<Library name=\"pthread\" external=\"true\"/>"));
  REQUIRE(build.sets.size() == 2);
  const importer::SourceFileSet& set = build.sets[0];
  CHECK(set.language == "C99");
  CHECK(set.files == std::vector<fs::path>{"tank.c", "more/pipe.c"});
  CHECK(set.definitions == std::vector<std::string>{"SIZE=3", "FAST"});
  CHECK(set.includes == std::vector<fs::path>{"include"});
  CHECK(set.options == std::vector<std::string>{"-O1", "-g"});
  CHECK(build.sets[1].options.empty());
  CHECK(build.libraries == std::vector<std::string>{"pthread"});
}

TEST_CASE("the configuration for this platform counts, or else that for any") {
  const auto source = [](const std::string& name) {
    return "<SourceFileSet><SourceFile name=\"" + name + "\"/></SourceFileSet>";
  };
  const Scratch scratch;
  const std::string any = configuration(source("any.c"));
  const std::string ours =
      configuration(source("ours.c"), std::string("platform=\"") + importer::platform() + "\"");
  const std::string other = configuration(source("other.c"), "platform=\"riscv-plan9\"");
  CHECK(read_fmi3(scratch, other + any).sets[0].files.front() == "any.c");
  CHECK(read_fmi3(scratch, other + any + ours).sets[0].files.front() == "ours.c");
  CHECK_THAT(input_error([&] { read_fmi3(scratch, other); }),
             Contains("there is no <BuildConfiguration> of the modelIdentifier 'tank' for"));
}

TEST_CASE("names that lead out of the sources are refused") {
  const Scratch scratch;
  for (const char* name : {"../tank.c", "/etc/passwd", "a/../../b.c"}) {
    CHECK_THAT(input_error([&] {
                 read_fmi3(scratch, configuration("<SourceFileSet><SourceFile name=\"" +
                                                  std::string(name) + "\"/></SourceFileSet>"));
               }),
               Contains("is not within the folder 'sources'"));
  }
}

TEST_CASE("a flag of a build description may be written in another case, with a warning") {
  const Scratch scratch;
  const BuildDescription build =
      read_fmi3(scratch, configuration("<SourceFileSet><SourceFile name=\"tank.c\"/>"
                                       "<PreprocessorDefinition name=\"DEBUG\" optional=\"True\"/>"
                                       "</SourceFileSet>"));
  CHECK(build.sets.at(0).definitions.empty());
  REQUIRE(build.warnings.size() == 1);
  CHECK_THAT(build.warnings[0], Contains("optional=\"True\"") && Contains("is taken for true"));
}

TEST_CASE("the source files of FMI 2.0 are in the model description") {
  const Scratch scratch;
  const auto read = [&](const std::string& inside) {
    scratch.write("modelDescription.xml", "<fmiModelDescription fmiVersion=\"2.0\"><CoSimulation>" +
                                              inside + "</CoSimulation></fmiModelDescription>");
    return importer::read_build_description(scratch / "modelDescription.xml", unit("2.0"));
  };
  const BuildDescription build = read("<SourceFiles><File name=\"all.c\"/></SourceFiles>");
  REQUIRE(build.sets.size() == 1);
  CHECK(build.sets[0].files == std::vector<fs::path>{"all.c"});
  CHECK_THAT(input_error([&] { read(""); }), Contains("the FMU lists no source files"));
}

TEST_CASE("without a build description nothing is compiled") {
  const Scratch scratch;
  CHECK_THAT(
      input_error(
          [&] { importer::read_build_description(scratch / "modelDescription.xml", unit("3.0")); }),
      Contains("the FMU has no 'sources/buildDescription.xml', so it is not known how to compile"));
}

// stride build: FMUs with sources only.
#include <cstring>

#include "master/loader/fmu/description/binaries.h"
#include "tests/cli/landlock.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kSet =
    "<SourceFileSet language=\"C99\"><SourceFile name=\"unit.c\"/><SourceFile name=\"extra.c\"/>"
    "<PreprocessorDefinition name=\"GIVEN\" value=\"1\"/><IncludeDirectory name=\"include\"/>"
    "</SourceFileSet>";

/// A folder with an FMU whose unit is one of those for tests, and a source that needs what its
/// build description has.
struct SourceFmu {
  Scratch scratch;

  explicit SourceFmu(const std::string& extra = "int own(void) { return GIVEN + OWN; }\n",
                     const std::string& set = kSet) {
    fs::create_directories(scratch / "unit/sources/include");
    fs::copy_file(fs::path(STRIDE_SOURCE_DIR) / "tests/test_units/raw/unit.c",
                  scratch / "unit/sources/unit.c");
    scratch.write("unit/sources/extra.c",
                  "#include \"fmi3Functions.h\"\n#include \"own.h\"\n"
                  "fmi3DoStepTYPE* kept = &fmi3DoStep;\n" +
                      extra);
    scratch.write("unit/sources/include/own.h", "#define OWN 2\n");
    scratch.write("unit/sources/buildDescription.xml",
                  "<fmiBuildDescription fmiVersion=\"3.0\"><BuildConfiguration "
                  "modelIdentifier=\"test\">" +
                      set + "</BuildConfiguration></fmiBuildDescription>");
    scratch.write("unit/modelDescription.xml", description_text("test"));
  }
  Outcome build(const Arguments& further = {}) const {
    Arguments arguments{"build", "unit", "-o", "built.fmu"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run_program(arguments, scratch.path());
  }
  Outcome run() const {
    scratch.write("test.ssd", scenario_text({component("unit", "built.fmu")}));
    return run_program({"run", "test.ssd", "--quiet", "--out", "out"}, scratch.path());
  }
};

}  // namespace

TEST_CASE("an FMU with sources only is built, and runs") {
  const SourceFmu fmu;
  CHECK(fmu.scratch.path() != fs::path());
  const Outcome built = fmu.build();
  CHECK(built.err == "");
  CHECK(built.exit_code == 0);
  CHECK(built.out ==
        std::string("built.fmu has binaries/") + stride::importer::platform() + "/test.so\n");
  CHECK(fmu.run().exit_code == 0);
}

TEST_CASE("a built FMU has its description where the standard has it, whatever its case was") {
  const SourceFmu fmu;
  fs::rename(fmu.scratch / "unit/modelDescription.xml", fmu.scratch / "unit/ModelDescription.xml");
  const Outcome built = fmu.build();
  CHECK(built.exit_code == 0);
  CHECK_THAT(built.err, Contains("warning: 'unit' has its modelDescription.xml as "
                                 "'ModelDescription.xml'"));
  const Outcome outcome = fmu.run();
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
}

TEST_CASE("before it is built, the error says how it is") {
  const SourceFmu fmu;
  fmu.scratch.write("test.ssd", scenario_text({component("unit", "unit")}));
  CHECK_THAT(input_error_of(run_program({"run", "test.ssd"}, fmu.scratch.path())),
             Contains("it has its source code only") &&
                 Contains("'stride build FILE.fmu -o BUILT.fmu' compiles"));
}

TEST_CASE("what the build description does not have is given") {
  const SourceFmu fmu("#include \"far.h\"\nint own(void) { return FAR + LATE; }\n");
  CHECK_THAT(input_error_of(fmu.build()),
             Contains("the source 'extra.c' does not compile") && Contains("far.h") &&
                 Contains("hint: name the folder that has the header: -I FOLDER"));
  fs::create_directories(fmu.scratch / "headers");
  fmu.scratch.write("headers/far.h", "#define FAR 3\n");
  CHECK_THAT(input_error_of(fmu.build({"-I", "headers"})),
             Contains("LATE") && Contains("-D NAME=VALUE"));
  CHECK(fmu.build({"-I", "headers", "-DLATE=1"}).exit_code == 0);
  CHECK_FALSE(fs::exists(fmu.scratch / "unit/binaries"));
}

TEST_CASE("functions with a prefix are exported without it") {
  const SourceFmu fmu;
  std::string text = read(fmu.scratch / "unit/sources/unit.c");
  fmu.scratch.write("unit/sources/unit.c",
                    "#define FMI3_FUNCTION_PREFIX test_\n#include \"fmi3Functions.h\"\n" + text);
  REQUIRE(fmu.build().exit_code == 0);
  CHECK(fmu.run().exit_code == 0);
}

TEST_CASE("what is compiled is in a sandbox") {
  if (lacks_landlock()) return;
  const SourceFmu fmu("",
                      "<SourceFileSet compilerOptions=\"-save-temps -dumpdir /tmp/stride_escape_\">"
                      "<SourceFile name=\"extra.c\"/><IncludeDirectory name=\"include\"/>"
                      "</SourceFileSet>");
  fmu.build();
  for (const auto& entry : fs::directory_iterator("/tmp")) {
    CHECK(entry.path().filename().string().rfind("stride_escape_", 0) != 0);
  }
}

TEST_CASE("sources that need what no library has cannot be linked to a unit that loads") {
  const SourceFmu fmu("",
                      "<SourceFileSet><SourceFile name=\"unit.c\"/></SourceFileSet>"
                      "<Library name=\"stride_has_no_such\" external=\"true\"/>");
  CHECK_THAT(input_error_of(fmu.build()), Contains("the sources compile, but cannot be linked") &&
                                              Contains("stride_has_no_such"));
}

namespace {

/// A folder with the sources of an FMI 2.0 unit, behind `before`.
struct Fmi2Sources {
  Scratch scratch;

  explicit Fmi2Sources(const std::string& before = "",
                       const std::string& description_name = "modelDescription.xml") {
    const fs::path units = fs::path(STRIDE_SOURCE_DIR) / "tests/test_units/fmi2";
    fs::create_directories(scratch / "unit/sources");
    scratch.write("unit/" + description_name, description(read(units / "integrator.xml")));
    scratch.write("unit/sources/integrator.c", before + read(units / "integrator.c"));
  }
  Outcome build() const {
    return run_program(
        {"build", "unit", "-o", "built.fmu", "-I", STRIDE_SOURCE_DIR, "-D", "UNIT_NAME=\"tank\""},
        scratch.path());
  }
  Outcome run() const {
    return run_program(
        {"run", "built.fmu", "--quiet", "--stop", "1", "--step", "0.1", "--out", "out"},
        scratch.path());
  }

 private:
  static std::string description(std::string text) {
    for (const auto& [mark, word] : {std::pair{"@NAME@", "tank"}, {"@HAS_STATE@", "true"}}) {
      for (std::size_t at; (at = text.find(mark)) != std::string::npos;) {
        text.replace(at, std::strlen(mark), word);
      }
    }
    return text.replace(text.find("/>", text.find("<CoSimulation")), 2,
                        "><SourceFiles><File name=\"integrator.c\"/></SourceFiles></CoSimulation>");
  }
};

/// Gives all functions that any unit must have a prefix.
std::string with_prefix(const std::string& prefix) {
  std::string text;
  for (const char* name :
       {"Instantiate", "FreeInstance", "SetupExperiment", "EnterInitializationMode",
        "ExitInitializationMode", "Terminate", "DoStep", "GetReal", "SetReal"}) {
    text += std::string("#define fmi2") + name + " " + prefix + "fmi2" + name + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("the macro by which 20-sim leaves out the prefix of functions is defined") {
  const Fmi2Sources sources("#ifndef NO_FUNCTION_PREFIX\n" + with_prefix("tank_") + "#endif\n");
  const Outcome built = sources.build();
  CHECK(built.exit_code == 0);
  CHECK(built.err == "");
}

TEST_CASE("a built unit with the prefix of a static library is a warning, and runs") {
  const Fmi2Sources sources(with_prefix("tank_"));
  const Outcome built = sources.build();
  CHECK(built.exit_code == 0);
  CHECK_THAT(built.err, Contains("warning: its functions have the prefix 'tank_'"));
  const Outcome outcome = sources.run();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("the prefix 'tank_' of a static library"));
}

TEST_CASE("a built library that no importer can use is an error with what it exports") {
  const Fmi2Sources sources(with_prefix("other_"));
  CHECK_THAT(input_error_of(sources.build()), Contains("does not export fmi2Instantiate, ") &&
                                                  Contains("other_fmi2Instantiate") &&
                                                  Contains("hint: give the definition"));
  CHECK_FALSE(fs::exists(sources.scratch / "built.fmu"));
}

TEST_CASE("a unit of FMI 2.0 is built from the files that its model description lists") {
  const std::string name = GENERATE("modelDescription.xml", "modeldescription.XML");
  const Outcome built = Fmi2Sources("", name).build();
  CHECK((built.err == "") == (name == "modelDescription.xml"));
  CHECK_THAT(built.out, Contains("built.fmu has binaries/linux64/"));
}

#include "master/front/cli/reference/command_tree.h"

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>

using namespace stride::cli::reference;
using Kind = Value::Kind;
using Words = std::vector<std::string>;

namespace {

/// An option as it is documented.
Option told(const std::string& name, const std::string& placeholder,
            const std::string& description = "") {
  CLI::App app("An example", "example");
  std::string text;
  app.add_option(name, text, description)->type_name(placeholder);
  return describe(app).options.at(1);
}

}  // namespace

TEST_CASE("what a value can be is read from its placeholder and its description") {
  CHECK(told("--step", "SECONDS").value.kind == Kind::Anything);
  CHECK(told("--out", "FOLDER").value.kind == Kind::Folder);
  CHECK(told("--part", "COMPONENT").value.kind == Kind::Component);
  CHECK(told("--set", "COMPONENT.VARIABLE=VALUE").value.kind == Kind::ComponentVariable);
  CHECK(told("--degree", "hold|linear").value.kind == Kind::Choice);
  CHECK(told("--degree", "hold|linear").value.choices == Words{"hold", "linear"});
  const Value swap = told("--swap", "COMPONENT=FILE.fmu").value;
  CHECK(swap.kind == Kind::ComponentFile);
  CHECK(swap.extensions == Words{"fmu"});
  const Value file = told("--output", "FILE", "The .fmu (or .ssp, as in a.b.c) to write").value;
  CHECK(file.kind == Kind::File);
  CHECK(file.extensions == Words{"fmu", "ssp"});
  const Value scenario = told("--of", "SCENARIO", "A system file (.ssd), or a name").value;
  CHECK(scenario.kind == Kind::Scenario);
  CHECK(scenario.extensions == Words{"ssd"});
  CHECK(told("--json", "FILE", "Where they go").value.extensions.empty());
  const Value check = told("--check", "CHECK").value;
  CHECK(std::ranges::count(check.choices, "serialization") == 1);
}

TEST_CASE("names, bounds, defaults and repeatable options are documented") {
  CLI::App app("An example", "example");
  int count = 3;
  app.add_option("--count,-c", count, "How many")
      ->type_name("N")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  std::vector<std::string> names;
  app.add_flag("--each", names, "All, or as --each=NAME some; may be given several times");
  bool is_quiet = false;
  app.add_flag("--quiet", is_quiet, "Say nothing");
  const Command command = describe(app);
  const Option& number = command.options.at(1);
  CHECK(number.names == Words{"-c", "--count"});
  CHECK(value_text(number) == " N");
  CHECK(meaning(number) == "How many; 1 to 9; 3 if left out");
  CHECK_FALSE(number.is_repeatable);
  const Option& each = command.options.at(2);
  CHECK(each.is_value_optional);
  CHECK(each.is_repeatable);
  CHECK(value_text(each) == "[=NAME]");
  CHECK_FALSE(command.options.at(3).takes_value());
}

TEST_CASE("commands are documented with their subcommands, except hidden ones") {
  CLI::App app("An example,\nof two lines.\n", "example");
  app.footer("That is all.");
  CLI::App* trace = app.add_subcommand("trace", "Traces");
  CLI::App* info = trace->add_subcommand("info", "Tell of one");
  std::string text;
  info->add_option("IN.vcd", text, "What is read")->required();
  info->add_option("OUT", text, "What is written");
  app.add_subcommand("secret", "Not told")->group("");
  const Command command = describe(app);
  CHECK(command.description == "An example, of two lines");
  CHECK(command.footer == "That is all.");
  REQUIRE(command.commands.size() == 1);
  CHECK(command.commands[0].footer == "");
  CHECK(synopsis(command) == "example [OPTION]... COMMAND");
  CHECK(synopsis(command.commands[0]) == "example trace COMMAND");
  const Command& inner = command.commands[0].commands.at(0);
  CHECK(synopsis(inner) == "example trace info IN.vcd [OUT]");
  CHECK(inner.full_name("-") == "example-trace-info");
  CHECK(inner.arguments[0].value.extensions == Words{"vcd"});
  CHECK(all_of(command).size() == 3);
}

TEST_CASE("help is documented for the program only, and offered everywhere") {
  CLI::App app("An example", "example");
  app.add_subcommand("run", "Run");
  const Command command = describe(app);
  CHECK(documented_options(command).size() == 1);
  CHECK(documented_options(command.commands[0]).empty());
  CHECK(command.commands[0].options.at(0).names == Words{"-h", "--help"});
}

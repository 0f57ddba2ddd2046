// What is written of a command line with all that a format could take for its own.
#include "master/front/cli/reference/writers.h"

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>

using namespace stride::cli::reference;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

Command hostile() {
  CLI::App app("It's an example", "example");
  std::string text;
  CLI::App* run = app.add_subcommand("run", "Run 'it' [now]: or\\never");
  run->add_option("--choice,-c", text, ".starts with a dot | a <bar>")->type_name("one|two");
  run->footer("List:\n  a-b  one\n\nThe end");
  return describe(app);
}

}  // namespace

TEST_CASE("lines are wrapped between words, and what is indented stays") {
  CHECK(wrapped("one two three", 7) == "one two\nthree\n");
  CHECK(wrapped("one\ntwo", 7) == "one two\n");
  CHECK(wrapped("one\n\ntwo", 7) == "one\n\ntwo\n");
  CHECK(wrapped("List:\n  a  b\nend", 40) == "List:\n  a  b\nend\n");
  CHECK(wrapped("longer-than-that", 7) == "longer-than-that\n");
  CHECK(wrapped("", 7) == "");
}

TEST_CASE("a page of Markdown") {
  const std::string page = markdown(hostile());
  CHECK_THAT(page, StartsWith("# Command line\n"));
  CHECK_THAT(page, Contains("### example run\n\n```sh\nexample run [OPTION]...\n```\n"));
  CHECK_THAT(page, Contains("| `-c, --choice one\\|two` | .starts with a dot \\| a \\<bar> |"));
  CHECK_THAT(page, Contains("| [`example run`](#example-run) |"));
}

TEST_CASE("pages for man") {
  const auto pages = man_pages(hostile(), "1.2");
  REQUIRE(pages.size() == 2);
  const std::string& page = pages.at("example-run.1");
  CHECK_THAT(page, StartsWith(".TH EXAMPLE\\-RUN 1 \"\" \"stride 1.2\""));
  CHECK_THAT(page,
             Contains("\n\\fB\\-c\\fR, \\fB\\-\\-choice\\fR \\fIone|two\\fR\n\\&.starts with"));
  CHECK_THAT(page, Contains("or\\enever"));
  CHECK_THAT(page, Contains(".nf\n  a\\-b  one\n.fi"));
  CHECK_THAT(pages.at("example.1"), Contains("\\fBexample\\-run\\fR(1)"));
}

TEST_CASE("completions quote what the shells could take for their own") {
  const Command program = hostile();
  CHECK_THAT(bash_completion(program),
             Contains("'example run -c' | 'example run --choice') _stride_words one two ;;"));
  const std::string zsh = zsh_completion(program);
  CHECK_THAT(zsh, Contains("'run:Run '\\''it'\\'' [now]\\: or\\\\never'"));
  CHECK_THAT(zsh, Contains(":one|two:(one two)'"));
  CHECK_THAT(fish_completion(program), Contains("-a run -d 'Run \\'it\\' [now]: or\\\\never'"));
}

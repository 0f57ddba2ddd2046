// Campaigns that capture the stimuli of a component in each case.
#include <algorithm>
#include <map>

#include "tests/cli/campaigns.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const char* const kCaptureSecond = "<stride:Capture component='second'/>";

/// All files of stimuli below the folder of a campaign, by their paths there.
std::map<std::string, std::string> stimuli_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "cases")) {
    if (entry.path().parent_path().extension() != ".stimuli") continue;
    files[entry.path().lexically_relative(folder / "cases").string()] = read(entry.path());
  }
  return files;
}

struct CapturedCases : Workspace {
  explicit CapturedCases(const std::string& text, const Parts& parts = checked_filters())
      : Workspace(parts) {
    scratch().write("c.xosc", text);
  }
  std::map<std::string, std::string> stimuli(const std::string& out, const Arguments& further = {},
                                             int exit_code = 1) const {
    Arguments arguments{"campaign", "run", "c.xosc", "--quiet", "--out", out};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const Outcome outcome = stride(arguments);
    INFO(outcome.err);
    CHECK(outcome.exit_code == exit_code);
    return stimuli_in(scratch() / out);
  }
};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

TEST_CASE("each case keeps what the component received, whatever is kept and however it ends") {
  const std::string keep = GENERATE(as<std::string>(), "none", "failed", "all");
  const std::string kept = "<stride:Keep results='" + keep + "'/>";
  const CapturedCases space(drawn_input("8", kCaptureSecond + kept));
  const auto one = space.stimuli("one", {"--jobs", "1"});
  CHECK(one.size() == 8);
  CHECK(space.stimuli("three", {"--jobs", "3"}) == one);
  CHECK_FALSE(fs::exists(space / "one/running"));
  for (const auto& [name, text] : one) CHECK(ends_with(text, "1,end,,\"completed\"\n"));

  const Outcome command = space.stride({"campaign", "plan", "c.xosc", "--case", "5"});
  const std::size_t value = command.out.find("first.u=");
  space.run({"-q", "--set", command.out.substr(value, command.out.find('\n') - value), "--capture",
             "second=alone.csv"});
  CHECK(one.at("000/000005.stimuli/second.csv") == read(space / "alone.csv"));

  space.scratch().write("c.xosc", drawn_input("8", kept));
  CHECK(space.stimuli("without").empty());
  CHECK(without_wall_times(read(space / "without/cases.csv")) ==
        without_wall_times(read(space / "one/cases.csv")));
}

TEST_CASE("stimuli of cases that share a beginning are what they are alone") {
  const CapturedCases space(campaign_text(
      deterministic(value_set("first.u", {"0.25", "0.5"}) +
                    value_set("wire.from", {"0.75", "0.5"}) + value_set("wire.value", {"0", "9"})),
      "<stride:Intervention name='wire'><stride:Force variable='second.u' value='0' from='0.5'/>"
      "</stride:Intervention><stride:Keep results='none'/><stride:Capture component='second'/>"
      "<stride:Capture component='first'/>",
      "test.ssd"));
  const auto together = space.stimuli("together", {}, 0);
  CHECK(together.size() == 16);
  for (int i = 0; i < 8; ++i) space.stimuli("alone", {"--case", std::to_string(i)}, 0);
  CHECK(stimuli_in(space / "alone") == together);
  CHECK_THAT(together.at("000/000001.stimuli/second.csv"), Contains(",u,9\n"));
}

TEST_CASE("a case that does not come to its end has its stimuli up to there") {
  const CapturedCases space(
      campaign_text(
          deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                        value_set("c.fault", {"", "segfault", "exit with 0", "kill", "sleep"})),
          "<stride:Capture component='second'/><stride:Keep results='none'/>"
          "<stride:Limit wallTime='5'/>",
          "test.ssd"),
      {component("c", "faulty.fmu") + two_filters().components, two_filters().connections});
  const auto stimuli = space.stimuli("out");
  CHECK(stimuli.at("000/000000.stimuli/second.csv").find("1,end,,\"completed\"") !=
        std::string::npos);
  for (const std::string index : {"1", "2"}) {
    const std::string& text = stimuli.at("000/00000" + index + ".stimuli/second.csv");
    CHECK_THAT(text, Contains(",end,,\"failed: "));
    CHECK_THAT(text, Contains("\n0.498,step,,0.499\n"));
  }
  for (const auto& [name, text] : stimuli) {
    space.scratch().write("x.csv", text);
    const Outcome packed = space.stride({"pack", "x.csv", "-o", "x.fmu"});
    INFO(name << packed.err);
    CHECK(packed.exit_code == 0);
  }
}

TEST_CASE("what a campaign cannot capture is refused") {
  const auto error = [](const std::string& extension, const std::string& annotation = "") {
    Parts parts = two_filters();
    parts.annotation = annotation;
    const CapturedCases space(drawn_input("2", extension), parts);
    return input_error_of(space.stride({"campaign", "plan", "c.xosc"}));
  };
  CHECK_THAT(error("<stride:Capture component='secund'/>"),
             Contains("c.xosc:10: there is no component 'secund'") && Contains("'second'"));
  CHECK_THAT(error(std::string(kCaptureSecond) + kCaptureSecond),
             Contains("the component 'second' is captured twice"));
  CHECK_THAT(error("<stride:Capture/>"), Contains("needs the attribute 'component'"));
  CHECK_THAT(error(kCaptureSecond, "<stride:Exchange coupling='gauss-seidel'/>"),
             Contains("c.xosc:10: inputs of this scenario change within a step"));
}

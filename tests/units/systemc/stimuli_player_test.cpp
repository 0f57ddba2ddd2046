#include <catch2/catch.hpp>

#include <stride/systemc/stimuli_player.h>

#include "tests/scratch_folder.h"

using Catch::Matchers::Contains;
using stride::systemc::StimuliPlayer;

namespace {

const std::string kExample =
    "stride stimuli,1\n"
    "unit,lamp\n"
    "input,level,Float64,continuous,V,,,9\n"
    "input,matrix,Int32,discrete,,,2 3,1,2,3,4,5,6\n"
    "input,is_on,Boolean,discrete,,,,true\n"
    "input,tick,Clock,discrete,,,\n"
    "input,text,String,discrete,,tick,,\"\"\n"
    "input,bytes,Binary,discrete,,tick,,\n"
    "set,power,0.5\n"
    "time,event,variable,value\n"
    "2,,level,0.5\n"
    "2,step,,2.25\n"
    "2.25,0,matrix,1,2,3,4,50,6\r\n"
    "2.25,1,tick,\n"
    "2.25,1,text,\"a \"\"word\"\",\n\"\n"
    "2.25,1,bytes,00ff10\n"
    "2.25,step,,2.5\n"
    "2.500000000001,end,,\"completed\"\n";

struct PlayedFile : stride::tests::ScratchFolder {
  explicit PlayedFile(const std::string& text) {
    std::ofstream(*this / "x.csv", std::ios::binary) << text;
  }
  StimuliPlayer player() const { return StimuliPlayer((*this / "x.csv").string()); }
};

std::string replaced(std::string text, const std::string& before, const std::string& after) {
  return text.replace(text.find(before), before.size(), after);
}

template <class Use>
std::string mistake_of(const std::string& text, Use&& use) {
  const PlayedFile file(text);
  try {
    StimuliPlayer player = file.player();
    use(player);
  } catch (const std::runtime_error& mistake) {
    return std::string(mistake.what()).substr((file / "").string().size());
  }
  return "";
}

std::string mistake_in(const std::string& text) {
  return mistake_of(text, [](StimuliPlayer&) {});
}

std::string mistake_with(const std::string& before, const std::string& after) {
  return mistake_in(replaced(kExample, before, after));
}

}  // namespace

TEST_CASE("a file of stimuli is read, and inputs take what has their type") {
  StimuliPlayer player = PlayedFile(kExample).player();
  CHECK(player.end() == sc_core::sc_time(500'000'000'001, sc_core::SC_PS));
  CHECK(player.settings().at("power") == std::vector<std::string>{"0.5"});
  player.on_message("level", [](const double&) {});
  player.on_message("matrix[2,2]", [](const int&) {});
  player.on_message("is_on", [](const bool&) {});
  player.on_message("text", [](const std::string&) {});
  player.on_message("bytes", [](const StimuliPlayer::Bytes&) {});
  player.on_tick("tick", [] {});
}

TEST_CASE("what is wrong with a file of stimuli is said with its line") {
  CHECK(mistake_in("") == "x.csv:0: the file has no end mark: it was cut off");
  CHECK_THAT(mistake_with("stimuli,1", "stimuli,2"),
             Contains("x.csv:1: expected 'stride stimuli,1'"));
  CHECK_THAT(mistake_in(kExample.substr(0, kExample.size() - 1)),
             Contains("x.csv:19: a field does not end with a comma or the line"));
  CHECK_THAT(mistake_with("2.500000000001,end,,\"completed\"\n", ""), Contains("was cut off"));
  CHECK_THAT(mistake_with("2.25,step", "1,step"), Contains("earlier than the first row"));
  CHECK_THAT(mistake_with("2.25,0,matrix", "2.3,0,matrix"),
             Contains("x.csv:14: this is earlier than the row above"));
  CHECK_THAT(mistake_with("2,,level", "two,,level"), Contains("x.csv:11: 'two' is no time"));
  CHECK_THAT(mistake_with("2.25,1,tick", "2.25,x,tick"), Contains("'x' is no event iteration"));
  CHECK_THAT(mistake_with("2,,level", "2,,other"), Contains("x.csv:11: there is no input 'other'"));
  CHECK_THAT(mistake_with("2 3", "2 x"), Contains("x.csv:4: '2 x' are no sizes"));
  CHECK_THAT(mistake_in(kExample + "3,,level,1\n"), Contains("behind the end mark"));
}

TEST_CASE("what an input cannot be taken for is said") {
  const auto taken = [](const std::string& name, auto value) {
    return mistake_of(kExample, [&](StimuliPlayer& player) {
      player.on_message(name, [](const decltype(value)&) {});
    });
  };
  CHECK(taken("level", 0.0) == "");
  CHECK_THAT(taken("other", 0.0), Contains("there is no input 'other'"));
  CHECK_THAT(taken("matrix", 0), Contains("there is no input 'matrix'"));
  CHECK_THAT(taken("matrix[3,1]", 0), Contains("there is no element 'matrix[3,1]'"));
  CHECK_THAT(taken("matrix[1]", 0), Contains("there is no element 'matrix[1]'"));
  CHECK_THAT(taken("level", false), Contains("x.csv:11: '0.5' is no value of 'level'"));
  CHECK_THAT(taken("level", 0), Contains("'0.5' is no value of 'level'"));
  CHECK_THAT(taken("text", StimuliPlayer::Bytes()), Contains("is no value of 'text'"));
  CHECK_THAT(mistake_of(kExample, [](StimuliPlayer& player) { player.on_tick("level", [] {}); }),
             Contains("'level' is no clock"));
}

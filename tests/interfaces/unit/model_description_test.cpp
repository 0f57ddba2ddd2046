#include "interfaces/unit/model_description.h"

#include <cstdint>

#include <catch2/catch.hpp>

using namespace stride;
using Catch::Matchers::Contains;

namespace {

/// Some of what a model description says.
class Sample : public Unit {
 public:
  explicit Sample(bool may_reject = false, bool split_invariant = false) {
    auto& info = describe("A sample");
    info.may_reject = may_reject;
    info.split_invariant = split_invariant;
    parameter("gain", gain_);
    input("in", in_);
    output("clock", clock_);
    output("count", count_).clocked_by(clock_).range(1, 0x1.8p63);
  }
  void step(Step&) override {}

 private:
  double gain_ = 1;
  double in_ = 0;
  Clock clock_;
  std::uint64_t count_ = 1;
};

std::string describe(const Unit& unit) {
  double time = 0;
  return kit::model_description("sample", unit, kit::Table(unit, time));
}

}  // namespace

TEST_CASE("a clock depends on no input of the same instant, nor on a parameter at the start") {
  const std::string xml = describe(Sample());
  CHECK_THAT(xml, Contains(R"(<Output valueReference="3" dependencies=""/>)"));
  CHECK_THAT(xml, Contains(R"(<InitialUnknown valueReference="3" dependencies=""/>)"));
}

TEST_CASE("bounds above the range of Int64 are written as they are") {
  CHECK_THAT(describe(Sample()), Contains(R"(min="1" max="13835058055282163712")"));
}

TEST_CASE("whether the unit may reject a step is annotated at the end") {
  const std::string never = describe(Sample());
  const std::size_t at = never.find(R"(<Annotation type="org.stride.unit">)");
  REQUIRE(at != std::string::npos);
  CHECK(at > never.find("</ModelStructure>"));
  CHECK_THAT(never.substr(at),
             Contains(R"(<stride:Unit xmlns:stride="urn:org.stride:unit:1" mayReject="false"/>)"));
  CHECK_THAT(describe(Sample(true)), Contains(R"(mayReject="true")"));
}

TEST_CASE("the maximum of a step is annotated, unless there is none") {
  class Limited : public Sample {
   public:
    explicit Limited(Duration maximum) { describe("limited").maximum_step = maximum; }
  };
  CHECK_THAT(describe(Limited(std::chrono::milliseconds(250))), Contains(R"( maximumStep="0.25")"));
  CHECK_THAT(describe(Limited(std::chrono::seconds(1'000'000'000'000'000))),
             Contains("maximumStep"));
  CHECK_THAT(describe(Limited(std::chrono::seconds(1'000'000'000'000'001))),
             !Contains("maximumStep"));
  CHECK_THAT(describe(Limited(Duration::max())), !Contains("maximumStep"));
  CHECK_THAT(describe(Sample()), !Contains("maximumStep"));
}

TEST_CASE("the verdict and its text are annotated by their names") {
  class Judge : public Unit {
   public:
    Judge() {
      output("why", why_).verdict_text();
      output("good", good_).verdict();
    }
    void step(Step&) override {}

   private:
    bool good_ = false;
    std::string why_;
  };
  CHECK_THAT(describe(Judge()), Contains(R"( verdictText="why" verdict="good"/>)"));
  CHECK_THAT(describe(Sample()), !Contains("verdict"));
}

TEST_CASE("that steps may be split is annotated where it is so") {
  CHECK_THAT(describe(Sample()), !Contains("splitInvariant"));
  CHECK_THAT(describe(Sample(false, true)),
             Contains(R"(mayReject="false" splitInvariant="true"/>)"));
}

TEST_CASE("that a unit allows no snapshots is annotated where it is so") {
  class Outside : public Unit {
   public:
    Outside() { describe("Talks to a program").allows_snapshots = false; }
    void step(Step&) override {}
  };
  CHECK_THAT(describe(Sample()), !Contains("allowsSnapshots"));
  CHECK_THAT(describe(Outside()), Contains(R"( allowsSnapshots="false"/>)"));
}

TEST_CASE("the step that a unit prefers is in its default experiment") {
  class Clocked : public Unit {
   public:
    Clocked() { describe("A clocked unit").default_step = Duration(20'000); }
    void step(Step&) override {}
  };
  const std::string xml = describe(Clocked());
  const std::size_t at = xml.find(R"(<DefaultExperiment stepSize="2e-08"/>)");
  REQUIRE(at != std::string::npos);
  CHECK(at < xml.find("<ModelVariables"));
  CHECK_THAT(describe(Sample()), !Contains("DefaultExperiment"));
}

TEST_CASE("the times between which a unit is meant to run are in its default experiment") {
  class Played : public Unit {
   public:
    Played() {
      UnitInfo& info = describe("A recording");
      info.default_start = time_from_seconds(-1);
      info.default_stop = time_from_seconds(2.5);
    }
    void step(Step&) override {}
  };
  CHECK_THAT(describe(Played()), Contains(R"(<DefaultExperiment startTime="-1" stopTime="2.5"/>)"));
}

namespace {

class Measured : public Unit {
 public:
  explicit Measured(const std::string& in = "m", double factor = 201.168) {
    unit_of_measure("furlong", factor, in);
    unit_of_measure("oven", 10, "degC", 50);
    input("speed", speed_).unit("km/h");
    input("length", length_).unit("furlong");
    input("heat", heat_).unit("oven");
    input("rise", rise_).unit("degF").relative();
    input("score", score_).unit("points");
    input("pace", pace_).unit("furlong/h");
  }
  void step(Step&) override {}

 private:
  double speed_ = 0, length_ = 0, heat_ = 0, rise_ = 0, score_ = 0, pace_ = 0;
};

}  // namespace

TEST_CASE("units of measure are defined if they are known, or by the unit") {
  const std::string xml = describe(Measured());
  CHECK_THAT(xml, Contains(R"(<BaseUnit m="1" s="-1" factor="0.2777777777777778"/>)"));
  CHECK_THAT(xml, Contains(R"(<BaseUnit m="1" factor="201.168"/>)"));
  CHECK_THAT(xml, Contains(R"(<BaseUnit K="1" factor="10" offset="323.15"/>)"));
  CHECK_THAT(xml, Contains(R"(factor="0.5555555555555556" offset="255.37222222222223")"));
  CHECK_THAT(xml, Contains(R"(<Unit name="points"/>)"));
  CHECK_THAT(xml, Contains(R"(<BaseUnit m="1" s="-1" factor="0.05588"/>)"));
}

TEST_CASE("a difference is declared as one") {
  const std::string xml = describe(Measured());
  CHECK_THAT(xml, Contains(R"(unit="degF" relativeQuantity="true")"));
  CHECK(xml.find("relativeQuantity") == xml.rfind("relativeQuantity"));
}

TEST_CASE("definitions of units of measure that mean nothing are refused") {
  CHECK_THROWS_WITH(describe(Measured("ell")),
                    Contains("'furlong': 'ell', by which it is defined"));
  CHECK_THROWS_WITH(describe(Measured("m", 0)), Contains("expected a finite factor other than 0"));
}

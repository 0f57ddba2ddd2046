#include "master/loader/network/remote_spec.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride;

TEST_CASE("an error from a machine has the component here, the machine, and its place there") {
  core::Context context{
      .where = {"a.ssd", 7}, .unit = "u", .variable = "v", .time = Time(Duration(5))};
  const auto text_of = [here = context](const core::Context& there) {
    isolation::PacketBuffer memory;
    isolation::PacketWriter out(memory);
    put_error(out, core::Error(core::Error::Kind::Input, there, "wrong", "mend it"), {});
    isolation::PacketReader in(out.bytes());
    isolation::SentError error = isolation::take_error(in);
    remote::supplement(error, {.where = here.where, .unit = here.unit}, "box");
    return tests::error_of([&] { error.raise(); });
  };
  const std::string expected =
      core::Error(core::Error::Kind::Input, context, "box: wrong", "mend it").what();
  CHECK(text_of(context) == expected);
  context.where = {};
  CHECK(text_of(context) == expected);
  context.where = {"/models/x.fmu/modelDescription.xml", 3};
  CHECK_THAT(text_of(context),
             Catch::Matchers::StartsWith("a.ssd:7: unit 'u'") &&
                 Catch::Matchers::Contains("box: /models/x.fmu/modelDescription.xml:3: wrong"));
}

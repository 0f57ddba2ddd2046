#include <catch2/catch.hpp>

#include <stride/variable_name.h>

using stride::is_structured_name;

TEST_CASE("names that follow the grammar") {
  for (const char* name : {"a",
                           "_",
                           "x_1",
                           "der",
                           "derivative",
                           "arm.joint_1.position",
                           "axes[1]",
                           "axes[2,10].x",
                           "a[1].b[2,3]",
                           "'left arm'",
                           "'left arm'.angle",
                           "arm.'1.5 m'[3]",
                           "'[a](b)'",
                           R"('it\'s')",
                           R"('back\\slash')",
                           R"('\"\?\a\b\f\n\r\t\v')",
                           "der(x)",
                           "der(x,2)",
                           "der('left arm'.angle)",
                           "der(a.b[1],12)"}) {
    CAPTURE(name);
    CHECK(is_structured_name(name));
  }
}

TEST_CASE("names that do not") {
  for (const char* name : {"",
                           "1a",
                           "a b",
                           "a-b",
                           "left arm.angle",
                           ".a",
                           "a.",
                           "a..b",
                           "a[",
                           "a[]",
                           "a[x]",
                           "a[1",
                           "a[1,]",
                           "a[-1]",
                           "a[1][2]",
                           "[1]",
                           "''",
                           "'a",
                           "a'",
                           "a'b'",
                           "'a'b",
                           "'it's'",
                           R"('a\')",
                           R"('a\x')",
                           R"('a"b')",
                           "'a\nb'",
                           "'gr\xc3\xb6\xc3\x9f"
                           "e'",
                           "gr\xc3\xb6sse",
                           "der()",
                           "der(x",
                           "der(x))",
                           "der(x,)",
                           "der(x, 2)",
                           "der(x,2).y",
                           "der(der(x))",
                           "a(b)"}) {
    CAPTURE(name);
    CHECK_FALSE(is_structured_name(name));
  }
}

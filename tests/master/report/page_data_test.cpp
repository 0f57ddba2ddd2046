#include "master/report/page_data.h"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "tests/master/report/support.h"

using namespace stride::report;
using nlohmann::json;

namespace {

std::string encoded(const std::string& text) {
  return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

template <class Element>
std::vector<Element> round_trip(const std::vector<Element>& values) {
  return unpacked<Element>(json::parse(blob(std::span(values))));
}

}  // namespace

TEST_CASE("base64 is that of RFC 4648") {
  CHECK(encoded("") == "");
  CHECK(encoded("f") == "Zg==");
  CHECK(encoded("fo") == "Zm8=");
  CHECK(encoded("foo") == "Zm9v");
  CHECK(encoded("foobar") == "Zm9vYmFy");
  CHECK(encoded("\xff\xfe\xfb") == "//77");
}

TEST_CASE("doubles come back bit by bit") {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> values = {0,
                                      -0.0,
                                      0.1,
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::denorm_min(),
                                      Limits::max(),
                                      Limits::quiet_NaN()};
  const std::vector<double> found = round_trip(values);
  REQUIRE(found.size() == values.size());
  CHECK(std::memcmp(found.data(), values.data(), values.size() * sizeof(double)) == 0);
}

TEST_CASE("integers come back, and empty arrays") {
  CHECK(round_trip(std::vector<std::int64_t>{INT64_MIN, -1, 0, INT64_MAX}) ==
        std::vector<std::int64_t>{INT64_MIN, -1, 0, INT64_MAX});
  CHECK(round_trip(std::vector<std::int32_t>{INT32_MIN, 7, INT32_MAX}) ==
        std::vector<std::int32_t>{INT32_MIN, 7, INT32_MAX});
  CHECK(round_trip(std::vector<std::uint8_t>{0, 1, 255}) == std::vector<std::uint8_t>{0, 1, 255});
  CHECK(round_trip(std::vector<double>{}).empty());
}

TEST_CASE("times are 64-bit counts of picoseconds where these are enough") {
  using namespace std::chrono_literals;
  const std::vector<stride::Time> near{stride::Time(-1s), stride::Time(2s)};
  const json narrow = json::parse(blob(std::span(near)));
  CHECK(narrow["type"] == "int64");
  CHECK(unpacked<std::int64_t>(narrow) ==
        std::vector<std::int64_t>{-1'000'000'000'000, 2'000'000'000'000});
  const std::vector<stride::Time> years{stride::Time(2s), stride::Time(3155760000s)};
  const json wide = json::parse(blob(std::span(years)));
  CHECK(wide["type"] == "int128");
  CHECK(unpacked<stride::Time>(wide) == years);
}

TEST_CASE("arrays of several pieces come back, whether they can be compressed or not") {
  std::mt19937_64 random(4);
  std::vector<std::int64_t> noise(400'001);
  for (auto& value : noise) value = static_cast<std::int64_t>(random());
  CHECK(round_trip(noise) == noise);
  std::vector<std::int64_t> steps(400'001);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = static_cast<std::int64_t>(i) << 30;
  CHECK(round_trip(steps) == steps);
  CHECK(blob(std::span<const std::int64_t>(steps)).size() < steps.size());
}

TEST_CASE("texts are an array of indices and the distinct ones") {
  Texts texts;
  for (const char* text : {"on", "off", "on", "</script>", "\xff"}) texts.add(text);
  const std::string text = blob(texts);
  CHECK(text.find('<') == std::string::npos);
  const json parsed = json::parse(text);
  CHECK(parsed["values"].size() == 4);
  CHECK(unpacked_texts(parsed) ==
        std::vector<std::string>{"on", "off", "on", "</script>", "\xEF\xBF\xBD"});
}

TEST_CASE("texts that are joined are bytes with a 0 behind each") {
  const std::vector<std::string> texts{"a", "", "</b>\xff", std::string("c\0d", 3)};
  const json parsed = json::parse(text_blob(texts));
  CHECK(parsed["type"] == "texts");
  CHECK(parsed["count"] == 4);
  const auto bytes = unpacked<std::uint8_t>(parsed["bytes"]);
  CHECK(std::string(bytes.begin(), bytes.end()) == std::string("a\0\0</b>\xff\0c d\0", 13));
}

TEST_CASE("no text ends the element that contains the JSON") {
  const std::string text = json_text({{"a", "</script><!-- \\ \" \n"}, {"<b>", 1}});
  CHECK(text == R"({"a":"\u003c/script>\u003c!-- \\ \" \n","\u003cb>":1})");
  CHECK(Json::parse(text)["a"] == "</script><!-- \\ \" \n");
}

TEST_CASE("integers that JavaScript does not have become texts") {
  const Json json = Json::parse(R"({"a": [9223372036854775807, -9223372036854775807, 1, 0.5],
                                    "b": {"c": 18446744073709551615, "d": 9007199254740992}})");
  CHECK(with_exact_integers(json).dump() ==
        R"({"a":["9223372036854775807","-9223372036854775807",1,0.5],)"
        R"("b":{"c":"18446744073709551615","d":9007199254740992}})");
}

TEST_CASE("what is not valid UTF-8 is replaced") {
  CHECK(json_text(Json("a\xff\xc3(")) == "\"a\xEF\xBF\xBD\xEF\xBF\xBD(\"");
}

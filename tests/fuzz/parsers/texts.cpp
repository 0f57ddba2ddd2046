// Short texts: those of the command line, and values, times and conditions wherever they are.
#include <array>
#include <sstream>

#include "master/base/text/glob.h"
#include "master/base/text/hex.h"
#include "master/base/text/number_text.h"
#include "master/base/text/readable_text.h"
#include "master/base/time_text.h"
#include "master/engine/model/values.h"
#include "master/observe/checks/condition.h"
#include "master/system/declaration/run_settings.h"
#include "tests/fuzz/parser.h"
#include "tests/master/system/ssp/support.h"

namespace stride::tests {
namespace {

void read_time(const std::string& bytes) {
  refusing<std::invalid_argument>("", [&] {
    const Duration time = core::parse_seconds(bytes);
    ensure(time >= Duration::zero(), "times are not negative");
    ensure(core::parse_seconds(core::to_text(time)) == time, "the text of a time reads back");
  });
}

void read_number(const std::string& bytes) {
  refusing<std::invalid_argument>("", [&] {
    ensure(core::parse_at_least_zero(bytes) >= 0, "it is at least 0");
    ensure(core::parse_above_zero(bytes) > 0, "it is above 0");
    scenario::parse_call_limit(bytes);
    scenario::parse_max_skip(bytes);
    scenario::parse_memory_limit(bytes);
  });
}

/// The variable that the first byte chooses, and the rest.
const core::Variable& take_variable(std::string_view& bytes) {
  static const auto description = sample_description();
  const std::size_t choice = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]) - '0';
  bytes.remove_prefix(bytes.empty() ? 0 : 1);
  return description->variables[choice % description->variables.size()];
}

void read_value(const std::string& bytes) {
  std::string_view rest = bytes;
  const core::Variable& variable = take_variable(rest);
  refusing<std::invalid_argument>("", [&] {
    const core::ValueBlock block = core::parse(variable, std::string(rest));
    ensure(block.size() == variable.size && block.type() == variable.type, "it fits the variable");
    const bool reads_back =
        core::has_nan(block) || core::parse(variable, core::elements_text(block)) == block;
    ensure(reads_back, "its text reads back");
  });
}

void read_condition(const std::string& bytes) {
  std::string_view rest = bytes;
  core::Variable variable = take_variable(rest);
  variable.size = 1;
  variable.dimensions.clear();
  checks::ConditionText text;
  std::istringstream words{std::string(rest)};
  for (auto* const member :
       {&text.min, &text.max, &text.above, &text.below, &text.equals, &text.tolerance}) {
    std::string word;
    if (std::getline(words, word, ';') && !word.empty()) *member = word;
  }
  refusing<std::invalid_argument>("", [&] {
    const checks::Condition condition(variable, text);
    const core::ValueBlock block(variable.type, 1);
    const auto [truth, robustness] = condition.judge(block, 0);
    ensure(truth == checks::Truth::True ? robustness >= 0 : robustness <= 0, "its sign is right");
    ensure(!condition.text().empty() && !condition.value_text(block, 0).empty(), "it has words");
  });
}

void read_glob(const std::string& bytes) {
  const std::size_t end = bytes.find('\n');
  core::matches_glob(bytes.substr(0, end), end == bytes.npos ? "" : bytes.substr(end + 1));
}

void read_hexadecimal(const std::string& bytes) {
  const auto read = core::from_hex(bytes);
  if (!read) throw Refusal("these are no hexadecimal digits");
  ensure(core::from_hex(core::to_hex(*read)) == read, "it reads back");
}

void read_text(const std::string& bytes) {
  const std::string text = core::readable_text(bytes, 20);
  ensure(core::is_readable(text), "what is made readable is so");
}

const Registration kTextsParsers(
    "texts",
    {
        {.name = "time",
         .read = read_time,
         .seeds = {"14.2", "1e-3", " 30 ", "0.000000000001", "9000000", "1.5E+2"},
         .alphabet = "0123456789.e+- "},
        {.name = "number",
         .read = read_number,
         .seeds = {"14", "3", "64", "1000", "12", "7"},
         .alphabet = "0123456789.e+-infa "},
        {.name = "value",
         .read = read_value,
         .seeds = {"11.5", "2true", "3-7", "41 2.5 -3e4", "5a text", "600ff", "8a0", ":1", "<2",
                   "<off"},
         .alphabet = "0123456789.e+- truefalsnoi:;<"},
        {.name = "condition",
         .read = read_condition,
         .seeds = {"10;1.5", "1;;0;1", "1;;;;3;0.1", "2;;;;true", "3-3;7", "5;;;;on", "<;;;;2"},
         .alphabet = "0123456789;.e+-truefalsn"},
        {.name = "glob",
         .read = read_glob,
         .seeds = {"a.*\na.x", "*.[a-c]?*\narm.b7",
                   "*a*a*a*a*a*b\naaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", "\\*[!x-z]\n*y"},
         .alphabet = "*?[]!-\\abc\n",
         .may_refuse = false},
        {.name = "hexadecimal",
         .read = read_hexadecimal,
         .seeds = {"00ff", "A0b1C2"},
         .alphabet = "0123456789abcdefABCDEF"},
        {.name = "readable_text",
         .read = read_text,
         .seeds = {"stra\xc3\x9f"
                   "e \xe2\x82\xac \xf0\x9f\x98\x80\x1b[31m a longer text"},
         .alphabet = "\x1b\xc3\xe2\x82\xf0\xed\xa0\x80\xff\n",
         .may_refuse = false},
    });

}  // namespace
}  // namespace stride::tests

// Campaigns, with the files that hold their values.
#include "master/study/campaign/definition/campaign_file.h"
#include "master/study/campaign/definition/decimal.h"
#include "master/study/campaign/plan.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

/// Cases of a campaign whose parameters are all numbers, or all texts.
void check_cases(campaign::Campaign read, campaign::ValueKind::Type type) {
  const std::vector<campaign::ValueKind> kinds(campaign::plan_columns(read).size(), {type});
  campaign::Fingerprints fingerprints;
  for (const campaign::Swap& swap : read.swaps) {
    for (const auto& unit : swap.alternatives) fingerprints.alternatives[{swap.name, unit.name}];
  }
  const campaign::Plan plan(std::move(read), kinds, fingerprints);
  for (const std::uint64_t index : {std::uint64_t{0}, plan.size() / 2, plan.size() - 1}) {
    const campaign::Case row = plan.at(index);
    ensure(plan.at(index).values == row.values, "a case stays the same");
    plan.command(row);
    ensure(plan.hash(row).size() == 64, "a case has a hash");
  }
}

void read_campaign(const std::string& bytes) {
  write_file("campaign/values.csv", "a.x,a.y\n1,2\n3,\n");
  const auto file = write_file("campaign/c.xosc", bytes);
  refusing_input("", [&] {
    const campaign::Campaign read = campaign::read_campaign(file);
    check_cases(read, campaign::ValueKind::Type::Float64);
  });
}

void read_values(const std::string& bytes) {
  const auto file = copy_seed("campaign/values.xosc", "values/c.xosc");
  write_file("values/values.csv", bytes);
  refusing_input(
      "", [&] { check_cases(campaign::read_campaign(file), campaign::ValueKind::Type::Text); });
}

void read_decimal(const std::string& bytes) {
  refusing<std::invalid_argument>("", [&] {
    const campaign::Decimal number = campaign::parse_decimal(bytes);
    const std::string text = campaign::step_text(number, {1, number.exponent}, 0);
    const campaign::Decimal again = campaign::parse_decimal(text);
    ensure(again.coefficient == number.coefficient &&
               (again.coefficient == 0 || again.exponent == number.exponent),
           "its text reads back");
  });
}

const Registration kCampaignParsers(
    "campaign",
    {
        {.name = "campaign_file",
         .read = read_campaign,
         .seed_files = {"tests/fuzz/seeds/campaign"}},
        {.name = "campaign_values",
         .read = read_values,
         .seeds = {"a.x,\"a \"\"y\"\"\"\n1,\n\"\",\"2, 3\"\n", "b.u\r\n0.5\r\n1e-3\r\n"},
         .alphabet = ",\"\r\n.ab01 "},
        {.name = "decimal",
         .read = read_decimal,
         .seeds = {"0.1", "-12.50", "1e-3", "+7E+12", "123456789012345678"},
         .alphabet = "0123456789.e+-"},
    });

}  // namespace
}  // namespace stride::tests

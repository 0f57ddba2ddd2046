// A design of TLM-2.0, of DESIGN_SOURCE with the module DESIGN_TOP: initiators, a bus and targets,
// of which each reports what it does and when.
#define sc_main design_main
#include DESIGN_SOURCE
#undef sc_main

#include <algorithm>

#include <catch2/catch.hpp>

#include <stride/systemc/time.h>

#include "tests/interop/systemc/network.h"

using stride::Duration;
using stride::tests::kNanosecond;
using stride::tests::Network;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

std::vector<std::string> reports;

/// SystemC's own, such as the first use of something deprecated, begin so.
bool is_own(const std::string& type) { return type.rfind('/', 0) == 0; }

void note(const sc_core::sc_report& report, const sc_core::sc_actions& /*actions*/) {
  if (!is_own(report.get_msg_type())) reports.emplace_back(report.get_msg());
}

std::vector<std::string> log_of(const UnitDriver& unit) {
  std::vector<std::string> lines;
  for (const auto& [severity, text] : unit.log) {
    if (!is_own(text)) lines.push_back(text);
  }
  return lines;
}

}  // namespace

TEST_CASE("a design of TLM-2.0") {
  sc_core::sc_report_handler::set_handler(&note);
  design_main(0, nullptr);
  sc_core::sc_report_handler::set_handler(&sc_core::sc_report_handler::default_handler);
  const Duration end = stride::systemc::to_duration(sc_core::sc_time_stamp());
  REQUIRE(reports.size() > 100);

  Network networks[2];
  UnitDriver* units[2] = {};
  for (int n = 0; n < 2; ++n) {
    units[n] = &networks[n].add<DESIGN_TOP>([](Rows<DESIGN_TOP>& rows) {
      rows.construct_by([](const char*) { return std::make_unique<DESIGN_TOP>("top"); });
      rows.output("name", [](const DESIGN_TOP& top) { return std::string(top.name()); });
    });
    networks[n].initialize();
  }
  for (Duration at{}; at <= end; at += 130 * kNanosecond) {
    for (Network& network : networks) network.step(130 * kNanosecond);
  }
  for (UnitDriver* unit : units) {
    const std::vector<std::string> lines = log_of(*unit);
    CHECK(std::equal(lines.begin(), lines.end(), reports.begin(), reports.end(),
                     [](const std::string& line, const std::string& report) {
                       return line.find(report) != std::string::npos;
                     }));
  }
}

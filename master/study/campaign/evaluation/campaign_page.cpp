#include "master/study/campaign/evaluation/campaign_page.h"

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/report/page.h"
#include "master/report/page_data.h"
#include "master/report/page_file.h"
#include "master/study/campaign/evaluation/case_analysis.h"
#include "master/study/campaign/evaluation/case_columns.h"

namespace stride::campaign {
namespace {

namespace fs = std::filesystem;
using report::Json;
using report::json_text;

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

/// As seen from the page, with slashes.
std::string seen_from(const fs::path& page, const fs::path& folder) {
  return fs::absolute(folder)
      .lexically_normal()
      .lexically_proximate(folder_of(page))
      .generic_string();
}

Json confidence_json(const Confidence& confidence) { return {confidence.low, confidence.high}; }

Json correlation_json(const RankCorrelation& found) {
  return {{"count", found.count},
          {"value", found.value ? Json(*found.value) : Json()},
          {"confidence", found.confidence ? confidence_json(*found.confidence) : Json()}};
}

Json correlations_json(std::span<const RankCorrelation> correlations) {
  Json all = Json::array();
  for (const RankCorrelation& found : correlations) all.push_back(correlation_json(found));
  return all;
}

Json correlations_json(const CaseAnalysis& analysis) {
  Json all = Json::array();
  for (const ParameterCorrelation& of : analysis.correlations) {
    all.push_back({{"parameter", of.parameter},
                   {"failure", correlation_json(of.with_failure)},
                   {"aggregates", correlations_json(of.with_aggregates)},
                   {"margins", correlations_json(of.with_margins)}});
  }
  return all;
}

Json shares_json(const CaseAnalysis& analysis) {
  Json all = Json::array();
  for (const ParameterShares& of : analysis.shares) {
    Json values = Json::array();
    for (const ValueShare& share : of.shares) {
      values.push_back({{"value", share.value},
                        {"cases", share.cases},
                        {"failed", share.failed},
                        {"confidence", confidence_json(share.confidence)}});
    }
    all.push_back({{"parameter", of.parameter}, {"count", of.values}, {"values", values}});
  }
  return all;
}

/// How the cases were made.
Json campaign_json(const Plan& plan) {
  const Campaign& campaign = plan.campaign();
  const auto* const drawn = std::get_if<Stochastic>(&campaign.variation);
  return {{"name", campaign.file.stem().string()},
          {"file", campaign.file.filename().string()},
          {"scenario",
           campaign.scenario.lexically_proximate(campaign.file.parent_path()).generic_string()},
          {"sampling", drawn != nullptr ? name(drawn->method) : "all combinations"},
          {"random_seed", drawn != nullptr ? Json(campaign.random_seed) : Json()},
          {"keep", name(campaign.keep.results)},
          {"cases", plan.size()}};
}

Json outcomes_json(const CaseColumns& columns) {
  Json counts = Json::array();
  for (std::size_t i = 0; i < kOutcomeKinds; ++i) {
    counts.push_back({{"name", i == kMissing ? "missing" : name(static_cast<Outcome>(i))},
                      {"cases", columns.counts[i]}});
  }
  return counts;
}

Json checks_json(const CaseColumns& columns) {
  Json checks = Json::array();
  for (const CheckCounts& check : columns.checks) {
    checks.push_back({{"name", check.name},
                      {"kind", check.kind},
                      {"passed", check.passed},
                      {"failed", check.failed},
                      {"undecided", check.undecided}});
  }
  return checks;
}

Json hosts_json(const CaseColumns& columns) {
  Json hosts = Json::array();
  for (const auto& [name, cases] : columns.cases_on) {
    hosts.push_back({{"name", name}, {"cases", cases}});
  }
  return hosts;
}

/// What the cases were made from.
Json sources_json(const Fingerprints& fingerprints) {
  Json sources = Json::array();
  const auto add = [&](const std::string& what, const std::string& digest) {
    sources.push_back({{"what", what}, {"sha256", digest}});
  };
  for (const auto& [file, digest] : fingerprints.files) add(file, digest);
  for (const auto& [unit, digest] : fingerprints.units) add("unit " + unit, digest);
  for (const auto& [names, digest] : fingerprints.alternatives) {
    add(fmt::format("unit {} of {}", names.second, names.first), digest);
  }
  return sources;
}

/// Writes the members of the data one after the other.
class PageWriter {
 public:
  PageWriter(report::Sink& file, const Plan& plan, const CaseColumns& columns)
      : file_(file), plan_(plan), columns_(columns) {}

  void write(const std::string& working_folder, const std::vector<std::string>& links) {
    member("campaign", json_text(campaign_json(plan_)));
    member("outcomes", json_text(outcomes_json(columns_)));
    member("wall_time", json_text(columns_.wall_time));
    member("began", json_text(Json{columns_.first_began, columns_.last_began}));
    member("hosts", json_text(hosts_json(columns_)));
    member("sources", json_text(sources_json(plan_.fingerprints())));
    member("checks", json_text(checks_json(columns_)));
    write_parameters();
    write_aggregates();
    write_margins();
    write_cases(links);
    const CaseAnalysis analysis = analyse(columns_);
    member("correlations", json_text(correlations_json(analysis)));
    member("shares", json_text(shares_json(analysis)));
    if (columns_.coverage) member("coverage", json_text(coverage::to_json(*columns_.coverage)));
    member("working_folder", json_text(working_folder));
  }

 private:
  void member(const char* name, const std::string& text) {
    report::write_member(file_, name, text);
  }

  template <class Write>
  void list(const char* name, std::size_t size, Write&& write_entry) {
    member(name, "[");
    for (std::size_t i = 0; i < size; ++i) {
      if (i > 0) file_.write(',');
      write_entry(i);
    }
    file_.write(']');
  }

  void write_parameters() {
    list("parameters", columns_.parameters.size(), [&](std::size_t i) {
      const ParameterColumn& column = columns_.parameters[i];
      file_.write(fmt::format(R"({{"name":{},"values":)", json_text(column.name)));
      file_.write(column.is_number ? report::blob(std::span(column.numbers))
                                   : report::blob(texts_of(column)));
      file_.write('}');
    });
  }

  static report::Texts texts_of(const ParameterColumn& column) {
    report::Texts texts;
    for (const std::string& text : column.texts) texts.add(text);
    return texts;
  }

  void write_aggregates() {
    list("aggregates", columns_.aggregates.size(), [&](std::size_t i) {
      const Aggregate& aggregate = plan_.campaign().aggregates[i];
      file_.write(fmt::format(R"({{"name":{},"signal":{},"function":"{}","values":)",
                              json_text(aggregate.name), json_text(aggregate.signal),
                              name(aggregate.function)));
      file_.write(report::blob(std::span(columns_.aggregates[i])));
      file_.write('}');
    });
  }

  void write_margins() {
    list("margins", columns_.margins.size(), [&](std::size_t i) {
      const MarginColumn& column = columns_.margins[i];
      file_.write(fmt::format(R"({{"name":{},"unit":{},"values":)", json_text(column.name),
                              json_text(column.unit)));
      file_.write(report::blob(std::span(column.values)));
      file_.write('}');
    });
  }

  void write_cases(const std::vector<std::string>& links) {
    member("cases", "{\"count\":" + std::to_string(columns_.size()));
    member("indices", report::blob(std::span(columns_.indices)));
    member("outcomes", report::blob(std::span(columns_.outcomes)));
    member("wall_times", report::blob(std::span(columns_.wall_times)));
    member("reached", report::blob(std::span(columns_.reached)));
    member("failed_at", report::blob(std::span(columns_.failed_at)));
    member("reasons", report::text_blob(columns_.reasons));
    member("links", report::text_blob(links));
    member("commands", report::text_blob(commands()));
    member("began", report::text_blob(columns_.began));
    member("hosts", report::text_blob(columns_.hosts));
    file_.write('}');
  }

  std::vector<std::string> commands() const {
    std::vector<std::string> made;
    for (const std::int32_t index : columns_.indices) {
      made.push_back(plan_.command(plan_.at(static_cast<std::uint64_t>(index))));
    }
    return made;
  }

  report::Sink& file_;
  const Plan& plan_;
  const CaseColumns& columns_;
};

/// To the page of each case, or else to its results; empty where none are kept.
std::vector<std::string> links_to(const CaseFolder& cases, const CaseColumns& columns,
                                  const fs::path& page, const std::string& report) {
  const fs::path base = seen_from(page, cases.path());
  std::vector<std::string> links;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns.has_results[i] == 0) {
      links.emplace_back();
      continue;
    }
    const fs::path results = cases.results_name(static_cast<std::uint64_t>(columns.indices[i]));
    const bool has_page = !report.empty() && core::is_file(cases.path() / results / report);
    links.push_back(
        (base / results / (has_page ? report : "")).lexically_normal().generic_string());
  }
  return links;
}

}  // namespace

void write_campaign_page(const fs::path& file, const Plan& plan, const CaseFolder& cases,
                         const std::string& report, CaseDefinitions coverage,
                         std::uint64_t most_cases) {
  const CaseColumns columns = read_case_columns(plan, cases, most_cases, std::move(coverage));
  report::write_page(
      file, report::campaign_page(), plan.fingerprints().version, [&](report::Sink& output) {
        PageWriter(output, plan, columns)
            .write(seen_from(file, fs::current_path()), links_to(cases, columns, file, report));
      });
}

}  // namespace stride::campaign

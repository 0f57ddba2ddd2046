// A plan and records of its cases, for tests.
#ifndef STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_RECORDS_H
#define STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_RECORDS_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "master/study/campaign/campaign_scenario.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/plan.h"
#include "tests/master/study/campaign/support.h"

namespace stride::tests {

/// A plan, of four cases unless it is another one, and where its records are.
struct Records {
  explicit Records(const std::string& runs = "4")
      : Records(stochastic(drawn("b.u", uniform("0", "1")), runs),
                "<stride:Aggregate name='a, \"b\"' signal='b.y' function='max'/>") {}
  Records(const std::string& distributions, const std::string& extension)
      : folder(campaign_text(distributions, extension)),
        plan(plan_in(folder)),
        cases(plan, folder / "out") {}

  static campaign::Plan plan_in(const CampaignFolder& folder) {
    campaign::Campaign read = folder.read();
    const campaign::CampaignScenario scenario(read, "1.0");
    return campaign::Plan(std::move(read), scenario.kinds(), scenario.fingerprints());
  }
  /// An empty file, with its folders.
  void touch(const std::string& name) const {
    std::filesystem::create_directories((folder / name).parent_path());
    folder.write(name, "");
  }
  void write(std::uint64_t index, const campaign::CaseResult& result) const {
    campaign::CaseScratch(cases).write(index, record_line(plan, plan.at(index), result));
  }

  CampaignFolder folder;
  campaign::Plan plan;
  campaign::CaseFolder cases;
};

}  // namespace stride::tests

#endif

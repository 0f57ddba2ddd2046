#include "master/front/cli/campaign/search/search_folder.h"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/study/campaign/cases/case_folder.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/campaign/plan_json.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kPlanKey = "plan";

Json search_json(const fs::path& folder, const search::Request& request,
                 const campaign::Plan& plan) {
  const fs::path file = fs::absolute(plan.campaign().file).lexically_normal();
  const fs::path base = fs::absolute(folder).lexically_normal();
  return {{"campaign", file.lexically_proximate(base).generic_string()},
          {kPlanKey, campaign::plan_identity(plan)},
          {"method", search::name(request.method)},
          {"seed", request.seed},
          {"check", request.check.empty() ? Json() : Json(request.check)}};
}

[[noreturn]] void fail_folder(const fs::path& folder, const std::string& why) {
  core::fail_input({.where = {folder.string(), 0}}, why,
                   "choose another folder with --out, or remove this one");
}

Json read_search(const fs::path& folder) {
  const fs::path file = folder / campaign::kSearchDescription;
  Json json = Json::parse(core::read_input(file), nullptr, false);
  if (json.is_object() && json.contains("campaign") && json["campaign"].is_string()) return json;
  core::fail_input({.where = {file.string(), 0}}, "this is not the description of a search",
                   "choose another folder with --out");
}

void require_same(const fs::path& folder, const Json& before, const Json& wanted, const char* key) {
  const Json value = before.contains(key) ? before[key] : Json();
  if (value == wanted.at(key)) return;
  if (std::string_view(key) == kPlanKey) {
    fail_folder(folder,
                "this folder belongs to a search of another campaign: the campaign, a file of its "
                "scenario, a unit or stride itself is not the same");
  }
  fail_folder(folder, fmt::format("this folder belongs to another search: its {} is {}, and not {}",
                                  key, value.is_null() ? "any" : value.dump(),
                                  wanted.at(key).is_null() ? "any" : wanted.at(key).dump()));
}

[[noreturn]] void fail_record(const fs::path& file, const std::string& of) {
  core::fail_input({.where = {file.string(), 0}}, fmt::format("this is not the record {}", of),
                   "remove it; the same search runs the case again");
}

}  // namespace

fs::path default_search_folder(const fs::path& campaign) {
  return campaign::default_folder(campaign).string() + ".search";
}

bool is_search_folder(const fs::path& folder) {
  return core::path_exists(folder / campaign::kSearchDescription);
}

bool is_this_search_in(const fs::path& folder, const search::Request& request,
                       const campaign::Plan& plan) {
  if (campaign::identity_in(folder)) fail_folder(folder, "this folder belongs to a campaign");
  if (!is_search_folder(folder)) return false;
  const Json wanted = search_json(folder, request, plan);
  const Json before = read_search(folder);
  for (const char* key : {kPlanKey, "method", "seed", "check"}) {
    require_same(folder, before, wanted, key);
  }
  return true;
}

void begin_search_folder(const fs::path& folder, const search::Request& request,
                         const campaign::Plan& plan) {
  if (is_this_search_in(folder, request, plan)) return;
  const campaign::CaseFolder cases(plan, folder);
  const campaign::CaseScratch scratch(cases);
  core::OutputFile file(scratch.file(campaign::kSearchDescription));
  file.write(
      search_json(folder, request, plan).dump(2, ' ', false, Json::error_handler_t::replace));
  file.write('\n');
  file.close();
  scratch.publish(campaign::kSearchDescription);
}

fs::path campaign_of_search(const fs::path& folder) {
  return (folder / read_search(folder)["campaign"].get<std::string>()).lexically_normal();
}

void require_plan_of_search(const fs::path& folder, const campaign::Plan& plan) {
  require_same(folder, read_search(folder), {{kPlanKey, campaign::plan_identity(plan)}}, kPlanKey);
}

std::vector<campaign::Text> values_in_search(const fs::path& folder, const campaign::Plan& plan,
                                             std::uint64_t index) {
  const fs::path file = folder / campaign::record_of_case(fmt::format("{:06}", index));
  if (!core::is_file(file)) {
    core::fail_input({.where = {folder.string(), 0}},
                     fmt::format("--case {}: the search has run no such case", index));
  }
  const Json record = Json::parse(core::read_input(file), nullptr, false);
  campaign::Case row;
  row.index = index;
  for (const campaign::PlanColumn& column : plan.columns()) {
    const Json::json_pointer place = Json::json_pointer("/values") / column.parameter.name;
    if (!record.is_object() || !record.contains(place)) fail_record(file, "of a case");
    const Json& value = record[place];
    row.values.push_back(value.is_string() ? campaign::Text(value.get<std::string>())
                                           : std::nullopt);
  }
  const bool is_of_case =
      record.value("case", Json()) == index && record.value("hash", Json()) == plan.hash(row);
  if (!is_of_case) fail_record(file, fmt::format("of case {}", index));
  return std::move(row.values);
}

}  // namespace stride::cli

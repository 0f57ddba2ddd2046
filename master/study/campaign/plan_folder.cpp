#include "master/study/campaign/plan_folder.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/base/text/words.h"
#include "master/base/xml/writer.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/signal_text.h"
#include "master/study/campaign/plan_json.h"
#include "master/system/ssp/ssp.h"

namespace stride::campaign {
namespace {

namespace fs = std::filesystem;

void write_whole(const fs::path& file, const std::string& text) {
  core::Replacement replacement(file);
  replacement.file().write(text);
  replacement.commit();
}

void write_table(const Plan& plan, const fs::path& file) {
  core::Replacement replacement(file);
  core::OutputFile& output = replacement.file();
  output.write("case");
  for (const PlanColumn& column : plan.columns()) {
    output.write(',');
    output.write(recorders::csv_field(column.parameter.name));
  }
  output.write(",seed,hash\n");
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const Case row = plan.at(i);
    output.write_number(i);
    for (const Text& value : row.values) {
      output.write(',');
      output.write(value_field(value));
    }
    output.write(',');
    output.write_number(row.seed);
    output.write(',');
    output.write(plan.hash(row));
    output.write('\n');
  }
  replacement.commit();
}

/// Of campaign.json; nothing if there is none.
std::optional<std::string> description_text(const fs::path& folder, const char* key) {
  const fs::path file = folder / kPlanDescription;
  if (!core::path_exists(file)) return std::nullopt;
  const auto json = nlohmann::json::parse(core::read_input(file), nullptr, false);
  if (json.is_object() && json.contains(key) && json[key].is_string()) {
    return json[key].get<std::string>();
  }
  core::fail_input({.where = {file.string(), 0}}, "this is not the description of a plan",
                   "choose another folder with --out");
}

void refuse_other_plan(const Plan& plan, const fs::path& folder) {
  if (core::path_exists(folder / kSearchDescription)) {
    core::fail_input({.where = {folder.string(), 0}}, "this folder belongs to a search",
                     "choose another folder with --out");
  }
  const auto other = identity_in(folder);
  if (!other || *other == plan_identity(plan)) return;
  core::fail_input({.where = {folder.string(), 0}},
                   "this folder belongs to another plan: the campaign, a file of its scenario, a "
                   "unit or stride itself is not the same",
                   "choose another folder with --out, or remove this one");
}

void write_value(xml::Writer& writer, const ValueKind& kind, const std::string& text) {
  const std::string tag = std::string("ssv:") + kind.variable_type;
  writer.open(tag.c_str());
  if (kind.is_array) {
    for (const std::string& word : core::words_of(text)) {
      writer.open("ssv:Value");
      writer.attribute("value", word);
      writer.close();
    }
  } else {
    writer.attribute("value", text);
  }
  writer.close();
}

std::string parameter_set(const Plan& plan, const Case& row) {
  xml::Writer writer;
  writer.open("ssv:ParameterSet");
  writer.attribute("xmlns:ssv", ssp::kSsv);
  writer.attribute("version", "2.0");
  writer.attribute("name", fmt::format("case {}", row.index));
  writer.open("ssv:Parameters");
  for (std::size_t i = 0; i < row.values.size(); ++i) {
    if (!row.values[i] || plan.columns()[i].role != PlanColumn::Role::Start) continue;
    writer.open("ssv:Parameter");
    writer.attribute("name", plan.columns()[i].parameter.name);
    write_value(writer, plan.kinds()[i], *row.values[i]);
    writer.close();
  }
  writer.close();
  writer.close();
  return writer.document();
}

}  // namespace

std::string value_field(const Text& value) {
  if (!value) return "";
  return value->empty() ? "\"\"" : recorders::csv_field(*value);
}

fs::path default_folder(const fs::path& campaign) {
  return fs::path("campaigns") / campaign.stem();
}

std::optional<std::string> identity_in(const fs::path& folder) {
  return description_text(folder, "identity");
}

fs::path campaign_of(const fs::path& folder) {
  const auto campaign = description_text(folder, "campaign");
  if (campaign) return (folder / *campaign).lexically_normal();
  core::fail_input({.where = {folder.string(), 0}}, "there is no plan in this folder",
                   "name the file of the campaign");
}

bool has_plan(const Plan& plan, const fs::path& folder) {
  refuse_other_plan(plan, folder);
  return identity_in(folder).has_value();
}

void write_plan(const Plan& plan, const fs::path& folder) {
  refuse_other_plan(plan, folder);
  recorders::make_results_folder(folder);
  const recorders::ResultsLock lock(folder);
  write_table(plan, folder / kPlanTable);
  write_whole(folder / kPlanDescription, plan_json(plan, folder));
}

void refuse_parameter_sets_of(const Plan& plan) {
  const Campaign& campaign = plan.campaign();
  const bool has_swaps = !campaign.swaps.empty();
  if (!has_swaps && campaign.interventions.empty()) return;
  const std::string& name =
      has_swaps ? campaign.swaps.front().name : campaign.interventions.front().name;
  core::fail_input(
      {.where = has_swaps ? campaign.swaps.front().where : campaign.interventions.front().where},
      fmt::format("a parameter set (.ssv) cannot hold the {} '{}'",
                  has_swaps ? "swap" : "intervention", name),
      "leave --ssv out; --case INDEX prints all settings of a case");
}

std::string case_name(const Plan& plan, std::uint64_t index) {
  const std::size_t digits = std::max<std::size_t>(6, std::to_string(plan.size() - 1).size());
  return fmt::format("{:0{}}", index, digits);
}

fs::path parameter_set_name(const Plan& plan, std::uint64_t index) {
  return fs::path(kParameterSets) / (case_name(plan, index) + ".ssv");
}

void write_parameter_sets(const Plan& plan, const fs::path& folder) {
  refuse_parameter_sets_of(plan);
  recorders::make_results_folder(folder / kParameterSets);
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    write_whole(folder / parameter_set_name(plan, i), parameter_set(plan, plan.at(i)));
  }
}

void write_parameter_set(const Plan& plan, const Case& row, const fs::path& file) {
  write_whole(file, parameter_set(plan, row));
}

}  // namespace stride::campaign

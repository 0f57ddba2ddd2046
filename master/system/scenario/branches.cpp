#include "master/system/scenario/branches.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/base/xml/document.h"
#include "master/base/xml/element.h"
#include "master/observe/recorders/results_folder.h"
#include "master/system/declaration/intervention_element.h"
#include "master/system/ssp/ssp.h"

namespace stride::scenario {
namespace {

BranchDeclaration read_branch(const xml::Element& element) {
  element.allow_attributes({"name"});
  element.allow_children({{ssp::kStrideScenario, "Set"},
                          {ssp::kStrideScenario, "Force"},
                          {ssp::kStrideScenario, "Drop"},
                          {ssp::kStrideScenario, "Delay"},
                          {ssp::kStrideScenario, "Corrupt"}});
  BranchDeclaration branch{element.required("name"), {}, element.where()};
  if (branch.name.empty() || !recorders::is_plain_file_name(branch.name)) {
    element.fail(fmt::format("name=\"{}\" is not a plain file name", branch.name),
                 "the results of the branch go into a folder of this name");
  }
  for (const xml::Element& child : element.children()) {
    branch.interventions.push_back(read_intervention(child));
  }
  return branch;
}

}  // namespace

std::vector<BranchDeclaration> read_branches(const std::filesystem::path& file) {
  const xml::Document document(file);
  const xml::Element root = document.root();
  if (!root.is(ssp::kStrideScenario, "Branches")) {
    root.fail(fmt::format("expected <Branches> of the namespace '{}'", ssp::kStrideScenario));
  }
  root.allow_attributes({});
  root.allow_children({xml::Name(ssp::kStrideScenario, "Branch")});
  std::vector<BranchDeclaration> branches;
  std::set<std::string> names;
  for (const xml::Element& child : root.children()) {
    branches.push_back(read_branch(child));
    if (names.insert(branches.back().name).second) continue;
    child.fail(fmt::format("there are two branches of the name '{}'", branches.back().name),
               "give each a name of its own");
  }
  if (branches.empty()) root.fail("there is no branch", "add a <stride:Branch name=\"…\">");
  return branches;
}

BranchReference parse_branch_reference(const std::string& option, const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
    core::fail_input({}, fmt::format("{} {}: expected FILE:NAME", option, text),
                     "name the file that lists the branches, and one of them");
  }
  return {text.substr(0, colon), text.substr(colon + 1)};
}

BranchDeclaration find_branch(const BranchReference& reference) {
  std::vector<std::string> names;
  for (BranchDeclaration& branch : read_branches(reference.file)) {
    if (branch.name == reference.name) return std::move(branch);
    names.push_back(branch.name);
  }
  core::fail_input({.where = {reference.file.string(), 0}},
                   fmt::format("there is no branch '{}'", reference.name),
                   core::suggestion(reference.name, names));
}

}  // namespace stride::scenario

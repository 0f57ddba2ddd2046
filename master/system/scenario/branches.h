// Several futures of a run, as a file lists them.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_BRANCHES_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_BRANCHES_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/system/declaration/interventions.h"

namespace stride::scenario {

/// One of several futures of a run, which begin at the same instant.
struct BranchDeclaration {
  std::string name;  ///< unique, and a plain name of a folder
  std::vector<InterventionDeclaration> interventions;
  core::Location where{};
};

/// Reads a file with <stride:Branches>, which has a <stride:Branch name="…"> with interventions for
/// each of them. Throws core::Error (Input), also for a file without branches.
std::vector<BranchDeclaration> read_branches(const std::filesystem::path& file);

/// A branch in such a file.
struct BranchReference {
  std::filesystem::path file;
  std::string name;
};

/// Takes "FILE:NAME", as `option` has it. Throws core::Error (Input).
BranchReference parse_branch_reference(const std::string& option, const std::string& text);
/// Throws core::Error (Input), with the nearest name, where the file has no such branch.
BranchDeclaration find_branch(const BranchReference& reference);

}  // namespace stride::scenario

#endif

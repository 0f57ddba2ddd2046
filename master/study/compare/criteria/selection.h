// Which signals and messages are compared.
#ifndef STRIDE_MASTER_STUDY_COMPARE_CRITERIA_SELECTION_H
#define STRIDE_MASTER_STUDY_COMPARE_CRITERIA_SELECTION_H

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace stride::compare {

/// Whether a pattern, a name or a glob, means this signal: the name of an array all its elements.
bool is_meant(const std::string& pattern, const std::string& name);

class Selection {
 public:
  /// Patterns; without any of `only` all are selected, but for the ignored ones.
  Selection(std::vector<std::string> only, std::vector<std::string> ignored)
      : only_(std::move(only)), ignored_(std::move(ignored)) {}

  bool has(const std::string& name) const;
  /// Throws core::Error (Input) for a pattern that means none of these names.
  void require_use(std::span<const std::string> names) const;

 private:
  std::vector<std::string> only_;
  std::vector<std::string> ignored_;
};

}  // namespace stride::compare

#endif

#ifndef STRIDE_MASTER_STUDY_VERIFY_FINDING_H
#define STRIDE_MASTER_STUDY_VERIFY_FINDING_H

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stride::verify {

enum class Verdict { Passed, Failed, Skipped };

/// "passed", "FAILED", "skipped"
const char* name(Verdict verdict);

/// What a check has found out.
struct Finding {
  Verdict verdict = Verdict::Passed;
  std::string seen;                ///< one line
  std::vector<std::string> notes;  ///< what is worth knowing and no failure; a line each
};

inline Finding passed(std::string seen, std::vector<std::string> notes = {}) {
  return {Verdict::Passed, std::move(seen), std::move(notes)};
}
inline Finding failed(std::string seen, std::vector<std::string> notes = {}) {
  return {Verdict::Failed, std::move(seen), std::move(notes)};
}
inline Finding skipped(std::string why) { return {Verdict::Skipped, std::move(why), {}}; }

/// Thrown where a check, however deep it is in, has seen that the unit fails it.
class Failure : public std::runtime_error {
 public:
  /// `breaks_rule`: the rule of the check (UnitCheck::rules); else what is only declared to stride.
  explicit Failure(const std::string& seen, bool breaks_rule = true)
      : std::runtime_error(seen), breaks_rule_(breaks_rule) {}
  bool breaks_rule() const { return breaks_rule_; }

 private:
  bool breaks_rule_;
};

}  // namespace stride::verify

#endif

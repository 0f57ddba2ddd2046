// Names that options begin with, as in "component.variable=value", where a name may hold a '='.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_KNOWN_NAMES_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_KNOWN_NAMES_H

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/engine/model/description.h"
#include "master/engine/model/system/system.h"

namespace stride::core {

struct Assignment {
  std::string name;
  std::optional<std::string> value;  ///< none: the text is a name alone
};

/// The full name of a variable of `alone`, a component that has no other beside it, where its own
/// name does: "component.name", unless it begins so already. Without such a component, `name`.
std::string with_component(const std::string& alone, const std::string& name);

class KnownNames {
 public:
  KnownNames() = default;
  /// Of components, whose values are files or places: these may hold a '='.
  explicit KnownNames(std::span<const std::string> components);
  /// Of the variables of a system, with their aliases; see stand_alone().
  explicit KnownNames(const System& system, const std::string& alone = "");

  /// `has_free_value`: a value may hold a '='.
  void add(const std::string& name, bool has_free_value);
  /// The variables of a unit, behind "component.".
  void add(const std::string& prefix, const UnitDescription& description);
  /// From now on the variables of this component may be named without it: split() gives their full
  /// names, see with_component().
  void stand_alone(const std::string& component, const UnitDescription& description);

  /// Splits "NAME=VALUE", or "NAME" where `may_lack_value`, behind the longest name that is known,
  /// or else at the first '='. Throws Error (Input) for a text that can be meant in two ways.
  Assignment split(const std::string& option, const std::string& text, bool may_lack_value) const;

 private:
  /// Whether the name is known, alone or as that of an element, and its value may hold a '='.
  std::optional<bool> find(const std::string& name) const;
  std::vector<std::size_t> known_ends(const std::string& text, bool may_lack_value) const;
  std::size_t end_of_name(const std::string& option, const std::string& text,
                          bool may_lack_value) const;
  /// Whether what is behind the name may be its value.
  bool is_plausible(const std::string& text, std::size_t end) const;

  std::string alone_;  ///< the component whose variables are named without it, too
  std::map<std::string, bool, std::less<>> names_;  ///< each with `has_free_value`
};

}  // namespace stride::core

#endif

// What the descriptions of a variable in both versions of FMI have in common.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_VARIABLE_ATTRIBUTES_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_VARIABLE_ATTRIBUTES_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"

namespace stride::importer {

/// The enumerator of this name, of the first `count`.
template <class Enum>
std::optional<Enum> find_named(std::string_view word, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (word == core::name(static_cast<Enum>(i))) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

/// Marks the variables that have a value reference of their base type in common, which are
/// `references` of the variables in their order.
void mark_aliases(std::span<const std::uint32_t> references,
                  std::vector<core::Variable>& variables);

/// The names of the variables and aliases of a description, of which each is to be there once.
class VariableNames {
 public:
  explicit VariableNames(core::UnitDescription& unit) : unit_(unit) {}

  /// A name of the variable that is the next one of the description. If another one has it already,
  /// its index, and the name is not to be added: there is a warning, and the name is ambiguous
  /// unless both are the same.
  using IsSame = std::function<bool(std::size_t first)>;
  std::optional<std::size_t> add(const std::string& name, const xml::Element& place,
                                 const IsSame& is_same);

 private:
  struct First {
    std::size_t variable;
    int line;
  };
  core::UnitDescription& unit_;
  std::map<std::string, First> first_;
};

/// Whether variables of one name and one value reference are declared alike.
bool are_declared_alike(const core::Variable& a, const core::Variable& b);

/// The types that are declared by name, each by the element that defines it.
class TypeDefinitions {
 public:
  /// What is odd is added to `warnings`, which must outlive it.
  explicit TypeDefinitions(std::vector<std::string>& warnings) : warnings_(&warnings) {}

  /// Throws core::Error of the kind Input at the definition whose name is there already.
  void add(const xml::Element& definition, const xml::Element& type);
  /// The `declaredType` of an element, if it has one. One that is not there is ignored, with a
  /// warning for each.
  std::optional<xml::Element> declared(const xml::Element& element) const;
  /// Throws core::Error of the kind Input for an Enumeration, which must have one.
  [[noreturn]] static void fail_without(const xml::Element& enumeration);

 private:
  std::map<std::string, xml::Element> types_;
  mutable std::set<std::string> missing_;
  std::vector<std::string>* warnings_;
};

// Each throws core::Error of the kind Input where the attribute has another value than it may. A
// word in another case than it should be has a warning.

/// Local if it is absent.
core::Causality read_causality(const xml::Element& variable, std::vector<std::string>& warnings);
/// If it is absent, fixed for parameters, else continuous for floating-point numbers, else
/// discrete (FMI 3.0, 2.4.7.4).
core::Variability read_variability(const xml::Element& variable, core::ValueType type,
                                   core::Causality causality, std::vector<std::string>& warnings);
/// From its causality and variability, if it is absent (FMI 3.0, 2.4.7.5; FMI 2.0, 2.2.7). Inputs
/// are exact.
core::Initial read_initial(const xml::Element& element, const core::Variable& variable);

/// An attribute of the variable, or else of its declared type.
std::string inherited(const xml::Element& element, const std::optional<xml::Element>& type,
                      const char* attribute);
/// The unit of measure, and whether the variable is a difference (FMI 3.0, 2.4.7.3; FMI 2.0, 2.2.3;
/// FMI 1.0, 2.3).
void read_unit(const xml::Element& element, const std::optional<xml::Element>& declared,
               core::Variable& variable, std::vector<std::string>& warnings);
/// Likewise the magnitude of a floating-point number; 0 if it is absent.
double read_nominal(const xml::Element& element, core::ValueType type,
                    const std::optional<xml::Element>& declared);
/// Throws where the start value of a variable, whose size is known, is not of its type, or has
/// neither one element nor as many as the variable. `elements`: how many a String or Binary has.
/// A value of another form that has one meaning is replaced by it, and an empty one of a type that
/// is no text is none, with a warning. So is there of one that is not finite, or not an item.
void check_start(const xml::Element& element, core::Variable& variable,
                 std::vector<std::string>& warnings, std::size_t elements = 1);
/// Throws where the least or the greatest value of a variable is no number. If the least one is
/// above the greatest one, it has neither, with a warning.
void check_limits(const xml::Element& element, core::Variable& variable,
                  std::vector<std::string>& warnings);
/// The items of an enumeration's type.
std::vector<std::pair<std::string, std::int64_t>> read_items(const xml::Element& type);

}  // namespace stride::importer

#endif

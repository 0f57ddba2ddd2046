// What the instances of FMI 1.0 and of FMI 2.0 units have in common.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_SCALAR_UNIT_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_SCALAR_UNIT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/fmu/instance/fmu_instance_calls.h"
#include "master/loader/fmu/instance/log_references.h"

namespace stride::importer {

/// An instance of a version with scalar variables of four base types, whose value references are
/// the unit's own, and without Event Mode. Real is Float64, Integer Int32, Enumeration core's
/// Enumeration, which has 32 bits here.
///
/// `Version` has the types Functions, Reference, Integer, Boolean and String, the values kTrue and
/// kFalse, its name kName, and those of its functions, kGetReal, kSetReal, ….
template <class Version>
class ScalarUnit : public FmuInstance {
 public:
  void get(References references, core::ValueBlock& values) override;
  void set(References references, const core::ValueBlock& values) override;
  void enter_event_mode() override { fail(no_event_mode()); }
  core::EventResult update_discrete_states() override { fail(no_event_mode()); }
  void enter_step_mode() override { fail(no_event_mode()); }

 protected:
  using Functions = typename Version::Functions;
  using Reference = typename Version::Reference;

  /// `functions` are the library's, `references` the unit's by core's. Both must outlive the
  /// instance.
  ScalarUnit(const char* prefix, const Functions& functions,
             const std::vector<Reference>& references, std::shared_ptr<const SharedLibrary> library,
             std::string name, UnitParts parts, InstanceOptions options)
      : FmuInstance(prefix, std::move(library), std::move(name), std::move(parts),
                    std::move(options)),
        fmi_(functions),
        unit_references_(references.data()) {}

  /// The unit's value references, in place of core's.
  const Reference* own(References references) { return own(references, own_); }
  const Reference* own(References references, std::vector<Reference>& into) {
    into.resize(references.size());
    for (std::size_t i = 0; i < references.size(); ++i) into[i] = unit_references_[references[i]];
    return into.data();
  }

  /// A message with the names of the variables that it refers to.
  std::string with_names(const std::string& message) const {
    return name_variables(message,
                          [&](char type, Reference reference) { return name_of(type, reference); });
  }

  const Functions& fmi_;
  const Reference* unit_references_;

 private:
  using Integer = typename Version::Integer;

  void get_enumerations(References references, std::span<std::int64_t> values);
  void set_enumerations(References references, std::span<const std::int64_t> values);
  void get_booleans(References references, std::span<bool> values);
  void set_booleans(References references, std::span<const bool> values);
  void get_strings(References references, std::span<std::string> values);
  void set_strings(References references, std::span<const std::string> values);
  std::string name_of(char type, Reference reference) const;
  static std::string no_event_mode() {
    return fmt::format("{} Co-Simulation has no Event Mode", Version::kName);
  }
  [[noreturn]] void fail_type(core::ValueType type) const {
    fail(fmt::format("{} has no type {}", Version::kName, core::name(type)));
  }

  std::vector<Reference> own_;
  std::vector<Integer> integers_;
  std::vector<typename Version::Boolean> booleans_;
  std::vector<typename Version::String> texts_;
};

/// The first of them, if there are aliases.
template <class Version>
std::string ScalarUnit<Version>::name_of(char type, Reference reference) const {
  const auto is_of_type = [&](core::ValueType t) {
    switch (type) {
      case 'r':
        return t == core::ValueType::Float64;
      case 'i':
        return t == core::ValueType::Int32 || t == core::ValueType::Enumeration;
      case 'b':
        return t == core::ValueType::Boolean;
      default:
        return t == core::ValueType::String;
    }
  };
  for (const core::Variable& variable : parts_.description->variables) {
    if (unit_references_[variable.reference] == reference && is_of_type(variable.type)) {
      return variable.name;
    }
  }
  return "";
}

template <class Version>
void ScalarUnit<Version>::get(References references, core::ValueBlock& values) {
  switch (values.type()) {
    case core::ValueType::Float64:
      return call(Version::kGetReal, fmi_.GetReal, own(references), references.size(),
                  values.numbers<double>().data());
    case core::ValueType::Int32:
      return call(Version::kGetInteger, fmi_.GetInteger, own(references), references.size(),
                  values.numbers<Integer>().data());
    case core::ValueType::Enumeration:
      return get_enumerations(references, values.numbers<std::int64_t>());
    case core::ValueType::Boolean:
      return get_booleans(references, values.numbers<bool>());
    case core::ValueType::String:
      return get_strings(references, values.strings());
    default:
      fail_type(values.type());
  }
}

template <class Version>
void ScalarUnit<Version>::set(References references, const core::ValueBlock& values) {
  switch (values.type()) {
    case core::ValueType::Float64:
      return call(Version::kSetReal, fmi_.SetReal, own(references), references.size(),
                  values.numbers<double>().data());
    case core::ValueType::Int32:
      return call(Version::kSetInteger, fmi_.SetInteger, own(references), references.size(),
                  values.numbers<Integer>().data());
    case core::ValueType::Enumeration:
      return set_enumerations(references, values.numbers<std::int64_t>());
    case core::ValueType::Boolean:
      return set_booleans(references, values.numbers<bool>());
    case core::ValueType::String:
      return set_strings(references, values.strings());
    default:
      fail_type(values.type());
  }
}

template <class Version>
void ScalarUnit<Version>::get_enumerations(References references, std::span<std::int64_t> values) {
  integers_.resize(values.size());
  call(Version::kGetInteger, fmi_.GetInteger, own(references), references.size(), integers_.data());
  std::ranges::copy(integers_, values.begin());
}

template <class Version>
void ScalarUnit<Version>::set_enumerations(References references,
                                           std::span<const std::int64_t> values) {
  integers_.clear();
  for (const std::int64_t value : values) {
    using Limits = std::numeric_limits<Integer>;
    if (value < Limits::min() || value > Limits::max()) {
      fail(fmt::format("the value {} does not fit into an Enumeration of {} (32 bits)", value,
                       Version::kName));
    }
    integers_.push_back(static_cast<Integer>(value));
  }
  call(Version::kSetInteger, fmi_.SetInteger, own(references), references.size(),
       std::as_const(integers_).data());
}

template <class Version>
void ScalarUnit<Version>::get_booleans(References references, std::span<bool> values) {
  booleans_.resize(values.size());
  call(Version::kGetBoolean, fmi_.GetBoolean, own(references), references.size(), booleans_.data());
  std::ranges::transform(booleans_, values.begin(),
                         [](auto value) { return value != Version::kFalse; });
}

template <class Version>
void ScalarUnit<Version>::set_booleans(References references, std::span<const bool> values) {
  booleans_.resize(values.size());
  std::ranges::transform(values, booleans_.begin(),
                         [](bool value) { return value ? Version::kTrue : Version::kFalse; });
  call(Version::kSetBoolean, fmi_.SetBoolean, own(references), references.size(),
       std::as_const(booleans_).data());
}

// What a unit returns is its own memory, valid until its next function is called: copied at once.
template <class Version>
void ScalarUnit<Version>::get_strings(References references, std::span<std::string> values) {
  texts_.assign(values.size(), nullptr);
  call(Version::kGetString, fmi_.GetString, own(references), references.size(), texts_.data());
  copy_texts(Version::kGetString, references, texts_, values);
}

template <class Version>
void ScalarUnit<Version>::set_strings(References references, std::span<const std::string> values) {
  texts_.resize(values.size());
  std::ranges::transform(values, texts_.begin(),
                         [](const std::string& value) { return value.c_str(); });
  call(Version::kSetString, fmi_.SetString, own(references), references.size(),
       std::as_const(texts_).data());
}

/// The types and names of a version: "fmi2Integer", "fmi2GetReal". `prefix` of the C types, and of
/// the functions' names as messages have them.
#define STRIDE_SCALAR_VERSION(prefix, shown)                     \
  using Reference = prefix##ValueReference;                      \
  using Integer = prefix##Integer;                               \
  using Boolean = prefix##Boolean;                               \
  using String = prefix##String;                                 \
  static constexpr Boolean kTrue = prefix##True;                 \
  static constexpr Boolean kFalse = prefix##False;               \
  static constexpr const char* kGetReal = shown "GetReal";       \
  static constexpr const char* kSetReal = shown "SetReal";       \
  static constexpr const char* kGetInteger = shown "GetInteger"; \
  static constexpr const char* kSetInteger = shown "SetInteger"; \
  static constexpr const char* kGetBoolean = shown "GetBoolean"; \
  static constexpr const char* kSetBoolean = shown "SetBoolean"; \
  static constexpr const char* kGetString = shown "GetString";   \
  static constexpr const char* kSetString = shown "SetString";

}  // namespace stride::importer

#endif

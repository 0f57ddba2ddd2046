#include "master/study/campaign/definition/parameter_list.h"

#include <cctype>

#include <fmt/format.h>

#include "master/base/message_text.h"

namespace stride::campaign {
namespace {

std::string place_text(const core::Location& earlier, const core::Location& here) {
  if (earlier.file == here.file) return fmt::format("in line {}", earlier.line);
  return fmt::format("in {}, line {}", core::name_text(earlier.file), earlier.line);
}

}  // namespace

std::size_t ParameterList::add(const std::string& name, const core::Location& where) {
  if (name.empty()) core::fail_input({.where = where}, "a parameter has no name");
  if (name == "case" || name == "seed" || name == "hash") {
    core::fail_input({.where = where},
                     fmt::format("'{}' is the name of a column that each plan has", name),
                     "choose another name");
  }
  const auto [entry, is_new] = places_.emplace(name, parameters_.size());
  if (!is_new) {
    core::fail_input(
        {.where = where},
        fmt::format("'{}' has two sources of values; the other one is {}", core::name_text(name),
                    place_text(parameters_[entry->second].where, where)),
        "leave one of them out");
  }
  parameters_.push_back({literal(name, where), where});
  return entry->second;
}

std::string literal(const std::string& text, const core::Location& where) {
  const bool is_reference =
      text.size() > 1 && text[0] == '$' &&
      (text[1] == '{' || text[1] == '_' || std::isalpha(static_cast<unsigned char>(text[1])) != 0);
  if (!is_reference) return text;
  core::fail_input({.where = where},
                   fmt::format("'{}' refers to a parameter, and a file of distributions declares "
                               "none",
                               core::name_text(text)),
                   "write the value itself");
}

}  // namespace stride::campaign

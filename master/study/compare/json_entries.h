// What run.json contains, of which a reader cannot be sure.
#ifndef STRIDE_MASTER_STUDY_COMPARE_JSON_ENTRIES_H
#define STRIDE_MASTER_STUDY_COMPARE_JSON_ENTRIES_H

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/error.h"
#include "master/report/page_data.h"

namespace stride::compare {

/// Null where there is none.
inline const report::Json& json_member(const report::Json& object, const char* name) {
  static const report::Json kNone;
  if (!object.is_object()) return kNone;
  const auto found = object.find(name);
  return found == object.end() ? kNone : *found;
}

/// A text as it is, a number with all digits, anything else as JSON; empty where it is missing.
inline std::string json_word(const report::Json& object, const char* member) {
  const report::Json& found = json_member(object, member);
  if (found.is_null()) return "";
  if (found.is_string()) return found.get<std::string>();
  return found.dump(-1, ' ', false, report::Json::error_handler_t::replace);
}

/// The objects of a list; none where it is missing. Throws core::Error (Input), at the file.
inline std::vector<const report::Json*> json_entries(const report::Json& object, const char* member,
                                                     const std::filesystem::path& file) {
  std::vector<const report::Json*> entries;
  if (!object.is_object()) return entries;
  const auto found = object.find(member);
  if (found == object.end()) return entries;
  const auto require = [&](bool is_good, const char* expected) {
    if (is_good) return;
    core::fail_input(
        {.where = {file.string(), 0}},
        fmt::format("this is not what `stride run` writes: '{}' is no {}", member, expected),
        "run the scenario again");
  };
  require(found->is_array(), "list");
  for (const report::Json& entry : *found) {
    require(entry.is_object(), "list of objects");
    entries.push_back(&entry);
  }
  return entries;
}

}  // namespace stride::compare

#endif

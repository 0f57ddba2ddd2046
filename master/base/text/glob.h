#ifndef STRIDE_MASTER_BASE_TEXT_GLOB_H
#define STRIDE_MASTER_BASE_TEXT_GLOB_H

#include <string>

namespace stride::core {

/// Whether the whole text matches the pattern: `*` matches any characters (dots, too), `?` for
/// one, `[a-c]` and `[!a-c]` for one within or outside the set, `\` takes away a special meaning.
bool matches_glob(const std::string& pattern, const std::string& text);

/// Whether a pattern, or a plain name with special characters, means this name.
bool means(const std::string& pattern, const std::string& name);

/// Whether the pattern has any of these special characters.
bool is_glob(const std::string& pattern);

}  // namespace stride::core

#endif

// References to characters by their numbers: &#13; or &#xD;.
#ifndef STRIDE_MASTER_UTIL_XML_CHARACTER_REFERENCES_H
#define STRIDE_MASTER_UTIL_XML_CHARACTER_REFERENCES_H

#include <cstddef>
#include <optional>
#include <string_view>

namespace stride::xml {

/// The position of the first reference that is malformed or of no character that XML 1.0 allows
/// ("Char"), such as &#0;. Comments, CDATA sections and processing instructions have none.
std::optional<std::size_t> find_bad_reference(std::string_view text);

}  // namespace stride::xml

#endif

// What a text in XML may not contain: characters, and references to characters and entities.
#ifndef STRIDE_MASTER_BASE_XML_CHARACTER_REFERENCES_H
#define STRIDE_MASTER_BASE_XML_CHARACTER_REFERENCES_H

#include <cstddef>
#include <optional>
#include <string_view>

namespace stride::xml {

/// The position of the first reference that is malformed or of no character that XML 1.0 allows
/// ("Char"), such as &#0;, or to an entity that is not one of the five of XML, such as &name;.
/// Comments, CDATA sections and processing instructions have none.
std::optional<std::size_t> find_bad_reference(std::string_view text);

/// The position of the first control character that XML 1.0 does not allow: all of ASCII but tab,
/// line feed and carriage return.
std::optional<std::size_t> find_bad_character(std::string_view text);

}  // namespace stride::xml

#endif

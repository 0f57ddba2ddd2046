// Start and end tags that do not belong together.
#ifndef STRIDE_MASTER_BASE_XML_TAG_MISTAKE_H
#define STRIDE_MASTER_BASE_XML_TAG_MISTAKE_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stride::xml {

/// The line of a position in the text; the first one is 1.
int line_at(std::string_view text, std::size_t position);

struct TagMistake {
  std::size_t position = 0;  ///< where it shows: at a tag, or where the text ends
  std::string reason;
  std::string hint;
};

/// The first tag without its end, the first end tag that ends another element than the one that is
/// open, or the end of the text within an element. Nothing if each element has its end tag; the
/// text may still be no XML for another reason.
std::optional<TagMistake> find_tag_mistake(std::string_view text);

}  // namespace stride::xml

#endif

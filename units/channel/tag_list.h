// The file that names a channel's tags.
#ifndef STRIDE_UNITS_CHANNEL_TAG_LIST_H
#define STRIDE_UNITS_CHANNEL_TAG_LIST_H

#include <string>
#include <vector>

namespace channel {

/// The tags' names in the order of the file, which looks like
///
///     <nfc-channel version="1">
///       <tag name="door"/>
///       <tag name="window"/>
///     </nfc-channel>
///
/// with the root element that the technology expects.
/// A name is an identifier, begins the names of the tag's variables, and is not one of those that
/// the channel itself uses. Throws std::runtime_error with file, line and what was expected.
std::vector<std::string> read_tag_list(const std::string& file, const std::string& root);

/// The same from a text, for whose errors `file` is the name.
std::vector<std::string> parse_tag_list(const std::string& text, const std::string& file,
                                        const std::string& root);

}  // namespace channel

#endif

// The items of an enumeration, in words.
#ifndef STRIDE_MASTER_ENGINE_MODEL_ITEM_TEXT_H
#define STRIDE_MASTER_ENGINE_MODEL_ITEM_TEXT_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/model/transformation.h"

namespace stride::core {

/// "off (0), on (1)".
std::string item_text(const EnumerationItems& items);

/// The name of the item with this number, or the number itself where there is none.
std::string item_name(std::int64_t number, const EnumerationItems& items);
/// The number of the item with this name, blanks apart, or else of the one with this number.
std::optional<std::int64_t> item_number(const std::string& text, const EnumerationItems& items);
/// A text whose words are the numbers of items, with their names. Throws std::invalid_argument for
/// a word that is none.
std::string numbers_as_names(const std::string& text, const EnumerationItems& items);

/// The elements of a value: what is between blanks, except that the name of an item may hold blanks
/// itself. A text that is such a name is one element. Throws std::invalid_argument for a text that
/// can be read in two ways.
std::vector<std::string> item_words(const std::string& text, const EnumerationItems& items);

}  // namespace stride::core

#endif

// The items of an enumeration, in words.
#ifndef STRIDE_MASTER_MODEL_ITEM_TEXT_H
#define STRIDE_MASTER_MODEL_ITEM_TEXT_H

#include <string>

#include "master/model/transformation.h"

namespace stride::core {

/// "off (0), on (1)".
std::string item_text(const EnumerationItems& items);

}  // namespace stride::core

#endif

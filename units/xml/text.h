// Numbers and lists of words as text, for reports and messages.
#ifndef STRIDE_UNITS_XML_TEXT_H
#define STRIDE_UNITS_XML_TEXT_H

#include <string>
#include <vector>

namespace xml {

/// The shortest decimal that reads back as the same number; never a decimal comma.
std::string shortest(double number);

/// The words in quotation marks with commas between them.
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace xml

#endif

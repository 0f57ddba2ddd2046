// Numbers as text, for verdicts and messages.
#ifndef STRIDE_UNITS_GROUND_TRUTH_TEXT_H
#define STRIDE_UNITS_GROUND_TRUTH_TEXT_H

#include <string>

namespace ground_truth {

/// With six digits, and its unit behind it, if it has one; never a decimal comma.
std::string quantity_text(double number, const std::string& unit);

}  // namespace ground_truth

#endif

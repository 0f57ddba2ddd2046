// JSON inside of HTML.
#ifndef STRIDE_MASTER_REPORT_JSON_TEXT_H
#define STRIDE_MASTER_REPORT_JSON_TEXT_H

#include <string>

#include <nlohmann/json.hpp>

namespace stride::report {

using Json = nlohmann::ordered_json;

/// Without blanks. What is no UTF-8 becomes U+FFFD, and `<` an escape sequence, so that no text of
/// it ends the element that it stands in.
std::string json_text(const Json& json);

}  // namespace stride::report

#endif

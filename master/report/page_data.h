// Texts and arrays in the form that the report's page reads.
#ifndef STRIDE_MASTER_REPORT_PAGE_DATA_H
#define STRIDE_MASTER_REPORT_PAGE_DATA_H

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include <stride/time.h>

#include "master/report/column.h"

namespace stride::report {

using Json = nlohmann::ordered_json;

/// Without blanks. What is no UTF-8 becomes U+FFFD, and `<` an escape sequence, so that no text of
/// it ends the element that contains it.
std::string json_text(const Json& json);

/// With texts in place of the integers that a double, which is JavaScript's number, does not have.
Json with_exact_integers(Json json);

/// Base64 (RFC 4648) with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// The JSON object {"type":…,"count":…,"data":…} of an array: little-endian elements, their bytes
/// transposed (the first bytes of all elements, then the second ones, …), which makes them easier
/// to compress, then deflated (RFC 1951) and in base64.
std::string blob(std::span<const double> values);
std::string blob(std::span<const std::int64_t> values);
std::string blob(std::span<const Time> times);
std::string blob(std::span<const std::int32_t> values);
std::string blob(std::span<const std::uint8_t> values);
/// Likewise for texts: {"type":"strings","count":…,"values":[…],"indices":…}.
std::string blob(const Texts& texts);
std::string blob(const Column::Values& values);

/// Likewise for texts of which few are equal, but many alike: {"type":"texts","count":…,
/// "bytes":…}, the array of their bytes (UTF-8), a 0 behind each.
std::string text_blob(std::span<const std::string> texts);

}  // namespace stride::report

#endif

// What several tests of master/report share: the other side of what is written.
#ifndef STRIDE_TESTS_MASTER_REPORT_SUPPORT_H
#define STRIDE_TESTS_MASTER_REPORT_SUPPORT_H

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "tests/master/system/ssp/support.h"

namespace stride::report {

using tests::content;
using tests::error_of;
using tests::TemporaryFolder;

inline std::vector<std::uint8_t> from_base64(const std::string& text) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  if (text.size() % 4 != 0) throw std::runtime_error("base64 is not padded");
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, std::min(text.find('='), text.size()))) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("no digit of base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

inline std::vector<std::uint8_t> inflated(std::vector<std::uint8_t> bytes, std::size_t size) {
  std::vector<std::uint8_t> output(size + 1);
  z_stream stream{};
  if (inflateInit2(&stream, -15) != Z_OK) throw std::runtime_error("zlib");
  stream.next_in = bytes.data();
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = output.data();
  stream.avail_out = static_cast<uInt>(output.size());
  const int status = inflate(&stream, Z_FINISH);
  const std::size_t found = output.size() - stream.avail_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END || found != size)
    throw std::runtime_error("not deflated as it should");
  output.resize(size);
  return output;
}

/// The elements of a blob that is not of texts; their type must be that of `Element`.
template <class Element>
std::vector<Element> unpacked(const nlohmann::json& blob) {
  const char* const type = std::is_same_v<Element, double>         ? "float64"
                           : std::is_same_v<Element, stride::Time> ? "int128"
                           : std::is_same_v<Element, std::int64_t> ? "int64"
                           : std::is_same_v<Element, std::int32_t> ? "int32"
                                                                   : "uint8";
  if (blob.at("type") != type) throw std::runtime_error("the blob is of another type");
  const std::size_t count = blob.at("count");
  const auto bytes = inflated(from_base64(blob.at("data")), count * sizeof(Element));
  std::vector<Element> elements(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<std::uint8_t, sizeof(Element)> element;
    for (std::size_t k = 0; k < element.size(); ++k) element[k] = bytes[k * count + i];
    std::memcpy(&elements[i], element.data(), sizeof(Element));
  }
  return elements;
}

inline std::vector<std::string> unpacked_texts(const nlohmann::json& blob) {
  if (blob.at("type") != "strings") throw std::runtime_error("the blob is of another type");
  std::vector<std::string> texts;
  for (const std::int32_t index : unpacked<std::int32_t>(blob.at("indices"))) {
    texts.push_back(blob.at("values").at(static_cast<std::size_t>(index)));
  }
  if (blob.at("count") != texts.size()) throw std::runtime_error("the count is wrong");
  return texts;
}

/// The data in a page.
inline nlohmann::json data_of(const std::string& page) {
  const std::string begin = R"(<script type="application/json" id="stride-report">)";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) throw std::runtime_error("the page has no data");
  const std::size_t first = at + begin.size();
  return nlohmann::json::parse(page.substr(first, page.find("</script>", first) - first));
}

}  // namespace stride::report

#endif

#include "master/report/page_data.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

namespace stride::report {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are stored");

using Bytes = std::vector<std::uint8_t>;

template <class Element>
Bytes transposed(std::span<const Element> values) {
  const auto* const from = reinterpret_cast<const std::uint8_t*>(values.data());
  Bytes bytes(values.size_bytes());
  for (std::size_t k = 0; k < sizeof(Element); ++k) {
    std::uint8_t* const to = bytes.data() + k * values.size();
    for (std::size_t i = 0; i < values.size(); ++i) to[i] = from[i * sizeof(Element) + k];
  }
  return bytes;
}

/// Deflated in pieces, since zlib counts in 32 bits. Level 1: the others take several times as long
/// for a few percent.
Bytes deflated(const Bytes& bytes) {
  constexpr int kRaw = -15;
  constexpr int kMemory = 8;
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();  // its only reason here
  }
  Bytes output;
  std::size_t done = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    if (stream.avail_in == 0) {
      const std::size_t count = std::min(kPiece, bytes.size() - done);
      stream.next_in = const_cast<Bytef*>(bytes.data() + done);
      stream.avail_in = static_cast<uInt>(count);
      done += count;
    }
    const std::size_t before = output.size();
    output.resize(before + kPiece / 4);
    stream.next_out = output.data() + before;
    stream.avail_out = static_cast<uInt>(kPiece / 4);
    status = deflate(&stream, done == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    output.resize(output.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot deflate");
  return output;
}

template <class Element>
std::string numbers(const char* type, std::span<const Element> values) {
  return fmt::format(R"({{"type":"{}","count":{},"data":"{}"}})", type, values.size(),
                     base64(deflated(transposed(values))));
}

}  // namespace

std::string json_text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

Json with_exact_integers(Json json) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if (json.is_structured()) {
    for (Json& part : json) part = with_exact_integers(std::move(part));
  } else if (json.is_number_unsigned()) {
    const auto number = json.get<std::uint64_t>();
    if (number > std::uint64_t{kMost}) return std::to_string(number);
  } else if (json.is_number_integer()) {
    const auto number = json.get<std::int64_t>();
    if (number < -kMost || number > kMost) return std::to_string(number);
  }
  return json;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string blob(std::span<const double> values) { return numbers("float64", values); }
std::string blob(std::span<const std::int64_t> values) { return numbers("int64", values); }
std::string blob(std::span<const Time> times) {
  const auto count = [](Time time) { return time.time_since_epoch().count(); };
  if (!std::ranges::all_of(times, [&](Time time) { return detail::is_narrow(count(time)); })) {
    return numbers("int128", times);
  }
  std::vector<std::int64_t> narrow(times.size());
  std::ranges::transform(times, narrow.begin(),
                         [&](Time time) { return static_cast<std::int64_t>(count(time)); });
  return blob(std::span<const std::int64_t>(narrow));
}
std::string blob(std::span<const std::int32_t> values) { return numbers("int32", values); }
std::string blob(std::span<const std::uint8_t> values) { return numbers("uint8", values); }

std::string blob(const Texts& texts) {
  return fmt::format(R"({{"type":"strings","count":{},"values":{},"indices":{}}})",
                     texts.indices().size(), json_text(texts.distinct()),
                     blob(std::span(texts.indices())));
}

std::string text_blob(std::span<const std::string> texts) {
  std::vector<std::uint8_t> bytes;
  for (const std::string& text : texts) {
    for (const char c : text) bytes.push_back(c == '\0' ? ' ' : static_cast<std::uint8_t>(c));
    bytes.push_back(0);
  }
  return fmt::format(R"({{"type":"texts","count":{},"bytes":{}}})", texts.size(),
                     blob(std::span<const std::uint8_t>(bytes)));
}

std::string blob(const Column::Values& values) {
  return std::visit(
      [](const auto& held) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, Texts>) {
          return blob(held);
        } else {
          return blob(std::span(held));
        }
      },
      values);
}

}  // namespace stride::report

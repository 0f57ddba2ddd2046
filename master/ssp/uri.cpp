#include "master/ssp/uri.h"

#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "master/util/hex.h"

namespace stride::ssp {
namespace {

std::string take_scheme(std::string_view& uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  if (end == std::string_view::npos || end == 0 || uri[end] != ':') return {};
  std::string scheme;
  for (const char c : uri.substr(0, end)) {
    scheme += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  uri.remove_prefix(end + 1);
  return scheme;
}

std::string percent_decoded(std::string_view text, const xml::Element& element) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const auto byte = core::hex_byte(text.substr(i + 1));
    if (!byte || *byte == 0) {
      element.fail(fmt::format("source=\"{}\" has a '%' that is not followed by two hexadecimal "
                               "digits",
                               text),
                   "write %25 for a percent sign");
    }
    decoded += static_cast<char>(*byte);
    i += 2;
  }
  return decoded;
}

}  // namespace

Source source_of(const xml::Element& element, const std::filesystem::path& folder) {
  const std::string source = element.required("source");
  std::string_view rest = source;
  const std::string scheme = take_scheme(rest);
  if (!scheme.empty() && scheme != "file") {
    element.fail(fmt::format("source=\"{}\": only files can be read, not '{}:'", source, scheme),
                 "download it, and name the file relative to this one");
  }
  if (rest.substr(0, 2) == "//") {
    const std::size_t path = rest.find('/', 2);
    const std::string_view host = rest.substr(2, path - 2);
    if (path == std::string_view::npos || (!host.empty() && host != "localhost")) {
      element.fail(fmt::format("source=\"{}\" names a file on another machine", source),
                   "write file:///path for a file on this one");
    }
    rest.remove_prefix(path);
  }
  const std::size_t hash = rest.find('#');
  const std::string_view fragment = hash == rest.npos ? "" : rest.substr(hash + 1);
  rest = rest.substr(0, hash);
  if (rest.find('?') != std::string_view::npos) {
    element.fail(fmt::format("source=\"{}\" has a query", source),
                 "write %3F if the file's name has a '?'");
  }
  return {(folder / percent_decoded(rest, element)).lexically_normal(),
          percent_decoded(fragment, element)};
}

std::filesystem::path source_path(const xml::Element& element,
                                  const std::filesystem::path& folder) {
  Source source = source_of(element, folder);
  if (!source.fragment.empty()) {
    element.fail_unsupported(fmt::format("a source with a fragment, which names a part of a file: "
                                         "\"{}\"",
                                         element.required("source")),
                             "write %23 if the file's name has a '#'");
  }
  return source.path;
}

std::string uri_of(const std::filesystem::path& path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : path.generic_string()) {
    const bool is_plain = kPlain.find(c) != kPlain.npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

}  // namespace stride::ssp

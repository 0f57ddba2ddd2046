#include "master/base/files/file_uri.h"

#include <string_view>

#include <fmt/format.h>

namespace stride::core {

std::string uri_path(const std::filesystem::path& path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : path.generic_string()) {
    const bool is_plain = kPlain.find(c) != kPlain.npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

std::string file_uri(const std::filesystem::path& path) {
  return "file://" + uri_path(std::filesystem::absolute(path).lexically_normal());
}

}  // namespace stride::core

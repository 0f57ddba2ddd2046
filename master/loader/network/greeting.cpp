#include "master/loader/network/greeting.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace stride::remote {
namespace {

std::string mark_of(Side side) {
  return side == Side::Server ? "\x01STRIDE-SERVE protocol " : "\x01STRIDE-RUN protocol ";
}

bool is_of_build(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '.' ||
         c == '-' || c == '+' || c == '~';
}

/// "1, build 1.2.0"
std::optional<Greeting> parse_greeting(std::string_view text) {
  constexpr std::string_view kBuild = ", build ";
  Greeting greeting;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, greeting.protocol);
  if (error != std::errc()) return std::nullopt;
  std::string_view build(rest, static_cast<std::size_t>(end - rest));
  if (!build.starts_with(kBuild)) return std::nullopt;
  build.remove_prefix(kBuild.size());
  if (build.empty() || !std::ranges::all_of(build, is_of_build)) return std::nullopt;
  greeting.build = build;
  return greeting;
}

}  // namespace

Greeting own_greeting() { return {kProtocol, STRIDE_VERSION}; }

std::string greeting_line(Side side, const Greeting& greeting) {
  return fmt::format("{}{}, build {}\n", mark_of(side), greeting.protocol, greeting.build);
}

GreetingScanner::GreetingScanner(Side peer) : mark_(mark_of(peer)) {}

std::optional<Greeting> GreetingScanner::take(std::string_view bytes) {
  const std::size_t searched = begin_ - std::min(begin_, mark_.size() - 1);
  bytes_ += bytes;
  begin_ = std::min(bytes_.find(mark_, searched), bytes_.size());
  if (begin_ == bytes_.size()) {
    if (begin_ > kMostNoise) throw BadGreeting("it prints, and does not greet");
    return std::nullopt;
  }
  const std::size_t first = begin_ + mark_.size();
  const std::size_t end = bytes_.find('\n', first);
  if (std::min(end, bytes_.size()) - begin_ > kLongest) throw BadGreeting("its greeting is none");
  if (end == std::string::npos) return std::nullopt;
  end_ = end + 1;
  if (auto greeting = parse_greeting(std::string_view(bytes_).substr(first, end - first))) {
    return greeting;
  }
  throw BadGreeting("its greeting is none");
}

}  // namespace stride::remote

#include "master/base/error.h"

#include <cerrno>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/message_text.h"
#include "master/base/time_text.h"

namespace stride::core {
Error::Error(Kind kind, Context context, const std::string& message, const std::string& hint)
    : std::runtime_error(
          message_text(to_text(context) + message + (hint.empty() ? "" : "\n  hint: " + hint))),
      kind_(kind),
      context_(std::move(context)),
      message_(message),
      hint_(hint) {}

void fail_input(Context context, const std::string& message, const std::string& hint) {
  throw Error(Error::Kind::Input, std::move(context), message, hint);
}

void fail_run(Context context, const std::string& message, const std::string& hint) {
  throw Error(Error::Kind::Run, std::move(context), message, hint);
}

void fail_output(const std::error_code& reason, Context context, const std::string& message,
                 const std::string& hint) {
  const std::string text = message + ": " + reason.message();
  if (!is_shortage(reason.value())) fail_input(std::move(context), text, hint);
  throw EnvironmentError(std::move(context), text, "make room on the disk");
}

bool is_shortage(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EMFILE:
    case ENFILE:
    case ENOMEM:
      return true;
    default:
      return false;
  }
}

bool is_of_environment(const std::exception& error) {
  if (dynamic_cast<const EnvironmentError*>(&error) != nullptr) return true;
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  const auto* const system = dynamic_cast<const std::system_error*>(&error);
  if (system == nullptr) return false;
  const std::error_condition what = system->code().default_error_condition();
  if (what.category() != std::generic_category()) return false;
  return what == std::errc::resource_unavailable_try_again || is_shortage(what.value());
}

std::string to_text(const Context& context) {
  std::string head;
  if (!context.where.file.empty()) {
    head += name_text(context.where.file);
    if (context.where.line > 0) head += fmt::format(":{}", context.where.line);
    head += ": ";
  }
  std::string subject;
  const auto add = [&](const std::string& part) {
    subject += (subject.empty() ? "" : ", ") + part;
  };
  if (!context.unit.empty()) add(fmt::format("unit '{}'", name_text(context.unit)));
  if (!context.variable.empty()) add(fmt::format("variable '{}'", name_text(context.variable)));
  if (context.time) add(fmt::format("at {} s", to_text(*context.time)));
  if (!subject.empty()) subject += ": ";
  return head + subject;
}

std::string quoted(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names) {
    if (!text.empty()) text += ", ";
    text += "'" + name_text(name) + "'";
  }
  return text;
}

std::string abridged(std::span<const std::string> names, std::size_t most) {
  if (names.size() <= most + 1) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.first(most), ", "), names.size() - most);
}

}  // namespace stride::core

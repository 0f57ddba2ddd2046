// Values that are in memory of the unit: texts and binary values.
#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/readable_text.h"
#include "master/base/time_text.h"
#include "master/loader/fmu/instance/fmu_instance.h"

namespace stride::importer {
namespace {

/// Of a value, or a serialised state [byte]: what is longer has an address or a size that was never
/// set.
constexpr std::size_t kLongestValue = std::size_t{256} << 20;
constexpr std::size_t kLongestState = std::size_t{16} << 30;

/// Characters of a text in a warning.
constexpr std::size_t kMostShown = 60;

constexpr const char* kLengthHint =
    "the unit has to give the length that the value has in this instant, and has to end each text "
    "with a zero";

}  // namespace

/// Calls copy(i, variable) for each value, where `variable` is its reference.
template <class Copy>
void FmuInstance::copy_each(const char* function, References references, std::size_t count,
                            Copy&& copy) {
  struct End {
    ~End() { present.end_reading(); }
    PresentCall& present;
  };
  write_note(function);
  const End end{present_};
  std::size_t i = 0;
  const auto size_of = [&](core::ValueReference reference) {
    if (references.size() == count) return std::size_t{1};
    const auto place = parts_.description->find(reference);
    return place ? parts_.description->variables[*place].size : count - i;
  };
  for (const core::ValueReference& reference : references) {
    present_.read_value_of(&reference);
    for (const std::size_t last = std::min(i + size_of(reference), count); i < last; ++i) {
      try {
        copy(i, reference);
      } catch (const std::bad_alloc&) {
        fail_value(reference,
                   fmt::format("there is not enough memory for the value that {} gave", function));
      }
    }
  }
}

void FmuInstance::copy_texts(const char* function, References references,
                             std::span<const char* const> given, std::span<std::string> values) {
  copy_each(function, references, values.size(), [&](std::size_t i, core::ValueReference variable) {
    const char* const text = given[i];
    const std::size_t size = text == nullptr ? 0 : ::strnlen(text, kLongestValue + 1);
    if (size > kLongestValue) {
      fail_value(variable,
                 fmt::format("{} gave a text of more than {} MiB, or one without its end", function,
                             kLongestValue >> 20),
                 kLengthHint);
    }
    values[i].assign(text == nullptr ? "" : text, size);
    if (!core::is_utf8(values[i])) [[unlikely]]
      warn_of_encoding(variable, values[i]);
    if (text != nullptr || std::exchange(has_text_warning_, true)) return;
    warn(
        fmt::format("{} gave no text (NULL) for '{}', which FMI forbids; it is taken as an empty "
                    "one, here and later",
                    function, variable_name(variable)));
  });
}

void FmuInstance::warn_of_encoding(core::ValueReference variable, std::string_view text) {
  if (!has_encoding_warning_.insert(variable).second) return;
  const auto now = time();
  warn(fmt::format(
      "{}the text of '{}' is not UTF-8, which FMI demands: \"{}\"; other units get its bytes, and "
      "files U+FFFD for each that is not of a character, here and later",
      now ? fmt::format("at {} s ", core::to_text(*now)) : "", variable_name(variable),
      core::readable_text(text, kMostShown)));
}

void FmuInstance::copy_binaries(const char* function, References references,
                                std::span<const std::uint8_t* const> given,
                                std::span<const std::size_t> sizes,
                                std::span<core::Binary> values) {
  copy_each(function, references, values.size(), [&](std::size_t i, core::ValueReference variable) {
    const std::size_t size = sizes[i];
    if (size > kLongestValue) {
      fail_value(variable,
                 fmt::format("{} gave {} bytes; {} MiB at most are possible", function, size,
                             kLongestValue >> 20),
                 kLengthHint);
    }
    if (size != 0 && given[i] == nullptr) {
      fail_value(variable, fmt::format("{} gave {} bytes at the address NULL", function, size));
    }
    values[i].assign(given[i], given[i] + size);
  });
}

std::vector<std::uint8_t> FmuInstance::bytes_for_state(const char* function,
                                                       std::size_t size) const {
  try {
    if (size <= kLongestState) return std::vector<std::uint8_t>(size);
  } catch (const std::bad_alloc&) {  // likewise
  }
  fail(fmt::format("{} gave {} bytes as the size of a state, for which there is not enough memory",
                   function, size));
}

std::string FmuInstance::variable_name(core::ValueReference reference) const {
  const auto place = parts_.description->find(reference);
  return place ? parts_.description->variables[*place].name : fmt::format("#{}", reference);
}

void FmuInstance::fail_value(core::ValueReference variable, const std::string& message,
                             const std::string& hint) const {
  core::fail_run({options_.where, name_, variable_name(variable), time()}, message, hint);
}

}  // namespace stride::importer

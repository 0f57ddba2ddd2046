#include "master/observe/trace/writer.h"

#include <charconv>
#include <system_error>

#include "master/base/error.h"

namespace stride::trace {
namespace {

const std::filesystem::path& other_than(const std::filesystem::path& from,
                                        const std::filesystem::path& to) {
  std::error_code error;
  if (std::filesystem::equivalent(from, to, error)) {
    core::fail_input({.where = {to.string(), 0}}, "this is the file that is read",
                     "choose another file to write to");
  }
  return to;
}

}  // namespace

Writer::Writer(const std::filesystem::path& from, const std::filesystem::path& to)
    : output_(other_than(from, to)) {}

void Writer::write_stamp(std::int64_t stamp) {
  if (stamp_ == stamp) return;
  stamp_ = stamp;
  core::OutputFile& file = output_.file();
  file.write('#');
  file.write_number(stamp);
  file.write('\n');
}

void Writer::write_advance_time(std::int64_t total, std::string_view code) {
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, total, 2).ptr;
  core::OutputFile& file = output_.file();
  file.write('b');
  file.write(std::string_view(digits, static_cast<std::size_t>(end - digits)));
  file.write(' ');
  file.write(code);
  file.write('\n');
}

}  // namespace stride::trace

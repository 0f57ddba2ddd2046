#include "master/observe/capture/unended_stimuli.h"

#include <optional>
#include <string>
#include <utility>

#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::capture {
namespace {

/// The rows of a CSV file, one by one; one without its end is none.
class Rows {
 public:
  explicit Rows(std::string_view text) : text_(text) {}

  bool next() {
    begin_ = end_;
    bool is_quoted = false;
    for (std::size_t i = begin_; i < text_.size(); ++i) {
      if (text_[i] == '"') is_quoted = !is_quoted;
      if (text_[i] != '\n' || is_quoted) continue;
      end_ = i + 1;
      return true;
    }
    return false;
  }
  std::size_t begin() const { return begin_; }
  /// Of the present row, which is behind the head.
  std::string_view time() const { return row().substr(0, row().find(',')); }
  /// What is behind the time.
  std::string_view rest() const { return row().substr(row().find(',') + 1); }

 private:
  std::string_view row() const { return text_.substr(begin_, end_ - begin_); }

  std::string_view text_;
  std::size_t begin_ = 0, end_ = 0;
};

/// Where a step begins in the text, and when.
struct Step {
  std::size_t at;
  std::string_view time;
};

}  // namespace

bool end_stimuli(const std::filesystem::path& file, std::string_view ending) {
  const std::string text = core::read_input(file);
  std::optional<Step> first, last;
  for (Rows rows(text); rows.next();) {
    if (rows.rest().starts_with("end,,")) return true;
    if (!rows.rest().starts_with("step,,")) continue;
    last = {rows.begin(), rows.time()};
    if (!first) first = last;
  }
  if (!last || last->at == first->at) return false;
  core::Replacement replacement(file);
  replacement.file().write(std::string_view(text).substr(0, last->at));
  replacement.file().write(last->time);
  replacement.file().write(",end,,");
  recorders::quote_csv(ending, [&](char c) { replacement.file().write(c); });
  replacement.file().write('\n');
  replacement.commit();
  return true;
}

}  // namespace stride::capture

// A page with its data, in a file.
#ifndef STRIDE_MASTER_REPORT_PAGE_FILE_H
#define STRIDE_MASTER_REPORT_PAGE_FILE_H

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "master/report/signals_file.h"

namespace stride::report {

/// Takes the text of a page, piece by piece.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void write(std::string_view text) = 0;
  void write(char c) { write(std::string_view(&c, 1)); }
};

using WriteMembers = std::function<void(Sink&)>;

/// Writes the page with its data: a JSON object of the format, the version of stride, and what
/// `write_members` writes, a comma before each member; before it `elements` of HTML. The file has
/// its new content at once or not at all. Throws core::Error, of Kind::Input where this stride was
/// built without pages.
void write_page(const std::filesystem::path& file, std::string_view page,
                const std::string& version, const WriteMembers& write_members,
                std::string_view elements = "");

/// The same in memory, without a file.
std::string page_text(std::string_view page, const std::string& version,
                      const WriteMembers& write_members, std::string_view elements = "");

/// Writes a member of JSON text.
void write_member(Sink& sink, std::string_view name, std::string_view text);

/// Writes the members "time", "rows" and "columns".
void write_signals(Sink& sink, const Signals& signals);

}  // namespace stride::report

#endif

// A page with its data, in a file.
#ifndef STRIDE_MASTER_REPORT_PAGE_FILE_H
#define STRIDE_MASTER_REPORT_PAGE_FILE_H

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "master/report/signals_file.h"
#include "master/util/output_file.h"

namespace stride::report {

/// Writes the page with its data: a JSON object of the format, the version of stride, and what
/// `write_members` writes, a comma before each member; before it `elements` of HTML. The file has
/// its new content at once or not at all. Throws core::Error, of Kind::Input where this stride was
/// built without pages.
void write_page(const std::filesystem::path& file, std::string_view page,
                const std::string& version,
                const std::function<void(core::OutputFile&)>& write_members,
                std::string_view elements = {});

/// Writes a member of JSON text.
void write_member(core::OutputFile& file, std::string_view name, std::string_view text);

/// Writes the members "time", "rows" and "columns".
void write_signals(core::OutputFile& file, const Signals& signals);

}  // namespace stride::report

#endif

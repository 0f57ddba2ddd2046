// How the recorders write names and fields.
#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_SIGNAL_TEXT_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_SIGNAL_TEXT_H

#include <string>
#include <string_view>

#include "master/base/files/output_file.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"

namespace stride::recorders {

/// That of the column which the element has in signals.csv, without its unit: "component.name[1]".
std::string column_name(const core::System& system, core::VariableId id, std::size_t element);

/// Calls write(char) for each character of the text as a field of a CSV file (RFC 4180) in
/// quotation marks; quotation marks of the text are doubled.
template <class Write>
void quote_csv(std::string_view text, Write&& write) {
  write('"');
  for (const char c : text) {
    if (c == '"') write('"');
    write(c);
  }
  write('"');
}

/// A field of a CSV file, in UTF-8 whatever the text is: in quotation marks where it demands them.
std::string csv_field(std::string_view text);

/// One element as a field of a CSV file: numbers in their shortest form, true or false, text in
/// quotation marks and in UTF-8, bytes as hexadecimal digits.
void write_csv(core::OutputFile& file, const core::ValueBlock& block, std::size_t element);

}  // namespace stride::recorders

#endif

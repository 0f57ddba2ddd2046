#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_COVERAGE_WRITER_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_COVERAGE_WRITER_H

#include <string>

#include "master/base/xml/writer.h"
#include "master/system/declaration/coverage_declaration.h"

namespace stride::scenario {

/// Writes the <stride:Group> of a component with this name, which read_coverage() reads as the same
/// group. The prefix `stride` is declared.
void write_group(xml::Writer& writer, const GroupDeclaration& group, const std::string& component);

}  // namespace stride::scenario

#endif

// The declarations of a value change dump.
#ifndef STRIDE_MASTER_RECORDERS_VCD_SCOPE_H
#define STRIDE_MASTER_RECORDERS_VCD_SCOPE_H

#include <string>
#include <string_view>
#include <vector>

#include "master/model/description.h"
#include "master/util/output_file.h"

namespace stride::io {

/// A tree of scopes, in the order in which their variables were added.
class VcdScope {
 public:
  explicit VcdScope(std::string name = "") : name_(std::move(name)) {}

  /// The scope of this name in this one, made where there is none.
  VcdScope& scope(std::string_view name);
  /// Declares a variable; the parts of its name before the last dot are scopes.
  void add(std::string_view structured_name, core::ValueType type, std::string_view code);
  /// The declarations within this scope, without its own frame.
  void write(OutputFile& file) const;

 private:
  std::string name_;
  std::vector<VcdScope> scopes_;
  std::vector<std::string> variables_;
};

}  // namespace stride::io

#endif

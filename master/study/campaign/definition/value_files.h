// Values of cases that are in files of their own.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_VALUE_FILES_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_VALUE_FILES_H

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/parameter_list.h"

namespace stride::campaign {

/// The value sets of files, in the order in which they are added.
class ValueFiles {
 public:
  explicit ValueFiles(ParameterList& parameters) : parameters_(parameters) {}

  /// A .csv (RFC 4180) whose first row has the names of parameters, and each further one a set; an
  /// empty field without quotation marks has no value. Or a .ssv (SSP), which is one set. Warnings
  /// about the file are added to `warnings`. Throws core::Error (Input); `where` is the place that
  /// names the file.
  void add(const std::filesystem::path& file, const core::Location& where,
           std::vector<std::string>& warnings);

  /// All sets, as one table.
  ValueTable table() &&;

 private:
  std::size_t column(const std::string& name, const core::Location& where);
  void add_csv(const std::filesystem::path& file);
  void add_ssv(const std::filesystem::path& file, std::vector<std::string>& warnings);

  ParameterList& parameters_;
  std::map<std::string, std::size_t> columns_;
  ValueTable table_;
};

}  // namespace stride::campaign

#endif

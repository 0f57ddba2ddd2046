#include "master/base/files/table_file.h"

#include "master/base/text/lower_case.h"

namespace stride::core {

bool is_table_name(const std::filesystem::path& file) {
  return lower_case(file.extension().string()) == ".csv" || is_foreign_table_name(file);
}

bool is_foreign_table_name(const std::filesystem::path& file) {
  const std::string end = lower_case(file.extension().string());
  return end == ".parquet" || end == ".mcap";
}

}  // namespace stride::core

// Tables of values over time, by the names of their files.
#ifndef STRIDE_MASTER_BASE_FILES_TABLE_FILE_H
#define STRIDE_MASTER_BASE_FILES_TABLE_FILE_H

#include <filesystem>

namespace stride::core {

/// Whether it ends in .csv, .parquet or .mcap, in any case.
bool is_table_name(const std::filesystem::path& file);
/// Whether it ends in .parquet or .mcap, which become CSV before they are read.
bool is_foreign_table_name(const std::filesystem::path& file);

}  // namespace stride::core

#endif

// Tables in other formats than CSV.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FOREIGN_TABLE_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FOREIGN_TABLE_H

#include <filesystem>

namespace stride::scenario {

/// Writes what is in a Parquet or MCAP file as a table of CSV, into a folder that is there. It is
/// read by Python, which the environment variable STRIDE_PYTHON names, else `python3`, in a process
/// in the sandbox. Throws core::Error (Input) that calls the table `shown_as`, also where a package
/// of Python is missing.
void write_as_csv(const std::filesystem::path& table, const std::filesystem::path& csv,
                  const std::filesystem::path& shown_as);

}  // namespace stride::scenario

#endif

#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_TABLE_SCRIPT_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_TABLE_SCRIPT_H

namespace stride::scenario {

/// The text of table_to_csv.py.
extern const char* const kTableScript;

}  // namespace stride::scenario

#endif

#include "master/system/scenario/units/fmu_archives.h"

#include <fmt/format.h>

#include "master/base/archive/zip.h"
#include "master/base/files/input_file.h"
#include "master/base/files/table_file.h"
#include "master/loader/fmu/pack.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::scenario {

std::filesystem::path FmuArchives::operator()(const std::filesystem::path& source,
                                              const core::Location& where) {
  const std::filesystem::path unit = find_unit(source, where);
  const bool is_library = unit.extension() == ".so";
  const bool is_table = core::is_foreign_table_name(unit) && !core::is_folder(unit);
  if (!is_library && !is_table && !core::is_folder(unit)) return unit;
  const std::filesystem::path made = folder_.path() / fmt::format("{}.fmu", ++count_);
  if (is_library) {
    importer::pack({unit, {}, {}, made});
  } else if (is_table) {  // which needs Python, and perhaps not everywhere has it
    pack_stimuli({unit, {}, {}, made});
  } else {
    archive::Contents contents;
    archive::add_folder(contents, "", unit);
    archive::write_zip(made, contents);
  }
  return made;
}

}  // namespace stride::scenario

// The description of an FMU that is on another machine.
#ifndef STRIDE_MASTER_LOADER_NETWORK_DESCRIPTION_FILES_H
#define STRIDE_MASTER_LOADER_NETWORK_DESCRIPTION_FILES_H

#include <memory>
#include <span>
#include <string>

#include "master/loader/fmu/description/description_file.h"
#include "master/loader/fmu/fmu.h"

namespace stride::remote {

/// Of names and texts: whether two descriptions are the same.
std::string description_digest(std::span<const importer::DescriptionFile> files);

/// An FMU of these files alone, which has no library. Names that no description has are left out.
/// Throws core::Error (Input) as Fmu::load() does; messages have the path `shown_as`.
std::shared_ptr<importer::Fmu> make_described_fmu(std::span<const importer::DescriptionFile> files,
                                                  const core::Location& where,
                                                  const std::string& shown_as);

}  // namespace stride::remote

#endif

// Makes a package (.ssp) of a scenario and all that it names.
#ifndef STRIDE_MASTER_SYSTEM_SSP_PACKAGE_H
#define STRIDE_MASTER_SYSTEM_SSP_PACKAGE_H

#include <filesystem>
#include <functional>
#include <span>

#include "master/base/archive/zip.h"
#include "master/base/error.h"
#include "master/system/ssp/files.h"

namespace stride::ssp {

/// Finds the .fmu archive to pack for the FMU that a source names; throws core::Error (Input) if
/// there is none.
using FmuMaker =
    std::function<std::filesystem::path(const std::filesystem::path&, const core::Location&)>;

/// The contents of a package with this .ssd as its SystemStructure.ssd, which must be one that
/// read_scenario() reads. The files that it names, and those that they name, are in resources/,
/// each once, under their own names as far as they differ; the sources are adapted, and nothing
/// else changes in the .ssd. So are `variants`, further systems, packed: each is at the top of the
/// package under the name of its file. Throws core::Error (Input).
archive::Contents package_contents(const std::filesystem::path& system, Files& files,
                                   const FmuMaker& make_fmu,
                                   std::span<const std::filesystem::path> variants = {});

}  // namespace stride::ssp

#endif

// The files that a scenario consists of, some of them packed in archives.
#ifndef STRIDE_MASTER_SYSTEM_SSP_FILES_H
#define STRIDE_MASTER_SYSTEM_SSP_FILES_H

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/error.h"
#include "master/base/xml/document.h"

namespace stride::ssp {

/// Finds the FMU that a scenario names by this path; throws core::Error (Input) if it is
/// nowhere.
using UnitFinder =
    std::function<std::filesystem::path(const std::filesystem::path&, const core::Location&)>;

/// Archives are unpacked once, into folders that go with this object.
class Files {
 public:
  explicit Files(UnitFinder find_unit = {});

  /// The .ssd that a path of the command line or a source names: itself, the SystemStructure.ssd of
  /// a package (.ssp) or of the folder that one unpacks to, or what is named in one,
  /// "FILE.ssp/Variant.ssd". One in another case, in the only folder that has one, or of another
  /// name, if it is the only .ssd, is taken with a warning. Throws core::Error (Input).
  std::filesystem::path system_file(const std::filesystem::path& path,
                                    const core::Location& where = {});
  /// The .ssd of a scenario, which a path of the command line names: likewise. An FMU (.fmu, the
  /// folder that one unpacks to, or a library, .so) is one itself, and so is a table (.csv,
  /// .parquet, .mcap): document() gives a system of it alone, with a component of its name.
  std::filesystem::path scenario_file(const std::filesystem::path& path);
  /// Whether scenario_file() has given this one for a unit.
  bool is_alone(const std::filesystem::path& file) const { return units_.contains(file); }
  /// The .ssd files at the top of a package, or of the folder that one unpacks to, in the order of
  /// their names; none for what is no package. The file is one that scenario_file() has found for
  /// this path.
  std::vector<std::filesystem::path> variants(const std::filesystem::path& path,
                                              const std::filesystem::path& file) const;
  /// Likewise, this .ssd in a package.
  std::filesystem::path system_file(const std::filesystem::path& package, const std::string& name,
                                    const core::Location& where);
  /// The folder that an FMU, which a component names as its source, is unpacked to.
  std::filesystem::path unit_folder(const std::filesystem::path& source,
                                    const core::Location& where);
  /// The archive that a file was unpacked from, and the folder that it was unpacked to.
  struct Archive {
    std::filesystem::path path;
    std::filesystem::path folder;
  };
  std::optional<Archive> archive_of(const std::filesystem::path& file) const;
  /// Reads an XML file that is called shown() in complaints. Throws core::Error (Input).
  xml::Document document(const std::filesystem::path& file);
  /// Reads one before that: document() returns it without reading it again, once. Throws likewise.
  const xml::Document& read_ahead(const std::filesystem::path& file);
  /// Whether it has been read so, whatever has become of the file.
  bool is_ahead(const std::filesystem::path& file) const { return ahead_.contains(file); }
  /// The files that document() has read or tried to read.
  const std::set<std::filesystem::path>& documents() const { return documents_; }
  /// A path as its reader knows it: within an archive, "FILE.ssp/resources/a.ssv".
  std::string shown(const std::filesystem::path& path) const;

  /// Of what is odd in the files that document() has read and in packages, but no mistake.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  const std::filesystem::path& unpack(const std::filesystem::path& archive,
                                      const std::string& expected, const core::Location& where);
  xml::Document read(const std::filesystem::path& file);
  bool is_unit(const std::filesystem::path& path);
  void warn_once(const std::string& warning);

  UnitFinder find_unit_;
  std::map<std::filesystem::path, std::unique_ptr<archive::UnpackedArchive>> archives_;
  std::vector<std::string> warnings_;
  std::set<std::filesystem::path> documents_;
  std::set<std::filesystem::path> units_;  ///< that are scenarios
  std::map<std::filesystem::path, xml::Document> ahead_;
};

}  // namespace stride::ssp

#endif

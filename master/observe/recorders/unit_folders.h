// Where units put files of their own: a folder for each component, among the results of a run.
#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_UNIT_FOLDERS_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_UNIT_FOLDERS_H

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stride::recorders {

/// The folder in the results folder that contains those of the components. A unit may be able to
/// write to its own folder and to nothing else, so what is outside of that can be trusted.
inline constexpr const char* kUnitsFolder = "units";

/// Where a unit puts its world in 3D, in its own folder: a binary glTF 2.0 file.
inline constexpr const char* kWorldFile = "world.glb";

/// Where a unit puts its film, in its own folder, and the list of the pictures there.
inline constexpr const char* kFilmFolder = "film";
inline constexpr const char* kFilmList = "frames.csv";

/// Where it puts a scene, and what it may need to go on with it.
inline constexpr std::array<const char*, 4> kSceneFiles{"world.glb", "world.glb.part", "world.keys",
                                                        "world.keys.old"};

/// The name of a component's folder. Different components have different ones: "%" and "/" are
/// "%25" and "%2F", "." and ".." are "%2E" and "%2E%2E", an empty name is "%". What would be longer
/// than a file system allows ends in "%~" and a hash of the whole name instead.
std::string unit_folder_name(std::string_view component);
/// The component that has the folder of this name; of a name that was too long its begin and "…".
std::string component_of_folder(std::string_view name);

/// The folder of a component.
std::filesystem::path unit_folder(const std::filesystem::path& results, std::string_view component);

/// Whether a path leads into the folder of all units, as it is written or by links. A unit can put
/// a link in the place of a file there, so nothing else may write to it.
bool is_in_unit_folders(const std::filesystem::path& results, const std::filesystem::path& file);

/// Whether there is anything in a component's folder.
bool has_unit_files(const std::filesystem::path& results);

/// Links, FIFOs and the like in the folders of these components, which units of an earlier run have
/// left, are removed, and then the films and scenes of all. Other files and folders stay: they may
/// be the user's. Throws core::Error (Input).
void clean_unit_folders(const std::filesystem::path& results,
                        std::span<const std::string> components);

/// The folders of a run's components, from before the first unit is instantiated until the last one
/// is destroyed; those that are empty then are removed.
class UnitFolders {
 public:
  /// Makes them, where they do not exist. Throws core::Error (Input).
  UnitFolders(const std::filesystem::path& results, std::span<const std::string> components);
  ~UnitFolders();
  UnitFolders(const UnitFolders&) = delete;
  UnitFolders& operator=(const UnitFolders&) = delete;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace stride::recorders

#endif

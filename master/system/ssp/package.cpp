#include "master/system/ssp/package.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/files/file_uri.h"
#include "master/base/files/input_file.h"
#include "master/base/xml/document.h"
#include "master/base/xml/editor.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/uri.h"

namespace stride::ssp {
namespace {

namespace fs = std::filesystem;

enum class Kind { Fmu, System, File };

bool is_in_component(const xml::Element& element) {
  return element.attribute_or("sourceBase", "SSD") == "component";
}

/// Where sources that are relative to a component are: in the folder of its .ssd, which becomes
/// another one. Empty for those that are in the component's archive, which stays as it is.
std::vector<fs::path> component_folders(const xml::Element& component,
                                        std::span<const fs::path> folders) {
  if (source_text(component).starts_with('#')) return {folders.begin(), folders.end()};
  const fs::path source = source_of(component, folders).path;
  return source.extension() == ".ssd" ? source_folders(source) : std::vector<fs::path>{};
}

bool names_a_file(const xml::Element& element) {
  const xml::Name name = element.name();
  const bool may =
      name == xml::Name{kSsd, "Component"} || name == xml::Name{kSsd, "ParameterBinding"} ||
      name == xml::Name{kSsd, "ParameterMapping"} || name == xml::Name{kSsd, "SignalDictionary"} ||
      name == xml::Name{kSsc, "MetaData"} || name == xml::Name{kSsc, "Signature"};
  const std::string source = element.attribute_or("source");
  return may && !source.empty() && !source.starts_with('#');
}

Kind kind_of(const xml::Element& element, const fs::path& source) {
  if (!element.is(kSsd, "Component")) return Kind::File;
  if (source.extension() == ".ssd") return Kind::System;
  return source.extension() == ".ssp" ? Kind::File : Kind::Fmu;
}

/// The same for each way to name the file, as far as it can be resolved.
fs::path identity(const fs::path& file) {
  std::error_code error;
  fs::path path = fs::weakly_canonical(file, error);
  return error ? file : path;
}

class Packer {
 public:
  Packer(Files& files, const FmuMaker& make_fmu) : files_(files), make_fmu_(make_fmu) {}

  archive::Contents run(const fs::path& system, std::span<const fs::path> variants) {
    std::map<std::string, fs::path> systems{{"SystemStructure.ssd", system}};
    for (const fs::path& variant : variants) systems.emplace(variant.filename(), variant);
    for (const auto& [name, file] : systems) names_.emplace(identity(file), name);
    for (const auto& [name, file] : systems) contents_[name].text = packed(file, "");
    return std::move(contents_);
  }

 private:
  /// The text of a .ssd that is packed into this folder of the package: kResources, or its top.
  std::string packed(const fs::path& path, const std::string& folder) {
    const xml::Document document = files_.document(path);
    xml::Editor editor(document.text());
    replace_sources(document.root(), {source_folders(path), {}}, folder, editor);
    return editor.result();
  }

  /// What is packed under this name, as seen from a folder of the package.
  static std::string uri(const std::string& name, const std::string& folder) {
    return name.starts_with(folder) ? name.substr(folder.size()) : "../" + name;
  }

  /// What sources are relative to: the .ssd, or the component around them.
  struct Bases {
    std::vector<fs::path> folders, of_component;
  };

  void replace_sources(const xml::Element& element, Bases bases, const std::string& folder,
                       xml::Editor& editor) {
    const bool is_inside = is_in_component(element);
    const std::vector<fs::path>& folders = is_inside ? bases.of_component : bases.folders;
    if (names_a_file(element) && !folders.empty()) {
      const auto [source, fragment, warning] = source_of(element, folders);
      editor.set_attribute(element.index(), "source",
                           core::uri_path(uri(add(element, source), folder)) +
                               (fragment.empty() ? "" : "#" + core::uri_path(fragment)));
      if (is_inside) editor.set_attribute(element.index(), "sourceBase", "SSD");
    }
    if (element.is(kSsd, "Component")) {
      bases.of_component = component_folders(element, bases.folders);
    }
    for (const xml::Element& child : element.children()) {
      replace_sources(child, bases, folder, editor);
    }
  }

  /// Its name in the package.
  std::string add(const xml::Element& element, const fs::path& source) {
    const auto [entry, is_new] = names_.try_emplace(identity(source));
    if (!is_new) return entry->second;
    const Kind kind = kind_of(element, source);
    const fs::path file = kind == Kind::Fmu ? make_fmu_(source, element.where()) : source;
    if (!core::is_file(file)) {
      element.fail(fmt::format("the file '{}' does not exist", files_.shown(source)),
                   "its path is relative to this file");
    }
    const std::string name =
        kResources +
        unique(file == source ? source.filename() : source.filename().replace_extension(".fmu"));
    entry->second = name;
    archive::Content& content = contents_[name];
    if (kind == Kind::System) {
      content.text = packed(file, kResources);
    } else {
      content.file = file;
    }
    return name;
  }

  std::string unique(const fs::path& wanted) {
    std::string name = wanted.string();
    for (int i = 2; !taken_.insert(name).second; ++i) {
      name = fmt::format("{}_{}{}", wanted.stem().string(), i, wanted.extension().string());
    }
    return name;
  }

  inline static const std::string kResources = "resources/";

  Files& files_;
  const FmuMaker& make_fmu_;
  archive::Contents contents_;
  std::map<fs::path, std::string> names_;  ///< of each file that is packed
  std::set<std::string> taken_;
};

}  // namespace

archive::Contents package_contents(const fs::path& system, Files& files, const FmuMaker& make_fmu,
                                   std::span<const fs::path> variants) {
  return Packer(files, make_fmu).run(system, variants);
}

}  // namespace stride::ssp

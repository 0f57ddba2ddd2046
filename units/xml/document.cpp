#include "units/xml/document.h"

#include <stdexcept>
#include <utility>

#include <tinyxml2.h>

#include "units/xml/file.h"

namespace xml {
namespace {

void require_well_formed(const tinyxml2::XMLDocument& document, const std::string& name,
                         const std::string& root) {
  if (document.Error()) {
    throw std::runtime_error(name + ":" + std::to_string(document.ErrorLineNum()) +
                             ": expected well-formed XML: " + document.ErrorName());
  }
  if (document.RootElement() == nullptr) {
    throw std::runtime_error(name + ":1: expected <" + root + "> as the root");
  }
}

}  // namespace

Document Document::load(const std::string& path, const std::string& root,
                        const std::vector<std::string>& attributes) {
  const std::string text = read_file(path, "a file with <" + root + "> in it");
  return parse(text, path, root, attributes);
}

Document Document::parse(const std::string& text, const std::string& name, const std::string& root,
                         const std::vector<std::string>& attributes) {
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  document->Parse(text.data(), text.size());
  return Document(std::move(document), name, root, attributes);
}

Document::Document(std::unique_ptr<tinyxml2::XMLDocument> document, const std::string& name,
                   const std::string& expected_root, std::vector<std::string> attributes)
    : document_(std::move(document)), name_(std::make_unique<const std::string>(name)) {
  require_well_formed(*document_, name, expected_root);
  if (root().name() != expected_root) root().fail("expected <" + expected_root + "> as the root");
  attributes.insert(attributes.begin(), "version");
  root().allow_only(attributes);
  if (const std::string version = root().text("version"); version != "1") {
    root().fail("version=\"" + version + "\" is not known: expected 1");
  }
}

Document::Document(Document&& other) noexcept = default;
Document::~Document() = default;

Element Document::root() const { return Element(*document_->RootElement(), *name_); }

}  // namespace xml

// A system as it is written: systems in systems, and connections that lead through their
// connectors.
#ifndef STRIDE_MASTER_SYSTEM_SSP_SYSTEM_TREE_H
#define STRIDE_MASTER_SYSTEM_SSP_SYSTEM_TREE_H

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"

namespace stride::ssp {

/// Which way a value goes through a connector, seen from outside of its element. Unsaid: its kind
/// is left out or leaves it open, as inout and unspecified do.
enum class Flow { In, Out, Unsaid };

struct Connector {
  core::ConnectorDeclaration declared;
  Flow flow = Flow::Unsaid;
};

struct ParameterValue {
  std::string name;   ///< with the binding's prefix before it, or as it is mapped
  std::string value;  ///< the elements of an array separated by blanks
  core::UnitOfMeasure unit;
  core::Location where;
  core::PathSegment segment{};  ///< of its parameter mapping
  bool is_required = false;     ///< a mistake, if it has no target; SSP's are ignored then
  std::vector<core::DimensionDeclaration> dimensions{};  ///< none: not checked
  /// Which of the bindings of its element it belongs to, from 1 on; 0: to none, but is one alone.
  std::size_t binding = 0;
  bool is_integer = false;  ///< by its type: for an Enumeration, the number of an item
};

/// The signals that all references to a signal dictionary share, by name.
struct SignalDictionary {
  std::map<std::string, core::ConnectorDeclaration> entries;
};

struct ConnectionEnd {
  std::string element;  ///< empty: the system itself
  std::string connector;
};
struct SystemConnection {
  ConnectionEnd start, end;  ///< which does not define which way the value goes
  core::PathSegment segment;
  core::Location where;
};

struct SystemNode;

/// An FMU, a system, or a reference to a signal dictionary.
struct ElementNode {
  std::string name;
  core::Location where;
  std::vector<Connector> connectors;  ///< as declared here; of a system, those of `system` hold
  std::filesystem::path source;       ///< of an FMU
  std::vector<ParameterValue> parameters;                        ///< of an FMU
  std::shared_ptr<const core::UnitsOfMeasure> units_of_measure;  ///< of its file, of an FMU
  std::unique_ptr<SystemNode> system;
  std::string dictionary;
};

struct SystemNode {
  std::string name;
  core::Location where;
  std::vector<Connector> connectors;
  std::vector<ElementNode> elements;
  std::vector<SystemConnection> connections;
  std::map<std::string, SignalDictionary> dictionaries;
  std::vector<ParameterValue> parameters;  ///< a later one replaces an earlier one
};

}  // namespace stride::ssp

#endif

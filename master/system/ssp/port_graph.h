// The connectors of a tree of systems, and the connections between them.
#ifndef STRIDE_MASTER_SYSTEM_SSP_PORT_GRAPH_H
#define STRIDE_MASTER_SYSTEM_SSP_PORT_GRAPH_H

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

/// Where connections meet: a component's connector, a system's, or a signal of a dictionary.
struct Port {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::string path;  ///< human-readable: "arm.motor.torque"
  Flow flow = Flow::Unsaid;
  std::size_t component = kNone;  ///< of a component's connector
  std::string connector;
  core::PathConnector path_connector{};  ///< of another
  std::optional<core::ValueType> kin{};  ///< where its type leaves the width open
  std::vector<core::DimensionDeclaration> dimensions{};
  core::Location where{};               ///< where another than a component's is declared
  std::vector<std::size_t> outgoing{};  ///< connections
  std::vector<std::size_t> incoming{};  ///< one at most, where it is not a component's connector

  bool is_component() const { return component != kNone; }
};

/// A connection with its direction.
struct PortConnection {
  std::size_t from, to;  ///< ports
  core::PathSegment segment;
  core::Location where;
};

/// Components and ports are identified by their indices in lists. The tree must outlive this
/// object.
class PortGraph {
 public:
  struct Component {
    const ElementNode* node;
    std::string path;  ///< from the root system, which is left out
  };

  /// Throws core::Error (Input) for names that are not there or twice, and for wiring that cannot
  /// be meant.
  explicit PortGraph(const SystemNode& root);

  /// In the order of the files, those of a nested system at its position.
  const std::vector<Component>& components() const { return components_; }
  const std::vector<Port>& ports() const { return ports_; }
  const std::vector<PortConnection>& connections() const { return connections_; }
  /// Of what is there twice, and of connections that lead nowhere, as text.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The index of an FMU of the tree.
  std::size_t component(const ElementNode& node) const { return places_.at(&node); }
  /// The ports of a system's own connectors, by name.
  const std::map<std::string, std::size_t>& connectors(const SystemNode& system) const {
    return systems_.at(&system).ports;
  }

  using Elements = std::map<std::string, const ElementNode*, std::less<>>;  ///< by name
  const Elements& elements(const SystemNode& system) const { return systems_.at(&system).elements; }

  using Way = std::vector<std::size_t>;  ///< connections, one behind the other
  /// Calls `found` with the way to each component's connector behind the port.
  void follow(std::size_t port, const std::function<void(const Way&)>& found) const;
  /// The way from what feeds the port, another than a component's connector; empty if nothing does.
  Way way_to(std::size_t port) const;
  /// Likewise; nothing if it leads back to itself, where way_to() throws core::Error (Input).
  std::optional<Way> find_way_to(std::size_t port) const;

 private:
  /// The part that a port plays within a system.
  enum class Role { Source, Sink, Either };
  struct System {
    std::string prefix;
    const SystemNode* around = nullptr;
    std::map<std::string, std::size_t> ports;  ///< of its connectors
    Elements elements{};
  };

  void add_system(const SystemNode& node, const std::string& prefix, const SystemNode* around);
  void add_component(const ElementNode& element, const std::string& path);
  void check_connectors(const ElementNode& element, const std::string& path) const;
  const SignalDictionary& find_dictionary(const SystemNode& system,
                                          const ElementNode& reference) const;
  std::pair<std::size_t, Role> find_end(const SystemNode& node, const ConnectionEnd& end,
                                        const core::Location& where);
  std::size_t find_port(const ElementNode& element, const System& system,
                        const std::string& connector, const core::Location& where);
  std::size_t find_signal(const ElementNode& reference, const std::string& path,
                          const std::string& name, const core::Location& where);
  void add_connection(const SystemNode& node, const SystemConnection& connection);
  bool is_clock(std::size_t port) const;
  bool is_there(const PortConnection& connection);
  [[noreturn]] void fail_direction(std::size_t start, std::size_t end, Role role,
                                   const core::Location& where) const;
  void warn_of_dead_end(const Port& port);
  void check_connection(std::size_t connection) const;
  /// The way, and the connection that leads back to it, if one does.
  std::pair<Way, std::optional<std::size_t>> trace(std::size_t port) const;
  void follow(std::size_t port, Way& way, const std::function<void(const Way&)>& found) const;
  [[noreturn]] static void fail_unknown(const System& system, const std::string& path,
                                        const std::string& connector, const core::Location& where);
  [[noreturn]] void fail_round(const PortConnection& connection) const;

  std::vector<Component> components_;
  std::vector<Port> ports_;
  std::vector<PortConnection> connections_;
  std::vector<std::string> warnings_;
  std::map<std::string, core::Location> names_;  ///< of the components
  std::map<const ElementNode*, std::size_t> places_;
  /// Of the connectors that components declare.
  std::map<std::pair<const ElementNode*, std::string_view>, Flow> declared_flows_;
  std::map<const SystemNode*, System> systems_;
  std::map<const ElementNode*, const SignalDictionary*> dictionaries_;
  /// Of components' connectors and of the signals of dictionaries.
  std::map<std::pair<const void*, std::string>, std::size_t> shared_;
};

}  // namespace stride::ssp

#endif

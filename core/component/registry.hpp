#pragma once
#include <any>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/sdk/registrar.hpp"

namespace signorini {

/// What is known about a registered component without creating it.
struct Entry {
  std::string kind;  ///< obstacle, smoother, transfer, coarse, linear, unsymmetric, amg, aggregates or estimator
  std::string id;
  std::string help;                 ///< one line
  std::vector<OptionSpec> options;  ///< with texts of static storage duration
  std::string file;                 ///< the library or program that provides it
  std::string version;              ///< of the provider
  bool optimised = true;            ///< whether a plugin was compiled with optimisation
};

/// All components by kind and id. Filled explicitly and handed on as an object: there is no global one, and nothing
/// registers itself before main.
class Registry {
 public:
  /// Adds a component with one creator for each interface it offers, such as Smoother<1>, Smoother<2>, Smoother<3>.
  /// Kind and id taken already is an Error(Exit::plugin) that names both providers.
  template <class... Interface>
  void add(Entry entry, std::type_identity_t<std::function<std::unique_ptr<Interface>()>>... creators) {
    Creators offered;
    (offered.emplace(typeid(Interface), std::move(creators)), ...);
    insert(std::move(entry), std::move(offered));
  }

  /// Adds what plugins provide; kind, id and help of `entry` are taken from it.
  void add_obstacle(const ObstacleType& type, Entry entry);

  void add_estimator(const EstimatorType& type, Entry entry);

  /// A new component. An unknown id is an Error(Exit::input) that names the nearest one and all there are.
  template <class Interface>
  std::unique_ptr<Interface> create(std::string_view kind, std::string_view id) const {
    const std::any* creator = offered(kind, id, typeid(Interface));
    if (!creator) wrong_interface(kind, id);
    return std::any_cast<const std::function<std::unique_ptr<Interface>()>&>(*creator)();
  }

  /// Throws Error(Exit::plugin) naming both providers when kind and id are taken already.
  void require_free(std::string_view kind, std::string_view id, std::string_view file) const;

  const ObstacleType& obstacle(std::string_view id) const;
  /// Null where an estimator is no plugin's.
  const EstimatorType* estimator(std::string_view id) const;
  bool has(std::string_view kind, std::string_view id) const;
  const Entry& entry(std::string_view kind, std::string_view id) const;
  /// The entries of a kind, or all when `kind` is empty, in alphabetical order.
  std::vector<Entry> entries(std::string_view kind = {}) const;

 private:
  using Creators = std::map<std::type_index, std::any>;
  struct Item {
    Entry entry;
    Creators creators;
  };

  void insert(Entry entry, Creators creators);
  const Item& item(std::string_view kind, std::string_view id) const;
  const std::any* offered(std::string_view kind, std::string_view id, std::type_index interface) const;
  [[noreturn]] static void wrong_interface(std::string_view kind, std::string_view id);

  std::map<std::pair<std::string, std::string>, Item> items_;
};

/// The file of the library or program that holds `address`, for Entry::file.
std::string file_of(const void* address);

}  // namespace signorini

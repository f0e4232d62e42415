#pragma once
#include <cstddef>
#include <exception>
#include <type_traits>
#include <utility>

#include "core/base/error.hpp"
#include "core/sdk/error_estimator.hpp"
#include "core/sdk/fingerprint.hpp"
#include "core/sdk/registrar.hpp"

namespace signorini::sdk {

/// The version of the plugin interface: another major is incompatible, a newer minor adds something.
inline constexpr unsigned abi_major = 6;
inline constexpr unsigned abi_minor = 0;

inline constexpr char magic[16] = "SIGNORINIplugin";

/// What a plugin exports, under the name `signorini_plugin`, and all it exports. The members never change their
/// order; a later version may only append some.
struct Plugin {
  char magic[16];
  unsigned size;  ///< of this struct
  unsigned abi_major, abi_minor;
  unsigned fingerprint_fields;
  const FingerprintField* fingerprint;
  const char* id;
  const char* version;
  const char* description;  ///< one line
  void (*register_all)(Registrar& registrar, Status& status) noexcept;
  // Since 5.1:
  const char* licence = nullptr;  ///< of the library, as SPDX names it; null: it does not say
};

/// What plugins of the first minor version export.
inline constexpr unsigned least_size = offsetof(Plugin, licence);

constexpr const char* licence_of(const char* given = nullptr) { return given; }

/// Calls `body` and turns whatever it throws into a status: an Error keeps its exit status, all else is the plugin's
/// fault. Returns what body returns, or a value-initialised result.
template <class Body>
std::invoke_result_t<Body> guarded(Status& status, Body&& body) noexcept {
  try {
    return std::forward<Body>(body)();
  } catch (const Error& error) {
    status.fail(static_cast<int>(error.status()), error.what());
  } catch (const std::exception& error) {
    status.fail(static_cast<int>(Exit::plugin), error.what());
  } catch (...) {
    status.fail(static_cast<int>(Exit::plugin), "an exception of unknown type");
  }
  return std::invoke_result_t<Body>();
}

/// The constructor of T, an Obstacle<B>, as a function that does not throw.
template <class T, int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return guarded(status, [&]() -> Obstacle<B>* { return new T(settings); });
}

/// Likewise that of an estimator.
template <class T>
ErrorEstimator* create_estimator(Status& status) noexcept {
  return guarded(status, []() -> ErrorEstimator* { return new T; });
}

template <auto Function>
void guard_registration(Registrar& registrar, Status& status) noexcept {
  guarded(status, [&] { Function(registrar, status); });
}

}  // namespace signorini::sdk

/// Defines the plugin, once in a shared library: SIGNORINI_PLUGIN("id", "1.0.0", "one line", function) where
/// `void function(Registrar&, Status&)` registers what the library provides, and may throw. A fifth argument is the
/// licence of the library, "BSD-3-Clause".
#define SIGNORINI_PLUGIN(id, version, description, function, ...)                                 \
  extern "C" {                                                                                    \
  extern __attribute__((visibility("default"))) const signorini::sdk::Plugin signorini_plugin;    \
  const signorini::sdk::Plugin signorini_plugin = {"SIGNORINIplugin",                             \
                                                   sizeof(signorini::sdk::Plugin),                \
                                                   signorini::sdk::abi_major,                     \
                                                   signorini::sdk::abi_minor,                     \
                                                   signorini::sdk::fingerprint_fields,            \
                                                   signorini::sdk::fingerprint,                   \
                                                   id,                                            \
                                                   version,                                       \
                                                   description,                                   \
                                                   &signorini::sdk::guard_registration<function>, \
                                                   signorini::sdk::licence_of(__VA_ARGS__)};      \
  }                                                                                               \
  static_assert(true, "")

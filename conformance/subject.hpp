#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/component/registry.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini::conformance {

/// Values of options, "gap=0.3", with which an obstacle is constructed.
using Values = std::vector<std::string>;

template <int B>
inline constexpr int dimension = B == 1 ? 2 : B;

/// An obstacle and what it holds on to.
template <int B>
struct Made {
  std::shared_ptr<const Settings> settings;
  std::unique_ptr<Obstacle<B>> obstacle;
  Values values;  ///< beside those that the user gave
};

/// It asked for an option that is not in its table, or as of another type.
class WrongQuestion : public Error {
 public:
  using Error::Error;
};

/// @param name of the obstacle, for the message
/// @throws WrongQuestion where one has been asked of these settings
void expect_good_questions(const Settings& settings, const std::string& name);

/// The obstacle type that is checked, from a library that is loaded already.
class Subject {
 public:
  /// @param given by the user, and goes before anything else
  Subject(const ObstacleType& type, std::string id, Values given)
      : type_(type), id_(std::move(id)), given_(std::move(given)) {}

  const ObstacleType& type() const { return type_; }
  const std::string& id() const { return id_; }
  const Values& given() const { return given_; }
  bool is_given(std::string_view option) const;

  /// Whether it is for problems of B unknowns.
  template <int B>
  bool has() const;

  /// Constructs it as the driver does.
  /// @param values of options beside those given
  /// @param shape in place of the one that the user or the kit gives
  /// @throws Error with the plugin's status, WrongQuestion
  template <int B>
  Made<B> make(const Values& values, std::shared_ptr<const DistanceFunction> shape = nullptr) const;

  /// The rigid shape that obstacles get with these values; null where the type takes none.
  template <int B>
  std::shared_ptr<const DistanceFunction> shape(const Values& values) const;

 private:
  ObstacleType type_;
  std::string id_;
  Values given_;
};

}  // namespace signorini::conformance

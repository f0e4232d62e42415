#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace signorini {

/// Where a field is evaluated: position, outer normal (zero inside the body), step parameter, and for materials the
/// region of the element, see Mesh::region.
struct Site {
  double x[3] = {0, 0, 0};
  double n[3] = {0, 0, 0};
  double t = 1;
  int region = -1;
};

/// A number given by the user: a constant or an expression. `origin` says where it was written ("scene.toml:12:
/// fix.0.value[1]"), for messages.
class Field {
 public:
  Field(double constant = 0) : constant_(constant) {}  // NOLINT: a number is a field
  /// @param text names the function: fields of one text have the same values
  /// @param uses_normal whether the value depends on Site::n
  /// @param uses_t whether it may depend on Site::t
  Field(std::function<double(const Site&)> function, std::string text, std::string origin, bool uses_normal = false,
        bool uses_t = true);
  /// @param function writes the values at many sites
  Field(std::function<void(std::span<const Site>, double*)> function, std::string text, std::string origin,
        bool uses_normal = false, bool uses_t = true)
      : function_(std::move(function)),
        text_(std::move(text)),
        origin_(std::move(origin)),
        uses_normal_(uses_normal),
        uses_t_(uses_t) {}

  /// The value; Error(Exit::input) that names origin, text and position where it is not finite, or uses the normal
  /// where there is none.
  double operator()(const Site& site) const;
  /// The same at many sites, which takes less time than one by one.
  void values(std::span<const Site> sites, double* out) const;
  /// The number, if this is no expression.
  std::optional<double> constant() const;
  /// As the user wrote it; a constant as a number.
  std::string text() const;
  const std::string& origin() const { return origin_; }
  bool uses_t() const { return uses_t_; }
  /// Whether the values at the step parameter t are surely those of another field at t_other.
  bool same(double t, const Field& other, double t_other) const;

 private:
  std::function<void(std::span<const Site>, double*)> function_;
  double constant_ = 0;
  std::string text_, origin_;
  bool uses_normal_ = false, uses_t_ = false;
};

}  // namespace signorini

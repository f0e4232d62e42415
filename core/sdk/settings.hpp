#pragma once
#include <cstddef>

#include "core/sdk/status.hpp"

namespace signorini {

struct SurfaceVertex;

enum class OptionType : int { boolean, integer, number, text, field, vector };

/// One option of a component. The table of these is the only place that knows an option: validation, help and
/// documentation come from it. `field`: a number or an expression; `vector`: a list of numbers or expressions.
struct OptionSpec {
  const char* name;
  OptionType type;
  const char* fallback;  ///< default as text; "" for none
  const char* range;     ///< for people and for the check: "(0, inf)", "[0, 1]", "body | obstacle", "" for any
  const char* help;      ///< one line
};

/// Signed distance of a point to a rigid obstacle (positive outside it) and the unit normal at the closest point,
/// which points from the obstacle towards the body. Unused coordinates are zero.
struct Distance {
  double value;
  double normal[3];
};

/// Where a rigid obstacle is: a point of it, and a unit vector that turns with it, zero where it has none. Two of them
/// say how it has moved in between.
struct Placement {
  double origin[3] = {}, axis[3] = {};
};

class DistanceFunction {
 public:
  virtual ~DistanceFunction();
  /// Distance at a point [3] with outer body normal [3]; never throws, a failed evaluation sets status.
  virtual Distance at(const double* point, const double* normal, Status& status) const noexcept = 0;
  /// Where the obstacle is that `point` meets; stays as it is for obstacles that never move.
  virtual void place(const double* point, const double* normal, Placement& out, Status& status) const noexcept;
};

/// The values a user gave to a component's options, already validated against its specs; defaults are filled in.
/// Strings and objects are owned by the host and outlive the component.
class Settings {
 public:
  virtual ~Settings();
  virtual bool has(const char* name) const noexcept = 0;  ///< given by the user
  virtual bool flag(const char* name) const noexcept = 0;
  virtual long integer(const char* name) const noexcept = 0;
  virtual double number(const char* name) const noexcept = 0;
  virtual const char* text(const char* name) const noexcept = 0;
  virtual std::size_t length(const char* name) const noexcept = 0;  ///< of a vector
  /// Whether a field is a number, not an expression; then `value` is that number.
  virtual bool constant(const char* name, double& value) const noexcept = 0;
  /// Value of a field, or of entry k of a vector, at a point [3] with outer normal [3].
  virtual double value(const char* name, std::size_t k, const double* point, const double* normal,
                       Status& status) const noexcept = 0;
  /// Values of a field at `count` vertices, which takes less time than one by one.
  virtual void values(const char* name, const SurfaceVertex* vertices, std::size_t count, double* out,
                      Status& status) const noexcept = 0;
  /// The rigid obstacle described by the keys `shape`, `point`, `normal`...; null when there is no `shape`.
  virtual const DistanceFunction* shape() const noexcept = 0;
};

}  // namespace signorini

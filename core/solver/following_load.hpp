#pragma once
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// A load -C'p by unknowns p beside those of the problem, which follow the solution from cycle to cycle, such as the
/// pressure of nearly incompressible material. What is sought is the saddle point of
///
///     1/2 x'Ax - b'x + p'(Cx - g) - 1/2 p'Mp    over all admissible x, for the p that makes it largest:
///
/// a cycle lowers it with p frozen, then p is corrected by S^-1 (C x - g - M p) with an approximation S of
/// C A^-1 C' + M (the method of Uzawa; Benzi, Golub and Liesen, Acta Numerica 2005, section 8.1).
template <int B>
class FollowingLoad {
 public:
  virtual ~FollowingLoad() = default;

  /// p.
  virtual const std::vector<double>& values() const = 0;
  /// The load of the p of now becomes part of the problem's b, unless it is.
  virtual void apply() = 0;
  /// It is part of b no more.
  virtual void withdraw() = 0;
  /// Another p, whose load is no part of b yet.
  virtual void set(std::vector<double> values) = 0;
  /// From x the correction of p, and S times it.
  virtual void correct(const std::vector<double>& x, std::vector<double>& change, std::vector<double>& residual) = 0;
  /// Changes p, the problem's b with it, and the residual b - A x, unless that is empty.
  virtual void add(const std::vector<double>& change, std::vector<double>& r) = 0;
  /// C and M, for who solves for x and p at once. In each row columns ascend.
  struct Matrices {
    std::vector<Offset> row{0};  ///< of C: one per p
    std::vector<Index> column;   ///< vectors
    std::vector<double> value;   ///< B per column, zero along prescribed components
    std::vector<Offset> mass_row{0};
    std::vector<Index> mass_column;
    std::vector<double> mass;  ///< of M
  };
  virtual Matrices matrices() const = 0;
  /// What values are compared with beside themselves, where what is given may be answered by none: as g alone asks for.
  virtual double size() const { return 0; }
  /// p'Mp: what is left of the energy.
  virtual double squared() const = 0;
};

}  // namespace signorini

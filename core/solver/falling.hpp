#pragma once
#include <Eigen/Core>

namespace signorini {

/// What a coarse solver may say beside CoarseSolver where the energy falls for ever: along which motions. A functional
/// such as friction, which only the finest level knows, may end the fall.
class Falling {
 public:
  virtual ~Falling() = default;
  /// Whether solve() goes on where it finds such motions: then it minimises across them.
  virtual void go_on(bool wanted) = 0;
  /// Motions without energy that the last solve() left out, one per column, B rows per vector; no column: none.
  virtual const Eigen::MatrixXd& left_out() const = 0;
};

}  // namespace signorini

#include "estimators/certificate/split_stress.hpp"

#include <Eigen/QR>

namespace signorini {
namespace {

template <int D>
class Conditions {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Stress = SplitStress<D>;

  Conditions() {
    for (int i = 0; i < D; ++i) gradient_[i + 1] = Vector::Unit(i);
    gradient_[0] = -Vector::Ones();
    for (int s = 0; s <= D; ++s) add_outer_face(s);
    for (int s = 0; s <= D; ++s)
      for (int r = s + 1; r <= D; ++r) add_inner_face(s, r);
    for (int s = 0; s <= D; ++s) add_divergence(s);
  }

  typename Stress::Operator solution() const {
    const Eigen::Index rows = static_cast<Eigen::Index>(next_);
    return matrix_.topRows(rows).colPivHouseholderQr().solve(right_.topRows(rows));
  }

 private:
  /// The traction through a face at a point of a part, as a row for each component.
  void add_traction(int s, int q, const Vector& normal, double sign) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) matrix_(next_ + i, Stress::row(s, q, Stress::component(i, j))) += sign * normal[j];
  }

  void add_outer_face(int s) {
    double measure = 1;
    for (int k = 2; k <= D; ++k) measure /= k;
    const Vector normal = -D * measure * gradient_[s];
    for (int q = 0, k = 0; q <= D; ++q) {
      if (q == s) continue;
      add_traction(s, q, normal, 1);
      for (int i = 0; i < D; ++i) right_(next_ + i, Stress::column(s, k, i)) = 1;
      next_ += D;
      ++k;
    }
  }

  void add_inner_face(int s, int r) {
    const Vector normal = gradient_[s] - gradient_[r];
    for (int q = 0; q <= D; ++q) {
      if (q == s) continue;  // q = r stands for the centroid
      add_traction(s, q == r ? s : q, normal, 1);
      add_traction(r, q, normal, -1);
      next_ += D;
    }
  }

  /// Hat functions of a part: lambda_q - lambda_s, and (D + 1) lambda_s of the centroid.
  void add_divergence(int s) {
    for (int q = 0; q <= D; ++q)
      add_traction(s, q, q == s ? Vector((D + 1) * gradient_[s]) : Vector(gradient_[q] - gradient_[s]), 1);
    for (int i = 0; i < D; ++i) right_(next_ + i, Stress::tractions + i) = -1;
    next_ += D;
  }

  static constexpr int most = (D + 1) * D * D + (D + 1) * D / 2 * D * D + (D + 1) * D;
  std::array<Vector, D + 1> gradient_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(most, Stress::stresses);
  Eigen::MatrixXd right_ = Eigen::MatrixXd::Zero(most, Stress::data);
  int next_ = 0;
};

}  // namespace

template <int D>
const typename SplitStress<D>::Operator& SplitStress<D>::reference() {
  static const Operator made = Conditions<D>().solution();
  return made;
}

template struct SplitStress<2>;
template struct SplitStress<3>;

}  // namespace signorini

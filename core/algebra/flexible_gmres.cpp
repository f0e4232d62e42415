#include "core/algebra/flexible_gmres.hpp"

#include <algorithm>

namespace signorini {

namespace {

using Vector = std::vector<double>;
using Operator = std::function<void(const Vector&, Vector&)>;

void add(double factor, const Vector& v, Vector& out) {
  for (std::size_t i = 0; i < v.size(); ++i) out[i] += factor * v[i];
}

double norm(const Vector& v) { return std::sqrt(dot(v, v)); }

/// The least squares problem of one round: Hessenberg columns turned to a triangle by plane rotations.
class Hessenberg {
 public:
  explicit Hessenberg(double residual) : right_{residual} {}

  /// What is left once this column, of one entry more than the last one, is there.
  double add(Vector column) {
    const std::size_t k = columns_.size();
    for (std::size_t i = 0; i < k; ++i) rotate(turns_[i], column[i], column[i + 1]);
    const double length = std::hypot(column[k], column[k + 1]);
    turns_.push_back(length > 0 ? Turn{column[k] / length, column[k + 1] / length} : Turn{1, 0});
    right_.push_back(0);
    rotate(turns_[k], column[k], column[k + 1]);
    rotate(turns_[k], right_[k], right_[k + 1]);
    columns_.push_back(std::move(column));
    return std::abs(right_[k + 1]);
  }

  /// The weights of the directions. One that adds nothing has none.
  Vector solve() const {
    Vector y(columns_.size());
    for (std::size_t i = y.size(); i-- > 0;) {
      double sum = right_[i];
      for (std::size_t j = i + 1; j < y.size(); ++j) sum -= columns_[j][i] * y[j];
      y[i] = columns_[i][i] != 0 ? sum / columns_[i][i] : 0;
    }
    return y;
  }

 private:
  struct Turn {
    double cosine, sine;
  };
  static void rotate(const Turn& turn, double& a, double& b) {
    const double first = turn.cosine * a + turn.sine * b;
    b = turn.cosine * b - turn.sine * a;
    a = first;
  }

  std::vector<Vector> columns_;
  std::vector<Turn> turns_;
  Vector right_;
};

}  // namespace

KrylovResult flexible_gmres(const Operator& apply, const Operator& precondition, const Vector& b, Vector& x,
                            const KrylovLimits& limits) {
  x.assign(b.size(), 0.0);
  KrylovResult found;
  const double whole = norm(b);
  if (whole == 0) return {0, 0};
  Vector r = b, product(b.size());
  while (found.applications < limits.most && found.residual > limits.tolerance) {
    const double begin = norm(r);
    std::vector<Vector> basis{r}, directions;
    for (double& v : basis[0]) v /= begin;
    Hessenberg hessenberg(begin);
    double left = begin;
    while (std::ssize(directions) < limits.restart && found.applications < limits.most &&
           left > limits.tolerance * whole) {
      directions.emplace_back(b.size());
      precondition(basis.back(), directions.back());
      apply(directions.back(), product);
      ++found.applications;
      Vector column;
      for (const Vector& v : basis) {
        column.push_back(dot(v, product));
        add(-column.back(), v, product);
      }
      column.push_back(norm(product));
      const double next = column.back();
      left = hessenberg.add(std::move(column));
      if (!(next > 0)) break;  // the space is exhausted
      for (double& v : product) v /= next;
      basis.push_back(product);
    }
    const Vector y = hessenberg.solve();
    for (std::size_t k = 0; k < y.size(); ++k) add(y[k], directions[k], x);
    apply(x, product);
    for (std::size_t i = 0; i < b.size(); ++i) r[i] = b[i] - product[i];
    const double last = found.residual;
    found.residual = norm(r) / whole;
    if (!(found.residual < last)) break;  // NaN, too
  }
  return found;
}

}  // namespace signorini

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>

#include "core/base/dense.hpp"
#include "estimators/certificate/trace_constant.hpp"

namespace signorini::test {
namespace {

struct Quadrature {
  std::vector<double> x, w;
};

/// Gauss's rule on [0, 1], from its Jacobi matrix.
Quadrature gauss(int points) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(points, points);
  for (int k = 1; k < points; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  const Eigenpairs found = eigenpairs(jacobi);
  Quadrature out;
  for (int k = 0; k < points; ++k) {
    out.x.push_back((found.values[k] + 1) / 2);
    out.w.push_back(found.vectors(0, k) * found.vectors(0, k));
  }
  return out;
}

/// Points of the simplex with corners 0, e_1, ..., e_K, by collapsing a cube; weights sum to 1 / K!.
void each_point(int K, int points, const std::function<void(const Eigen::VectorXd&, double)>& use) {
  const Quadrature rule = gauss(points);
  std::vector<int> at(static_cast<std::size_t>(K));
  for (;;) {
    Eigen::VectorXd x(K);
    double left = 1, weight = 1;
    for (int i = 0; i < K; ++i) {
      const auto n = static_cast<std::size_t>(at[static_cast<std::size_t>(i)]);
      x[i] = left * rule.x[n];
      weight *= left * rule.w[n];
      left *= 1 - rule.x[n];
    }
    use(x, weight);
    int i = 0;
    while (i < K && ++at[static_cast<std::size_t>(i)] == points) at[static_cast<std::size_t>(i++)] = 0;
    if (i == K) return;
  }
}

/// Legendre's polynomial of 2 x - 1, and its derivative.
std::pair<double, double> legendre(int degree, double x) {
  const double y = 2 * x - 1;
  double p = 1, before = 0, d = 0, d_before = 0;
  for (int k = 0; k < degree; ++k) {
    const double next = ((2 * k + 1) * y * p - k * before) / (k + 1);
    const double d_next = ((2 * k + 1) * (p + y * d) - k * d_before) / (k + 1);
    before = p, p = next, d_before = d, d = d_next;
  }
  return {p, 2 * d};
}

/// The largest |w - Pi w|_F^2 / |eps(w)|_T^2 of vector polynomials w of a degree, on the regular simplex T with edges
/// of length 1, Pi the projection onto linear ones on its face F.
double largest_quotient(int D, int degree) {
  Eigen::MatrixXd E(D, D);
  if (D == 2)
    E << 1, 0.5, 0, std::sqrt(3.0) / 2;
  else
    E << 1, 0.5, 0.5, 0, std::sqrt(3.0) / 2, std::sqrt(3.0) / 6, 0, 0, std::sqrt(2.0 / 3);
  const Eigen::MatrixXd inverse = E.inverse();
  std::vector<std::array<int, 3>> powers;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= (D == 3 ? degree : i + j); ++k) powers.push_back({i, j, k});
  const auto n = static_cast<Eigen::Index>(powers.size());
  const auto at = [&](const Eigen::VectorXd& x, Eigen::VectorXd& value, Eigen::MatrixXd* gradient) {
    for (Eigen::Index f = 0; f < n; ++f) {
      const auto& power = powers[static_cast<std::size_t>(f)];
      Eigen::VectorXd slope = Eigen::VectorXd::Ones(D);
      value[f] = 1;
      for (int i = 0; i < D; ++i) {
        const auto [p, d] = legendre(power[static_cast<std::size_t>(i)], x[i]);
        value[f] *= p;
        for (int k = 0; k < D; ++k) slope[k] *= k == i ? d : p;
      }
      if (gradient) gradient->row(f) = (inverse.transpose() * slope).transpose();
    }
  };
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n * D, n * D), S = Eigen::MatrixXd::Zero(n, n), G(n, D);
  Eigen::VectorXd value(n);
  each_point(D, degree + 1, [&](const Eigen::VectorXd& x, double weight) {
    at(x, value, &G);
    for (int c = 0; c < D; ++c)
      for (int d = 0; d < D; ++d) {
        auto block = A.block(c * n, d * n, n, n);
        block += weight * E.determinant() / 2 * G.col(d) * G.col(c).transpose();
        if (c == d) block += weight * E.determinant() / 2 * G * G.transpose();
      }
  });
  const double area = D == 2 ? 1 : std::sqrt(3.0) / 2;  // over that of the face of the simplex above
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(D, D), mixed = Eigen::MatrixXd::Zero(D, n);
  each_point(D - 1, degree + 1, [&](const Eigen::VectorXd& y, double weight) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(D), linear = Eigen::VectorXd::Ones(D);
    x.head(D - 1) = y;
    linear.tail(D - 1) = y;
    at(x, value, nullptr);
    S += weight * area * value * value.transpose();
    mass += weight * area * linear * linear.transpose();
    mixed += weight * area * linear * value.transpose();
  });
  S -= mixed.transpose() * mass.inverse() * mixed;
  const Eigenpairs rigid = eigenpairs(A);
  const Eigen::Index motions = D * (D + 1) / 2, rest = n * D - motions;
  Eigen::MatrixXd Z = rigid.vectors.rightCols(rest);
  for (Eigen::Index k = 0; k < rest; ++k) Z.col(k) /= std::sqrt(rigid.values[motions + k]);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n * D, n * D);
  for (int c = 0; c < D; ++c) all.block(c * n, c * n, n, n) = S;
  return eigenpairs(Z.transpose() * all * Z).values[rest - 1];
}

/// From below it comes near the constant, and changes no more.
TEST(TraceConstant, IsThatOfPolynomialsOfHighDegree) {
  for (const int D : {2, 3}) {
    const double constant = D == 2 ? squared_trace_constant<2> : squared_trace_constant<3>;
    double before = 0, now = 0;
    for (int degree = 2; degree <= (D == 2 ? 10 : 8); degree += D == 2 ? 2 : 1) {
      before = now;
      now = largest_quotient(D, degree);
      std::printf("%dD, degree %d: %.6f\n", D, degree, now);
    }
    EXPECT_LT(now, constant);
    EXPECT_GT(now, 0.85 * constant);
    EXPECT_LT(now - before, 0.02 * now);
  }
}

}  // namespace
}  // namespace signorini::test

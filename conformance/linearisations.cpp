// The smooth piece that coarse corrections minimise.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "conformance/node_checks.hpp"
#include "core/base/dense.hpp"

namespace signorini::conformance {
namespace {

template <int B>
using Point = std::array<double, B>;

template <int B>
bool has_linearisation(const Obstacle<B>& obstacle) {
  return obstacle.functional() && obstacle.linearisation();
}

template <int B>
std::string place_in_words(const Point<B>& v) {
  return fmt::format("({:.8g})", fmt::join(v, ", "));
}

/// Where it is asked: at x, and where the local solver leads to.
template <int B>
std::vector<Point<B>> places(Node<B>& node) {
  const Sample<B>& s = node.sample();
  std::vector<Point<B>> out{s.x};
  if (const Point<B> y = node.minimiser(s.x, s.force); all_finite(y)) out.push_back(y);
  return out;
}

template <int B>
std::string leaves_wrong_bounds(Node<B>& node) {
  for (const Point<B>& at : places<B>(node)) {
    const auto model = node.model(at);
    for (int k = 0; k < B; ++k)
      if (!(model.lower[k] <= 0 && model.upper[k] >= 0))
        return fmt::format("at {} the bounds of corrections are {} to {}", place_in_words<B>(at),
                           place_in_words<B>(model.lower), place_in_words<B>(model.upper));
    if (!all_finite(model.gradient) || !all_finite(model.hessian))
      return fmt::format("at {} the gradient is {} and the Hessian ({:.6g})", place_in_words<B>(at),
                         place_in_words<B>(model.gradient), fmt::join(model.hessian, ", "));
  }
  return {};
}

template <int B>
std::string gradient_is_no_slope(Node<B>& node) {
  const Sample<B>& s = node.sample();
  for (const Point<B>& at : places<B>(node)) {
    const auto model = node.model(at);
    const double size = node.slopes(at) + node.slopes(s.z);
    for (int side = 0; side < 2 * B + 2; ++side) {
      Point<B> d = side < 2 * B ? Node<B>::unit(side / 2, side % 2 ? -1 : 1) : s.step;
      for (int k = 0; k < B; ++k) {
        if (side == 2 * B + 1) d[k] = -d[k];
        if (!model.is_smooth(k)) d[k] = 0;
      }
      const double slope = node.slope(at, d), expected = block::dot<B>(model.gradient.data(), d.data());
      if (!(std::fabs(slope - expected) <= 1e-8 * size * length<B>(d)))
        return fmt::format("at {} slope along {} is {:.6g}, and gradient {} times that is {:.6g}",
                           place_in_words<B>(at), place_in_words<B>(d), slope, place_in_words<B>(model.gradient),
                           expected);
    }
  }
  return {};
}

/// What is wrong at one place, along one component; nothing where a kink or a bound is too near to tell. The gradient
/// may have a kink there: then the Hessian is that of the one or the other side.
template <int B>
std::string hessian_is_off(Node<B>& node, const Point<B>& at, int component) {
  const Sample<B>& s = node.sample();
  const auto model = node.model(at);
  double largest = (node.slopes(s.x) + node.slopes(s.z)) / s.size, best = infinity;
  for (const double v : model.hessian) largest = std::fmax(largest, std::fabs(v));
  Point<B> told{}, found{};
  for (const double part : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13}) {
    const Point<B> d = Node<B>::unit(component, part * s.size), back = Node<B>::unit(component, -part * s.size);
    const Point<B> above = s.moved(at, d), below = s.moved(at, back);
    const double way = above[component] - below[component];
    if (!(way > part * s.size)) {  // at a bound, or lost to rounding
      if (part == 1e-3) return {};
      break;
    }
    const auto up = node.model(above), down = node.model(below);
    Point<B> column{};
    for (int k = 0; k < B; ++k) {
      if (!model.is_smooth(k)) continue;
      if (!up.is_smooth(k) || !down.is_smooth(k)) return {};  // a kink
      column[k] = model.hessian[k * B + component];
    }
    const auto compare = [&](const auto& from, const auto& to, double step) {
      Point<B> derivative{};
      for (int k = 0; k < B; ++k)
        if (model.is_smooth(k)) derivative[k] = (to.gradient[k] - from.gradient[k]) / step;
      const double error = length<B>(difference<B>(derivative, column));
      if (!(error >= best)) best = error, told = column, found = derivative;
    };
    compare(down, up, way);
    compare(down, model, at[component] - below[component]);
    compare(model, up, above[component] - at[component]);
  }
  if (best <= 1e-4 * largest) return {};
  return fmt::format("at {} column {} of the Hessian is {}, and the gradient changes by {} times the step",
                     place_in_words<B>(at), component, place_in_words<B>(told), place_in_words<B>(found));
}

template <int B>
std::string hessian_is_no_derivative(Node<B>& node) {
  for (const Point<B>& at : places<B>(node)) {
    const auto model = node.model(at);
    for (int k = 0; k < B; ++k)
      if (model.is_smooth(k))
        if (std::string wrong = hessian_is_off<B>(node, at, k); !wrong.empty()) return wrong;
  }
  return {};
}

template <int B>
std::string hessian_is_indefinite(Node<B>& node) {
  for (const Point<B>& at : places<B>(node)) {
    const auto model = node.model(at);
    if (!all_finite(model.hessian)) continue;
    Eigen::MatrixXd H(B, B);
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) H(i, j) = model.hessian[i * B + j];
    const double largest = H.cwiseAbs().maxCoeff();
    if ((H - H.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest)
      return fmt::format("at {} the Hessian ({:.6g}) is not symmetric", place_in_words<B>(at),
                         fmt::join(model.hessian, ", "));
    const double least = eigenpairs(H).values.minCoeff();
    if (least < -1e-9 * largest)
      return fmt::format("at {} the Hessian ({:.6g}) has the eigenvalue {:.6g}", place_in_words<B>(at),
                         fmt::join(model.hessian, ", "), least);
  }
  return {};
}

/// Whether the slope along a component grows without end beside it, as that of a root does at zero: the second
/// derivative is infinite there, and what has it rests as at a kink.
template <int B>
bool bends_without_end(Node<B>& node, const Point<B>& at, int component) {
  const Sample<B>& s = node.sample();
  const auto curvature = [&](double part) {
    const Point<B> unit = Node<B>::unit(component, 1), to = s.moved(at, Node<B>::unit(component, part * s.size));
    return (node.slope(to, unit) - node.slope(at, unit)) / (to[component] - at[component]);
  };
  return curvature(1e-12) > 2 * curvature(1e-3);
}

template <int B>
std::string kinks_are_wrong(Node<B>& node) {
  for (const Point<B>& at : places<B>(node)) {
    const auto model = node.model(at);
    for (int k = 0; k < B; ++k) {
      if (model.is_smooth(k) || model.held >> k & 1u) continue;
      bool rests = model.lower[k] == 0 && model.upper[k] == 0 && model.gradient[k] == 0;
      for (int j = 0; j < B; ++j) rests = rests && model.hessian[k * B + j] == 0 && model.hessian[j * B + k] == 0;
      if (!rests)
        return fmt::format(
            "at {} component {} is critical, with bounds {:.6g} to {:.6g}, gradient {:.6g} and Hessian "
            "({:.6g})",
            place_in_words<B>(at), k, model.lower[k], model.upper[k], model.gradient[k],
            fmt::join(model.hessian, ", "));
      const double up = node.slope(at, Node<B>::unit(k, 1)), down = node.slope(at, Node<B>::unit(k, -1));
      if (!(up + down > 1e-9 * (std::fabs(up) + std::fabs(down))) && up + down == up + down &&
          !bends_without_end<B>(node, at, k))
        return fmt::format("at {} component {} is critical, and the slopes along it are {:.6g} and {:.6g}: no kink",
                           place_in_words<B>(at), k, up, down);
    }
  }
  return {};
}

}  // namespace

template <int B>
std::vector<NodeCheck<B>> checks_of_linearisations() {
  return {{"linearise_bounds", "xM", has_linearisation<B>, leaves_wrong_bounds<B>},
          {"linearise_gradient", "xM", has_linearisation<B>, gradient_is_no_slope<B>},
          {"linearise_hessian", "xM", has_linearisation<B>, hessian_is_no_derivative<B>},
          {"linearise_definite", "xM", has_linearisation<B>, hessian_is_indefinite<B>},
          {"linearise_kinks", "xM", has_linearisation<B>, kinks_are_wrong<B>}};
}

template std::vector<NodeCheck<1>> checks_of_linearisations<1>();
template std::vector<NodeCheck<2>> checks_of_linearisations<2>();
template std::vector<NodeCheck<3>> checks_of_linearisations<3>();

}  // namespace signorini::conformance

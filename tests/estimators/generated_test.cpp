#include "tests/estimators/generated.hpp"

namespace signorini::test {
namespace {

/// Small problems by chance: loads, sides that are held, obstacles, materials, meshes.
class Generated {
 public:
  explicit Generated(unsigned seed, int order = 1) : random_(seed), order_(fmt::format("order = {}\n", order)) {}

  std::string membrane() {
    std::string scene = body(2, order_ + "equation = 'diffusion'\ndiffusion = " + number(0.2, 5) + "\n") +
                        tables::fix("b", pick({"left", "top", "boundary"}), "0");
    scene += tables::load("b", number(-9, -4));
    if (chance()) scene += tables::load("b", number(-2, 2), "right");
    return scene +
           tables::floor("b", pick({number(-0.4, -0.1), "'" + number(-0.4, -0.1) + " - 0.2 * x^2 + 0.1 * x * y'"}));
  }

  std::string elastic(int dimension) {
    const bool plane = dimension == 2;
    const std::string material = order_ + "young = " + number(0.5, 2) + "\npoisson = " + number(0, 0.45) + "\n";
    std::string scene = body(dimension, material);
    const std::string zero = plane ? "[0, 0]" : "[0, 0, 0]", up = plane ? "[0, 1]" : "[0, 0, 1]";
    const auto vector = [&](const std::string& x, const std::string& y) {
      return plane ? "[" + x + ", " + y + "]" : "[" + x + ", 0, " + y + "]";
    };
    const bool pressed = chance();
    scene += tables::fix("b", pressed ? "top" : "left", vector("0", pressed ? number(-0.04, -0.02) : "0"));
    if (chance()) scene += tables::load("b", vector(number(-0.01, 0.01), number(-0.02, 0)), "right");
    if (chance()) scene += tables::load("b", vector("0", number(-0.02, 0)));
    if (chance()) return scene + tables::plane("b", "bottom", vector("0", number(-0.02, 0)), up);
    const std::string height = plane ? "y" : "z";
    return scene + "[[obstacle]]\ntype = 'contact'\nbody = 'b'\non = 'bottom'\nshape = 'expression'\nnormal = " + up +
           "\ndistance = '" + height + " + " + number(0.1, 0.4) + " * (x - " + number(0, 1) + ")^2'\n";
  }

 private:
  std::string body(int dimension, const std::string& keys) {
    const auto cells = [&] {
      return std::to_string(std::uniform_int_distribution<int>(2, dimension == 2 ? 4 : 2)(random_));
    };
    if (dimension == 2)
      return tables::block("b", "[0, 0]", "[" + number(0.7, 1.5) + ", 1]", "[" + cells() + ", " + cells() + "]", keys);
    return tables::block("b", "[0, 0, 0]", "[" + number(0.7, 1.5) + ", 1, 1]",
                         "[" + cells() + ", " + cells() + ", " + cells() + "]", keys);
  }
  std::string number(double from, double to) {
    return fmt::format("{:.4f}", std::uniform_real_distribution<double>(from, to)(random_));
  }
  bool chance() { return std::bernoulli_distribution(0.5)(random_); }
  std::string pick(const std::vector<std::string>& all) {
    return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random_)];
  }

  std::mt19937 random_;
  std::string order_;
};

TEST(GeneratedProblems, HaveTheirErrorsWithinTheBounds) {
  std::vector<double> scalar, elastic;
  for (unsigned seed = 0; seed < 24; ++seed) scalar.push_back(checked(Generated(seed).membrane(), 2, 1));
  for (unsigned seed = 0; seed < 28; ++seed) elastic.push_back(checked(Generated(seed).elastic(2), 2, 1));
  for (unsigned seed = 0; seed < 8; ++seed) elastic.push_back(checked(Generated(seed).elastic(3), 1, 1));
  std::printf("upper over lower: scalar median %.2f, worst %.2f; elastic median %.2f, nine of ten %.2f, worst %.2f\n",
              quantile(scalar, 0.5), quantile(scalar, 1), quantile(elastic, 0.5), quantile(elastic, 0.9),
              quantile(elastic, 1));
  EXPECT_LE(quantile(scalar, 0.5), 1.4);
  EXPECT_LE(quantile(scalar, 1), 2);
  EXPECT_LE(quantile(elastic, 0.5), 2);
  EXPECT_LE(quantile(elastic, 0.9), 4.5);
}

TEST(GeneratedProblems, OfQuadraticElementsToo) {
  std::vector<double> scalar, elastic;
  for (unsigned seed = 0; seed < 12; ++seed) scalar.push_back(checked(Generated(seed, 2).membrane(), 1, 1));
  for (unsigned seed = 0; seed < 14; ++seed) elastic.push_back(checked(Generated(seed, 2).elastic(2), 1, 1));
  for (unsigned seed = 0; seed < 4; ++seed) elastic.push_back(checked(Generated(seed, 2).elastic(3), 0, 1));
  std::printf("upper over lower, quadratic: scalar median %.2f, worst %.2f; elastic median %.2f, worst %.2f\n",
              quantile(scalar, 0.5), quantile(scalar, 1), quantile(elastic, 0.5), quantile(elastic, 1));
  EXPECT_LE(quantile(scalar, 0.5), 5);
  EXPECT_LE(quantile(elastic, 0.5), 4);
}

}  // namespace
}  // namespace signorini::test

#include "core/input/expression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "core/base/error.hpp"
#include "tests/core/scene/scenes.hpp"

namespace signorini {
namespace {

using testing::HasSubstr;

Field compile(const std::string& text) { return compile_expression(text, "scene.toml:3: key"); }

Site site(double x, double y = 0, double z = 0) {
  Site s;
  s.x[0] = x;
  s.x[1] = y;
  s.x[2] = z;
  return s;
}

struct Function {
  const char* name;
  double (*reference)(double);
};

TEST(Expression, FunctionsOfOneArgumentAreThoseOfC) {
  const Function functions[] = {
      {"sin", std::sin},     {"cos", std::cos},      {"tan", std::tan},     {"asin", std::asin},
      {"acos", std::acos},   {"atan", std::atan},    {"sinh", std::sinh},   {"cosh", std::cosh},
      {"tanh", std::tanh},   {"asinh", std::asinh},  {"acosh", std::acosh}, {"atanh", std::atanh},
      {"exp", std::exp},     {"exp2", std::exp2},    {"expm1", std::expm1}, {"log", std::log},
      {"log10", std::log10}, {"log2", std::log2},    {"log1p", std::log1p}, {"sqrt", std::sqrt},
      {"cbrt", std::cbrt},   {"abs", std::fabs},     {"fabs", std::fabs},   {"floor", std::floor},
      {"ceil", std::ceil},   {"round", std::round},  {"trunc", std::trunc}, {"erf", std::erf},
      {"erfc", std::erfc},   {"tgamma", std::tgamma}};
  for (const Function& f : functions) {
    const Field field = compile(std::string(f.name) + "(x)");
    for (const double x : {-2.5, -1.5, -0.5, -0.25, 0.25, 0.5, 0.75, 1.5, 2.5, 7.3})
      if (const double expected = f.reference(x); std::isfinite(expected)) {
        EXPECT_EQ(field(site(x)), expected) << f.name << "(" << x << ")";
      }
  }
}

TEST(Expression, FunctionsOfTwoArgumentsAreThoseOfC) {
  const double x = -7.25, y = 3;
  EXPECT_EQ(compile("atan2(x, y)")(site(x, y)), std::atan2(x, y));
  EXPECT_EQ(compile("pow(y, x)")(site(x, y)), std::pow(y, x));
  EXPECT_EQ(compile("hypot(x, y)")(site(x, y)), std::hypot(x, y));
  EXPECT_EQ(compile("fmod(x, y)")(site(x, y)), std::fmod(x, y));
  EXPECT_EQ(compile("fmin(x, y)")(site(x, y)), x);
  EXPECT_EQ(compile("fmax(x, y)")(site(x, y)), y);
}

TEST(Expression, MinAndMaxTakeManyArguments) {
  EXPECT_EQ(compile("min(x, 2, 3)")(site(5)), 2);
  EXPECT_EQ(compile("max(x, 2, 7, 3, -1)")(site(5)), 7);
  EXPECT_EQ(compile("min(x, -x)")(site(5)), -5);
}

TEST(Expression, SignIsMinusOneZeroOrOne) {
  const Field sign = compile("sign(x)");
  EXPECT_EQ(sign(site(-3)), -1);
  EXPECT_EQ(sign(site(0)), 0);
  EXPECT_EQ(sign(site(1e-300)), 1);
}

TEST(Expression, KnowsPositionNormalAndStep) {
  Site s;
  for (int k = 0; k < 3; ++k) {
    s.x[k] = k + 1;
    s.n[k] = k + 4;
  }
  s.t = 0.5;
  EXPECT_EQ(compile("x + 10*y + 100*z + 1e3*nx + 1e4*ny + 1e5*nz + t")(s), 654321.5);
  EXPECT_EQ(compile("pi")(s), std::numbers::pi);
}

struct Value {
  const char* text;
  double expected;
};

// x = 3, y = -2. Precedence of C, and `^`.
constexpr Value values[] = {{"-x^2", -9},
                            {"(-x)^2", 9},
                            {"2^3^2", 512},
                            {"2^-1", 0.5},
                            {"2^-2^2", 0.0625},
                            {"-2^-2", -0.25},
                            {"1/3*3", 1},
                            {"7/2", 3.5},
                            {"2-3-4", -5},
                            {"8/4/2", 1},
                            {"2*-x", -6},
                            {"2--x", 5},
                            {"- -x", 3},
                            {"--x", 3},
                            {"-+-+x", 3},
                            {"!x", 0},
                            {"!!x", 1},
                            {"!!!x", 0},
                            {"! ! x", 1},
                            {"-!!x", -1},
                            {"!-x", 0},
                            {"-!y", 0},
                            {"!x == 0", 1},
                            {"!x^0", 0},
                            {"1 == 0 < 2", 1},
                            {"2 > 1 > 0", 1},
                            {"3 > 2 > 1", 0},
                            {"1 != 0 == 1", 1},
                            {"1 || 0 && 0", 1},
                            {"x > 0 && y > 0 || 1", 1},
                            {"x == 3 && y != 3", 1},
                            {"x < 0 ? 1 : y < 0 ? 2 : 3", 2},
                            {"x > 0 ? y > 0 ? 1 : 2 : 3", 2},
                            {"x > 0 ? 1 : 1/0", 1},
                            {"1 + (x > 0 ? 1 : 2) * 2", 3},
                            {"x<=-y", 0},
                            {"x>=3", 1},
                            {"1e3 + .5 + 2. + 1E-1", 1002.6},
                            {"max(x > 0 ? 5 : 1, 2)", 5},
                            {" ( x\n+\ty ) ", 1}};

TEST(Expression, OperatorsBindAsInC) {
  for (const Value& v : values) EXPECT_DOUBLE_EQ(compile(v.text)(site(3, -2)), v.expected) << v.text;
}

/// A random expression as text with as few brackets as precedence allows, and its value computed beside it.
class RandomExpression {
 public:
  explicit RandomExpression(unsigned seed) : random_(seed) {}

  struct Node {
    std::string text;
    double value;
    int rank;  // of the outermost operator
  };

  Node make(int depth) {
    const int kind = depth == 0 ? pick(2) : pick(16);
    if (kind == 0) return {"x", 1.5, 10};
    if (kind == 1) return number();
    if (kind == 2) return sign(depth, "-");
    if (kind == 3) return sign(depth, "!");
    if (kind == 4) return conditional(depth);
    return binary(depth, kind - 5);
  }

 private:
  int pick(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  Node number() {
    const int n = pick(4);
    return {std::to_string(n), static_cast<double>(n), 10};
  }
  static std::string bracketed(const Node& node, int rank) {
    return node.rank < rank ? "(" + node.text + ")" : node.text;
  }

  Node sign(int depth, const char* op) {
    const Node a = make(depth - 1);
    return {op + bracketed(a, 7), *op == '-' ? -a.value : !a.value, 7};
  }
  Node conditional(int depth) {
    const Node c = make(depth - 1), a = make(depth - 1), b = make(depth - 1);
    return {bracketed(c, 1) + "?" + a.text + ":" + b.text, c.value != 0 ? a.value : b.value, 0};
  }
  Node binary(int depth, int which) {
    static const char* const ops[] = {"||", "&&", "==", "!=", "<", ">=", "+", "-", "*", "/", "^"};
    static const int ranks[] = {1, 2, 3, 3, 4, 4, 5, 5, 6, 6, 8};
    const Node a = make(depth - 1), b = make(depth - 1);
    const int rank = ranks[which];
    const bool power = rank == 8;
    // A sign may follow any operator: it needs brackets only to the left of a power.
    const bool sign_right = power && b.rank == 7;
    return {bracketed(a, power ? 9 : rank) + ops[which] + (sign_right ? b.text : bracketed(b, power ? 8 : rank + 1)),
            apply(which, a.value, b.value), rank};
  }
  static double apply(int which, double a, double b) {
    switch (which) {
      case 0:
        return a || b;
      case 1:
        return a && b;
      case 2:
        return a == b;
      case 3:
        return a != b;
      case 4:
        return a < b;
      case 5:
        return a >= b;
      case 6:
        return a + b;
      case 7:
        return a - b;
      case 8:
        return a * b;
      case 9:
        return a / b;
      default:
        return std::pow(a, b);
    }
  }

  std::mt19937 random_;
};

TEST(Expression, AgreesWithAnIndependentEvaluationOfRandomExpressions) {
  int finite = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    const RandomExpression::Node node = RandomExpression(seed).make(4);
    const auto result = test::outcome([&] {
      const double value = compile(node.text)(site(1.5));
      ASSERT_TRUE(std::isfinite(node.value)) << node.text;
      EXPECT_EQ(value, node.value) << node.text;
      ++finite;
    });
    EXPECT_EQ(result.status == Exit::solved, std::isfinite(node.value)) << node.text << ": " << result.message;
  }
  EXPECT_GT(finite, 2000);
}

TEST(Expression, WithoutVariablesIsAConstant) {
  EXPECT_EQ(compile("2*pi").constant(), 2 * std::numbers::pi);
  EXPECT_EQ(compile("2*x").constant(), std::nullopt);
  EXPECT_EQ(compile("2*x").text(), "2*x");
  EXPECT_EQ(compile("2*x").origin(), "scene.toml:3: key");
}

TEST(Expression, AValueThatIsNotFiniteIsAnErrorWhereItIsUsed) {
  for (const char* text : {"1/0", "1/x", "log(x - 1)", "sqrt(-1)", "min(1, log(-1))", "max(log(-1), 1)", "10^400"}) {
    const Field field = compile(text);
    const test::Outcome result = test::outcome([&] { field(site(0)); });
    EXPECT_EQ(result.status, Exit::input) << text;
    EXPECT_THAT(result.message, HasSubstr("scene.toml:3: key"));
  }
  EXPECT_EQ(compile("1/x")(site(2)), 0.5);
}

struct Broken {
  const char* text;
  const char* message;
};

constexpr Broken broken[] = {{"", "empty"},
                             {"  \n ", "empty"},
                             {"sni(x)", "column 1: unknown function 'sni', did you mean 'sin'?"},
                             {"1 + ln(x)", "column 5: unknown function 'ln'"},
                             {"2*xx", "column 3: unknown name 'xx', did you mean 'x'?"},
                             {"x + q", "column 5: unknown name 'q'; the variables are x, y, z"},
                             {"sin + 1", "column 1: 'sin' is a function"},
                             {"x(1)", "column 1: 'x' is no function"},
                             {"1 +", "a value is missing at the end"},
                             {"1 + * 2", "column 5: a value is missing before '*'"},
                             {"1 2", "column 3: an operator is missing before '2'"},
                             {"2x", "column 2: 'x' directly after a number"},
                             {"0x10", "column 2: 'x' directly after a number"},
                             {"1.2.3", "column 4"},
                             {".", "'.' is no number"},
                             {"1e999", "too large"},
                             {"(1", "column 1: this bracket is never closed"},
                             {"1)", "column 2: a closing bracket"},
                             {"()", "a value is missing before ')'"},
                             {"sin()", "a value is missing before ')'"},
                             {"sin(x, y)", "sin takes 1 argument, found 2"},
                             {"atan2(x)", "atan2 takes 2 arguments, found 1"},
                             {"min(x)", "min takes at least 2 arguments, found 1"},
                             {"min(1,,2)", "column 7"},
                             {"1, 2", "column 2: a comma outside"},
                             {"(1, 2)", "column 3: a comma outside"},
                             {"x = 1", "column 3: '=' assigns nothing here; write '=='"},
                             {"x & y", "column 3: expected '&&'"},
                             {"x | y", "column 3: expected '||'"},
                             {"x % 2", "column 3"},
                             {"\"x\"", "column 1"},
                             {"x ? 1", "column 3: '?' without ':'"},
                             {"min(x ? 1, 2)", "column 7: '?' without ':'"},
                             {"1 : 2", "column 3: ':' without '?'"},
                             {"x ? 1 : 2 : 3", "column 11: ':' without '?'"},
                             {"x \xc3\xa4", "byte 0xc3"}};

TEST(Expression, MistakesAreNamedWithTheirColumn) {
  for (const Broken& b : broken) {
    const test::Outcome result = test::outcome([&] { compile(b.text); });
    EXPECT_EQ(result.status, Exit::input) << b.text;
    EXPECT_THAT(result.message, HasSubstr(b.message)) << b.text;
    EXPECT_THAT(result.message, HasSubstr("scene.toml:3: key"));
  }
}

TEST(Expression, LengthAndNestingAreLimited) {
  const std::string long_sum(7999, ' ');
  EXPECT_EQ(compile(long_sum + "1").constant(), 1);
  std::string sum = "x";
  while (sum.size() < 7990) sum += "+x";
  EXPECT_EQ(compile(sum)(site(1)), (sum.size() + 1) / 2);
  const std::string huge(1000000, '(');
  EXPECT_THAT(test::outcome([&] { compile(huge); }).message, HasSubstr("1000000 characters"));
  const std::string deep = std::string(101, '(') + "x" + std::string(101, ')');
  EXPECT_THAT(test::outcome([&] { compile(deep); }).message, HasSubstr("more than 100 brackets"));
  const std::string allowed = std::string(100, '(') + "x" + std::string(100, ')');
  EXPECT_EQ(compile(allowed)(site(4)), 4);
  std::string conditions;
  for (int k = 0; k < 200; ++k) conditions += "x?";
  EXPECT_THAT(test::outcome([&] { compile(conditions + "1"); }).message, HasSubstr("more than 100 conditionals"));
  std::string powers = "1";
  while (powers.size() < 7990) powers += "^-1";
  EXPECT_EQ(compile(powers).constant(), 1);
}

TEST(Expression, ManySitesHaveTheValuesOfEachByItself) {
  std::string deep = "x";
  for (int k = 0; k < 30; ++k) deep = "y + (z - " + deep + " * 0.9)";
  for (const std::string& text :
       {std::string("x < y ? sqrt(y - x) : -(x - y)^2 / (1 + z^2)"), std::string("max(x, y, z) - min(sin(x), 2^-y)"),
        std::string("!(x > 0) + -!z"), deep}) {
    const Field field = compile(text);
    for (const std::size_t count : {1u, 2u, 63u, 64u, 65u, 200u}) {
      std::vector<Site> sites;
      for (std::size_t k = 0; k < count; ++k) {
        const double t = static_cast<double>(k);
        sites.push_back(site(std::sin(t), std::sin(1.7 * t), k % 7 == 0 ? 0 : std::cos(t)));
      }
      std::vector<double> found(count);
      field.values(sites, found.data());
      for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(found[k], field(sites[k])) << text << " at " << k;
    }
  }
}

TEST(Expression, OfManySitesTheOneWithoutAFiniteValueIsNamed) {
  std::vector<Site> sites(100, site(1));
  sites[77] = site(0, 5);
  std::vector<double> found(sites.size());
  const Field field = compile("1 / x");
  EXPECT_THAT(test::outcome([&] { field.values(sites, found.data()); }).message, HasSubstr("[0, 5, 0]"));
}

TEST(Expression, CopiesMayBeUsedFromSeveralThreads) {
  const Field field = compile("x*x + y");
  std::vector<std::thread> threads;
  threads.reserve(4);
  std::atomic<int> wrong = 0;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([copy = field, k, &wrong] {
      for (int i = 0; i < 20000; ++i)
        if (copy(site(i, k)) != static_cast<double>(i) * i + k) ++wrong;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace signorini

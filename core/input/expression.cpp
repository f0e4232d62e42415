#include "core/input/expression.hpp"

#include <fmt/format.h>
#include <muParserBase.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <numeric>
#include <span>

#include "core/base/error.hpp"
#include "core/input/expression_scan.hpp"

namespace signorini {
namespace {

struct Unary {
  const char* name;
  double (*function)(double);
};
struct Binary {
  const char* name;
  double (*function)(double, double);
};
struct Operator {
  const char* name;
  double (*function)(double, double);
  int precedence;
};
struct Variadic {
  const char* name;
  double (*function)(const double*, int);
};

constexpr Unary unary[] = {{"sin", std::sin},
                           {"cos", std::cos},
                           {"tan", std::tan},
                           {"asin", std::asin},
                           {"acos", std::acos},
                           {"atan", std::atan},
                           {"sinh", std::sinh},
                           {"cosh", std::cosh},
                           {"tanh", std::tanh},
                           {"asinh", std::asinh},
                           {"acosh", std::acosh},
                           {"atanh", std::atanh},
                           {"exp", std::exp},
                           {"exp2", std::exp2},
                           {"expm1", std::expm1},
                           {"log", std::log},
                           {"log10", std::log10},
                           {"log2", std::log2},
                           {"log1p", std::log1p},
                           {"sqrt", std::sqrt},
                           {"cbrt", std::cbrt},
                           {"abs", std::fabs},
                           {"fabs", std::fabs},
                           {"floor", std::floor},
                           {"ceil", std::ceil},
                           {"round", std::round},
                           {"trunc", std::trunc},
                           {"erf", std::erf},
                           {"erfc", std::erfc},
                           {"tgamma", std::tgamma},
                           {"sign", [](double v) -> double { return v > 0   ? 1
                                                                    : v < 0 ? -1
                                                                            : v; }}};

constexpr Binary binary[] = {{"atan2", std::atan2}, {"pow", std::pow},   {"hypot", std::hypot},
                             {"fmod", std::fmod},   {"fmin", std::fmin}, {"fmax", std::fmax}};

// NaN in any argument is the result.
double smallest(const double* v, int count) {
  return std::accumulate(v + 1, v + count, v[0], [](double a, double b) { return std::isnan(a) || a <= b ? a : b; });
}
double largest(const double* v, int count) {
  return std::accumulate(v + 1, v + count, v[0], [](double a, double b) { return std::isnan(a) || a >= b ? a : b; });
}
constexpr Variadic variadic[] = {{"min", smallest}, {"max", largest}};

// The parser's own operators rank == and < alike, which C does not; so the operators are ours.
constexpr Operator operators[] = {{"||", [](double a, double b) -> double { return a || b; }, 1},
                                  {"&&", [](double a, double b) -> double { return a && b; }, 2},
                                  {"==", [](double a, double b) -> double { return a == b; }, 3},
                                  {"!=", [](double a, double b) -> double { return a != b; }, 3},
                                  {"<", [](double a, double b) -> double { return a < b; }, 4},
                                  {">", [](double a, double b) -> double { return a > b; }, 4},
                                  {"<=", [](double a, double b) -> double { return a <= b; }, 4},
                                  {">=", [](double a, double b) -> double { return a >= b; }, 4},
                                  {"+", [](double a, double b) { return a + b; }, 5},
                                  {"-", [](double a, double b) { return a - b; }, 5},
                                  {"*", [](double a, double b) { return a * b; }, 6},
                                  {"/", [](double a, double b) { return a / b; }, 6}};
double power(double x, double y) { return y == 2 ? x * x : std::pow(x, y); }  // squares are what scenes are full of

constexpr int unary_precedence = 7, power_precedence = 8;

int read_number(const char* text, int* position, double* value) {
  if (*text != '.' && (*text < '0' || *text > '9')) return 0;
  const auto [end, error] = std::from_chars(text, text + std::char_traits<char>::length(text), *value);
  if (error != std::errc()) return 0;
  *position += static_cast<int>(end - text);
  return 1;
}

class Parser : public mu::ParserBase {
 public:
  Parser() {
    AddValIdent(read_number);
    EnableBuiltInOprt(false);
    InitCharSets();
    InitFun();
    InitConst();
    InitOprt();
  }

  void InitCharSets() override {
    DefineNameChars("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    DefineOprtChars("+-*/^<>=!&|");
    DefineInfixOprtChars("-!");
  }
  void InitFun() override {
    for (const Unary& f : unary) DefineFun(f.name, f.function);
    for (const Binary& f : binary) DefineFun(f.name, f.function);
    for (const Variadic& f : variadic) DefineFun(f.name, f.function);
  }
  void InitConst() override { DefineConst("pi", std::numbers::pi); }
  void InitOprt() override {
    for (const Operator& o : operators) DefineOprt(o.name, o.function, o.precedence, mu::oaLEFT, true);
    DefineOprt("^", power, power_precedence, mu::oaRIGHT, true);
    // The scan has reduced chains of prefix operators to these.
    DefineInfixOprt(
        "-", [](double v) { return -v; }, unary_precedence);
    DefineInfixOprt(
        "!", [](double v) -> double { return !v; }, unary_precedence);
    DefineInfixOprt(
        "!!", [](double v) -> double { return v != 0; }, unary_precedence);
    DefineInfixOprt(
        "-!", [](double v) -> double { return -!v; }, unary_precedence);
    DefineInfixOprt(
        "-!!", [](double v) -> double { return -(v != 0); }, unary_precedence);
  }
};

class Compiled {
 public:
  explicit Compiled(const std::string& text) {
    parser_.DefineVar("x", &site_.x[0]);
    parser_.DefineVar("y", &site_.x[1]);
    parser_.DefineVar("z", &site_.x[2]);
    parser_.DefineVar("nx", &site_.n[0]);
    parser_.DefineVar("ny", &site_.n[1]);
    parser_.DefineVar("nz", &site_.n[2]);
    parser_.DefineVar("t", &site_.t);
    parser_.SetExpr(text);
    parser_.Eval();  // parses
  }

  void values(std::span<const Site> sites, double* out) {
    const std::lock_guard lock(mutex_);
    for (const Site& site : sites) {
      site_ = site;
      *out++ = parser_.Eval();
    }
  }

 private:
  Site site_;
  Parser parser_;
  std::mutex mutex_;
};

std::shared_ptr<Compiled> compile(const std::string& scanned, const std::string& text, const std::string& origin) {
  try {
    return std::make_shared<Compiled>(scanned);
  } catch (const mu::ParserError& error) {
    input_error(origin, fmt::format("expression {}: {}", in_quotes(text), error.GetMsg()));
  }
}

}  // namespace

std::vector<ExpressionFunction> expression_functions() {
  std::vector<ExpressionFunction> all;
  for (const Unary& f : unary) all.push_back({f.name, 1, 1});
  for (const Binary& f : binary) all.push_back({f.name, 2, 2});
  for (const Variadic& f : variadic) all.push_back({f.name, 2, -1});
  return all;
}

std::string in_quotes(std::string_view text) {
  std::string line(text.substr(0, 60));
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  if (text.size() > 60) {
    while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0x80)) line.pop_back();  // no half characters
    line += "...";
  }
  return fmt::format("'{}'", line);
}

Field compile_expression(const std::string& text, const std::string& origin) {
  const ScannedExpression scanned = scan_expression(text, origin);
  const std::shared_ptr<Compiled> compiled = compile(scanned.text, text, origin);
  const auto values = [compiled](std::span<const Site> sites, double* out) { compiled->values(sites, out); };
  if (!scanned.has_variables) {
    double value;
    values(std::array{Site{}}, &value);
    if (std::isfinite(value)) return value;
  }
  return Field(values, text, origin, scanned.has_normal, scanned.has_t);
}

}  // namespace signorini

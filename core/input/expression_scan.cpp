#include "core/input/expression_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/input/expression.hpp"

namespace signorini {
namespace {

constexpr std::size_t longest = 8000;  // the parser itself refuses 20000 characters
constexpr std::size_t deepest = 100;   // brackets and conditionals open at once

const std::vector<std::string> variables = {"x", "y", "z", "nx", "ny", "nz", "t"};
constexpr std::string_view long_operators[] = {"<=", ">=", "==", "!=", "&&", "||"};
constexpr std::string_view short_operators = "+-*/^<>";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Scan {
 public:
  Scan(const std::string& text, const std::string& origin) : text_(text), origin_(origin) {}

  ScannedExpression run() {
    if (text_.size() > longest)
      input_error(origin_,
                  fmt::format("an expression of {} characters; at most {} are allowed", text_.size(), longest));
    if (std::all_of(text_.begin(), text_.end(), is_space)) input_error(origin_, "the expression is empty");
    result_.text = text_;
    for (at_ = next(0); at_ < text_.size(); at_ = next(at_)) wants_value_ ? value() : after_value();
    if (wants_value_) fail(text_.size(), "a value is missing at the end");
    end_part();
    if (!open_.empty()) fail(open_.back().position, "this bracket is never closed");
    return result_;
  }

 private:
  struct Bracket {
    std::size_t position;
    const ExpressionFunction* function;  // null: grouping
    int arguments;
    std::vector<std::size_t> questions;  // of the enclosing part
  };

  [[noreturn]] void fail(std::size_t position, const std::string& message) const {
    input_error(origin_, fmt::format("expression {}, column {}: {}", in_quotes(text_), position + 1, message));
  }

  // Position of the next character that is no space, which becomes a plain blank.
  std::size_t next(std::size_t at) {
    for (; at < text_.size() && is_space(text_[at]); ++at) result_.text[at] = ' ';
    return at;
  }

  void value() {
    const char c = text_[at_];
    if (is_letter(c)) return name();
    if (is_digit(c) || c == '.') return number();
    if (c == '+' || c == '-' || c == '!') return prefix();
    if (c != '(') fail(at_, "a value is missing before " + shown(at_));
    open(nullptr);
    ++at_;
  }

  void after_value() {
    const char c = text_[at_];
    if (c == ')') return close();
    if (c == ',') return comma();
    if (c == '?' || c == ':') return conditional(c);
    const std::string_view rest = std::string_view(text_).substr(at_);
    const bool is_long = std::any_of(std::begin(long_operators), std::end(long_operators),
                                     [&](std::string_view o) { return rest.substr(0, 2) == o; });
    if (!is_long && c == '=') fail(at_, "'=' assigns nothing here; write '==' to compare");
    if (!is_long && (c == '&' || c == '|')) fail(at_, fmt::format("expected '{0}{0}'", c));
    if (!is_long && short_operators.find(c) == std::string_view::npos)
      fail(at_, "an operator is missing before " + shown(at_));
    at_ += is_long ? 2 : 1;
    wants_value_ = true;
  }

  std::string shown(std::size_t at) const {
    const auto c = static_cast<unsigned char>(text_[at]);
    return c >= ' ' && c < 127 ? fmt::format("'{}'", text_[at]) : fmt::format("the byte {:#04x}", c);
  }

  void number() {
    double parsed;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), parsed);
    if (error == std::errc::result_out_of_range) fail(at_, "this number is too large or too small");
    if (error != std::errc()) fail(at_, "'.' is no number");
    const std::size_t past = at_ + (end - begin);
    if (past < text_.size() && (is_letter(text_[past]) || is_digit(text_[past]) || text_[past] == '.'))
      fail(past, fmt::format("{} directly after a number", shown(past)));
    at_ = past;
    wants_value_ = false;
  }

  // The parser takes one prefix operator. -- and + change nothing, ! does not see a sign, !!! is !: what remains of a
  // chain is one of -, !, !!, -! and -!!.
  void prefix() {
    const std::size_t begin = at_;
    bool negative = false;
    std::string chain;
    for (; at_ < text_.size() && std::string_view("+-!").find(text_[at_]) != std::string_view::npos;
         at_ = next(at_ + 1))
      chain += text_[at_];
    int nots = 0;
    for (auto c = chain.rbegin(); c != chain.rend(); ++c) {
      if (*c == '-') negative = !negative;
      if (*c != '!') continue;
      negative = false;
      nots = nots == 1 ? 2 : 1;
    }
    const std::string reduced = std::string(negative ? 1 : 0, '-').append(static_cast<std::size_t>(nots), '!');
    std::fill(result_.text.begin() + begin, result_.text.begin() + at_, ' ');
    std::copy(reduced.begin(), reduced.end(), result_.text.begin() + begin);
  }

  void name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    const std::size_t after = next(at_);
    const bool called = after < text_.size() && text_[after] == '(';
    const auto function =
        std::find_if(functions_.begin(), functions_.end(), [&](const auto& f) { return word == f.name; });
    const bool is_function = function != functions_.end();
    const bool is_variable = std::find(variables.begin(), variables.end(), word) != variables.end();
    if (!is_function && !is_variable && word != "pi")
      fail(begin,
           fmt::format("unknown {} {}{}", called ? "function" : "name", in_quotes(word), suggestion(word, called)));
    if (is_function && !called) fail(begin, fmt::format("'{0}' is a function: write {0}(...)", word));
    if (!is_function && called) fail(begin, fmt::format("'{}' is no function", word));
    result_.has_variables |= is_variable;
    result_.has_t |= word == "t";
    result_.has_place |= is_variable && word != "t";
    result_.has_normal |= is_variable && word[0] == 'n';
    wants_value_ = is_function;
    if (!is_function) return;
    at_ = after;
    open(&*function);
    ++at_;
  }

  std::string suggestion(const std::string& word, bool function) const {
    std::vector<std::string> names = variables;
    names.push_back("pi");
    if (function) names.clear();
    if (function)
      for (const ExpressionFunction& f : functions_) names.push_back(f.name);
    const std::string near = word.size() > 1 ? did_you_mean(word, names) : "";
    return near.empty() && !function ? "; the variables are x, y, z, nx, ny, nz and t" : near;
  }

  void open(const ExpressionFunction* function) {
    if (open_.size() + questions_.size() >= deepest) fail(at_, fmt::format("more than {} brackets are open", deepest));
    open_.push_back({at_, function, 1, std::move(questions_)});
    questions_.clear();
  }

  void comma() {
    if (open_.empty() || !open_.back().function) fail(at_, "a comma outside the arguments of a function");
    end_part();
    ++open_.back().arguments;
    ++at_;
    wants_value_ = true;
  }

  void close() {
    if (open_.empty()) fail(at_, "a closing bracket without an opening one");
    end_part();
    Bracket& bracket = open_.back();
    if (bracket.function) check_arguments(bracket);
    questions_ = std::move(bracket.questions);
    open_.pop_back();
    ++at_;
  }

  void check_arguments(const Bracket& bracket) const {
    const ExpressionFunction& f = *bracket.function;
    if (bracket.arguments < f.fewest || (f.most >= 0 && bracket.arguments > f.most))
      fail(bracket.position, fmt::format("{} takes {}{} argument{}, found {}", f.name, f.most < 0 ? "at least " : "",
                                         f.fewest, f.fewest == 1 ? "" : "s", bracket.arguments));
  }

  void conditional(char c) {
    if (c == ':' && questions_.empty()) fail(at_, "':' without '?'");
    if (open_.size() + questions_.size() >= deepest) fail(at_, fmt::format("more than {} conditionals", deepest));
    if (c == '?') questions_.push_back(at_);
    if (c == ':') questions_.pop_back();
    ++at_;
    wants_value_ = true;
  }

  void end_part() const {
    if (!questions_.empty()) fail(questions_.back(), "'?' without ':'");
  }

  const std::string& text_;
  const std::string& origin_;
  const std::vector<ExpressionFunction> functions_ = expression_functions();
  ScannedExpression result_;
  std::vector<Bracket> open_;
  std::vector<std::size_t> questions_;
  std::size_t at_ = 0;
  bool wants_value_ = true;
};

}  // namespace

ScannedExpression scan_expression(const std::string& text, const std::string& origin) {
  return Scan(text, origin).run();
}

}  // namespace signorini

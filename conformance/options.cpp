// What an obstacle is constructed with.
#include "conformance/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "conformance/sample.hpp"
#include "conformance/values.hpp"
#include "conformance/vertex_checks.hpp"

namespace signorini::conformance {
namespace {

std::span<const OptionSpec> options_of(const Subject& subject) {
  return {subject.type().options, subject.type().option_count};
}

bool is_set(const Values& values, std::string_view option) {
  return std::ranges::any_of(values, [&](const std::string& value) {
    return value.size() > option.size() && value.starts_with(option) && value[option.size()] == '=';
  });
}

/// Whether a message has a word, which may be part of no longer one.
bool has_word(std::string_view message, std::string_view word) {
  const auto joins = [&](std::size_t at) {
    return at < message.size() && (std::isalnum(static_cast<unsigned char>(message[at])) || message[at] == '_');
  };
  for (std::size_t at = 0; (at = message.find(word, at)) != std::string_view::npos; ++at)
    if (!(at > 0 && joins(at - 1)) && !joins(at + word.size())) return true;
  return false;
}

/// The first option that is not set and that a message names.
template <int B>
const OptionSpec* named_in(std::string_view message, const Subject& subject, const Values& values) {
  for (const OptionSpec& option : options_of(subject))
    if (!subject.is_given(option.name) && !is_set(values, option.name) && has_word(message, option.name))
      return &option;
  return nullptr;
}

/// With a number in place of a default that says nothing, for options of the same range may have to be in order.
std::string needed_value(const OptionSpec& option, int unknowns) {
  std::string value = value_within(option, unknowns, 0);
  if (value.empty())
    throw Error(Exit::input, fmt::format("it needs the option '{0}', a text that cannot be guessed: give it by --set "
                                         "{0}=VALUE",
                                         option.name));
  return value;
}

/// The shape beside the plane that obstacles are given.
Values sphere_in(int space) {
  return {"shape=sphere", space == 3 ? "center=[0, 0, 0]" : "center=[0, 0]", "radius=0.5"};
}

/// With another shape where an option has the name of a key of the plane.
template <int B>
Values beside_shape(const Subject& subject, Values values) {
  if (!subject.type().takes_shape || subject.is_given("shape") || is_set(values, "shape")) return values;
  if (is_set(values, "normal") || is_set(values, "point")) {
    const Values sphere = sphere_in(dimension<B>);
    values.insert(values.end(), sphere.begin(), sphere.end());
  }
  return values;
}

}  // namespace

template <int B>
Base base_of(const Subject& subject) {
  Base base;
  for (;;) try {
      (void)subject.make<B>(base.values);
      return base;
    } catch (const WrongQuestion& error) {
      base.failed = "asked";
      base.found = error.what();
      return base;
    } catch (const Error& error) {
      const std::string message = error.what();
      const bool input = error.status() == Exit::input, of_user = message.starts_with("--set");
      const OptionSpec* option = input && !of_user ? named_in<B>(message, subject, base.values) : nullptr;
      if (option) {
        base.values.push_back(needed_value(*option, dimension<B>));
        continue;
      }
      if (input && !subject.given().empty())
        base.refused = message;
      else
        base.failed = input ? "missing" : "constructs", base.found = message;
      return base;
    }
}

template <int B>
std::vector<Values> variants_of(const Subject& subject, const Values& base) {
  std::vector<Values> out;
  Values inside = base;
  int number = 0;
  for (const OptionSpec& option : options_of(subject)) {
    if (subject.is_given(option.name)) continue;
    const std::string value = value_within(option, dimension<B>, ++number);
    if (value.empty()) continue;
    std::erase_if(inside, [&](const std::string& v) { return v.starts_with(std::string(option.name) + "="); });
    inside.push_back(value);
  }
  if (inside != base) out.push_back(beside_shape<B>(subject, inside));
  for (const OptionSpec& option : options_of(subject)) {
    if (subject.is_given(option.name)) continue;
    for (const std::string& end : values_at_ends(option, dimension<B>)) {
      Values values = base;
      std::erase_if(values, [&](const std::string& v) { return v.starts_with(std::string(option.name) + "="); });
      values.push_back(end);
      out.push_back(beside_shape<B>(subject, std::move(values)));
    }
  }
  if (!subject.type().takes_shape || subject.is_given("shape")) return out;
  Values round = base;
  const Values sphere = sphere_in(dimension<B>);
  round.insert(round.end(), sphere.begin(), sphere.end());
  out.push_back(round);
  return out;
}

template <int B>
std::string wrong_with_values(const Subject& subject, const Values& values) {
  try {
    const Made<B> made = subject.make<B>(values);
    Random random(5);
    for (int number = 0; number < 20; ++number) {
      const SurfaceVertex vertex = random_vertex(dimension<B>, random);
      const Assembled<B> at = assemble_at<B>(*made.obstacle, {&vertex, 1});
      if (!is_answer(at.status))
        return fmt::format("assemble() fails with status {}: {}", at.status.code, at.status.message);
      if (!at.status.ok()) continue;
      std::string wrong = wrong_directions<B>(made, at.constraints[0]);
      if (wrong.empty()) wrong = wrong_bounds<B>(at.constraints[0]);
      if (wrong.empty()) wrong = wrong_numbers<B>(made, at.constraints[0]);
      if (!wrong.empty()) return fmt::format("at {} {}", describe(std::span(&vertex, 1)), wrong);
    }
    return {};
  } catch (const WrongQuestion&) {  // told elsewhere
    return {};
  } catch (const Error& error) {
    return error.status() == Exit::plugin ? error.what() : "";
  }
}

std::string describe(const Values& values, const Values& given) {
  Values all = given;
  all.insert(all.end(), values.begin(), values.end());
  return all.empty() ? "with its defaults" : fmt::format("with {}", fmt::join(all, ", "));
}

#define SIGNORINI_INSTANTIATE(B)                                              \
  template Base base_of<B>(const Subject&);                                   \
  template std::vector<Values> variants_of<B>(const Subject&, const Values&); \
  template std::string wrong_with_values<B>(const Subject&, const Values&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::conformance
